// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors

// Turns a drive in KITTI's raw layout, or a sequence in its odometry layout, into a log: scans
// LIDAR, images CAM0 to CAM3, poses OXTS or POSES; and a drive's labels into boxes and truth.
#include <iostream>
#include <optional>
#include <utility>
#include <vector>

#include "common/tool_main.h"
#include "kitti2rawlog/kitti_recording.h"
#include "lidar_upsampling/io/file_places.h"

namespace lidar_upsampling::kitti {
namespace {

struct Options {
  std::string drive, sequence;  // one of them
  std::string output;
  Selection selection;
  std::string label_file;
  importing::LabelPaths labels;
  bool overwrite = false;
};

void report(const std::string& folder, const SensorFrames& sensor) {
  const SensorFolder& files = sensor.files;
  if (!files.missing.empty()) {
    std::cerr << "kitti2rawlog: warning: " << sensor.name << ": " << files.missing.size() << " of "
              << files.missing.size() + files.frames.size() << " frames missing, from "
              << files.missing.front() << " to " << files.missing.back() << ": skipped\n";
  }
  if (files.frames.empty()) {
    throw std::runtime_error("no frame of " + folder + "/" + sensor.name +
                             " is there, or none within --first and --last");
  }
  std::cout << sensor.name << ": " << files.frames.size() << " frames\n";
}

Recording open_recording(const Options& options) {
  const std::string& folder = options.drive.empty() ? options.sequence : options.drive;
  Recording recording = options.drive.empty() ? open_sequence(folder, options.selection)
                                              : open_drive(folder, options.selection);
  report(folder, recording.scans);
  for (const CameraFrames& sensor : recording.cameras) report(folder, sensor.pictures);
  if (!recording.pose_frames.name.empty()) report(folder, recording.pose_frames);
  return recording;
}

void warn(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) {
    std::cerr << "kitti2rawlog: warning: " << warning << "\n";
  }
}

void convert(const Options& options) {
  if (!options.label_file.empty() && !options.labels.any()) {
    throw std::runtime_error("--labels needs --truth-objects or --boxes, where they go");
  }
  check_files({{"--labels", options.label_file}, {"--drive", options.drive + "/label_02.txt"}},
              {{"--output", options.output},
               {"--boxes", options.labels.boxes},
               {"--truth-objects", options.labels.truth_objects}});
  RawlogWriter writer(options.output, options.overwrite);
  Recording recording = open_recording(options);
  std::vector<importing::LogItem> items = items_of(recording);
  importing::check_room({"--output", options.output}, items);
  std::optional<importing::LabelFiles> labels;
  if (options.labels.any()) {
    labels.emplace(options.labels);
    warn(add_tracks(recording, options.drive, options.label_file));
    labels->write(labels_of(recording));
    warn(labels->warnings());
  }
  {
    Progress progress("converting");
    importing::write_items(writer, std::move(items), std::ref(progress));
  }
  writer.finish();
  if (labels) labels->commit();
  writer.commit();
  if (labels) {
    std::cout << labels->num_objects() << " objects, " << labels->num_boxes() << " boxes\n";
  }
  std::cout << writer.num_written() << " observations in " << options.output << "\n";
}

void add_options(CLI::App& app, Options& options) {
  auto* const source = app.add_option_group("input");
  source->add_option("--drive", options.drive,
                     "Folder of a drive in the raw layout, the calibration files one up");
  auto* const sequence = source->add_option(
      "--sequence", options.sequence,
      "Folder <root>/sequences/NN in the odometry layout, poses in <root>/poses/NN.txt");
  source->require_option(1);
  app.add_option("-o,--output", options.output, "The log to write")->required();
  app.add_option("--cameras", options.selection.cameras, "KITTI's camera numbers, as 2 or 0,1,2,3")
      ->delimiter(',')
      ->check(CLI::Range(0, 3))
      ->capture_default_str();
  FrameRange& frames = options.selection.frames;
  app.add_option("--first", frames.first, "First frame [the drive's]")
      ->check(CLI::Range(0, 1000000000));
  app.add_option("--last", frames.last, "Last frame, included [the drive's]")
      ->check(CLI::Range(0, 1000000000));
  app.add_option(
         "--labels", options.label_file,
         "tracklet_labels.xml, or a file in the format of the tracking benchmark's label_02 "
         "[the drive's tracklet_labels.xml or label_02.txt]")
      ->excludes(sequence)
      ->check(CLI::ExistingFile);
  app.add_option("--boxes", options.labels.boxes, "Detections CSV to make from the labels")
      ->excludes(sequence);
  app.add_option(
         "--truth-objects", options.labels.truth_objects,
         "Truth table ..._objects.csv to make from them; beside it ..._ego.csv and, where labels "
         "have areas that nobody labelled, ..._ignored.csv")
      ->excludes(sequence);
  app.add_flag("--overwrite", options.overwrite, "Replace existing outputs");
}

}  // namespace
}  // namespace lidar_upsampling::kitti

int main(int argc, char** argv) {
  using namespace lidar_upsampling;  // NOLINT(google-build-using-namespace)
  kitti::Options options;
  CLI::App app(
      "Turns a drive or sequence in one of KITTI's layouts into a log. The vehicle frame is that "
      "of the OXTS unit, in the odometry layout that of the LiDAR.",
      "kitti2rawlog");
  kitti::add_options(app, options);
  app.footer(
      "Examples:\n  kitti2rawlog --drive 2011_09_26/2011_09_26_drive_0052_sync -o full.rawlog");
  return run_tool(app, argc, argv, [&] {
    options.labels.overwrite = options.overwrite;
    kitti::convert(options);
  });
}
