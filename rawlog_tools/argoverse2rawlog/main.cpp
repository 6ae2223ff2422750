// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors

// Turns an Argoverse 1 tracking log into a rawlog: scans LIDAR, images by the cameras' names, poses
// POSES; and its annotations into boxes and truth.
#include <iostream>
#include <optional>
#include <utility>
#include <vector>

#include "argoverse2rawlog/argoverse_log.h"
#include "common/tool_main.h"

namespace lidar_upsampling::argoverse {
namespace {

struct Options {
  std::string log;
  std::string output;
  std::vector<std::string> cameras = {"ring_front_center"};
  importing::LabelPaths labels;
  bool overwrite = false;
};

void convert(const Options& options) {
  RawlogWriter writer(options.output, options.overwrite);
  TrackingLog log = open_log(options.log, options.cameras);
  std::vector<importing::LogItem> items = items_of(log);
  importing::check_room({"--output", options.output}, items);
  std::optional<importing::LabelFiles> labels;
  if (options.labels.any()) {
    labels.emplace(options.labels);
    add_tracks(log, options.log);
    labels->write(labels_of(log));
    for (const std::string& warning : labels->warnings()) {
      std::cerr << "argoverse2rawlog: warning: " << warning << "\n";
    }
  }
  std::cout << "lidar: " << log.sweeps.size() << " sweeps\n";
  for (const CameraFiles& files : log.cameras) {
    std::cout << files.camera.label << ": " << files.pictures.size() << " pictures\n";
  }
  std::cout << "poses: " << log.poses.size() << "\n";
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

}  // namespace
}  // namespace lidar_upsampling::argoverse

int main(int argc, char** argv) {
  using namespace lidar_upsampling;  // NOLINT(google-build-using-namespace)
  argoverse::Options options;
  CLI::App app(
      "Turns an Argoverse 1 tracking log into a rawlog. The vehicle frame is the data set's "
      "egovehicle.",
      "argoverse2rawlog");
  app.add_option("--log", options.log, "Folder of the log")->required();
  app.add_option("-o,--output", options.output, "The rawlog to write")->required();
  app.add_option("--cameras", options.cameras, "Names, as ring_front_center,stereo_front_left")
      ->delimiter(',')
      ->capture_default_str();
  app.add_option("--boxes", options.labels.boxes, "Detections CSV to make from the annotations");
  app.add_option("--truth-objects", options.labels.truth_objects,
                 "Truth table ..._objects.csv to make from them, ..._ego.csv beside");
  app.add_flag("--overwrite", options.overwrite, "Replace existing outputs");
  app.footer(
      "Examples:\n  argoverse2rawlog --log train1/043aeba7 -o log.rawlog --truth-objects "
      "log_objects.csv");
  return run_tool(app, argc, argv, [&] {
    options.labels.overwrite = options.overwrite;
    argoverse::convert(options);
  });
}
