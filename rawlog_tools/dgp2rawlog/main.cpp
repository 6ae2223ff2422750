// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors

// Turns a scene in the DGP layout, as of DDAD, into a log: scans and images by the sensors' names,
// poses POSE; and its 3D boxes into boxes and truth.
#include <iostream>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "common/tool_main.h"
#include "dgp2rawlog/dgp_labels.h"
#include "dgp2rawlog/dgp_log.h"
#include "lidar_upsampling/io/file_places.h"

namespace lidar_upsampling::dgp {
namespace {

struct Options {
  std::string scene;
  std::string output;
  std::vector<std::string> cameras;
  importing::LabelPaths labels;
  bool overwrite = false;
};

void warn(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) {
    std::cerr << "dgp2rawlog: warning: " << warning << "\n";
  }
}

void report(const Scene& scene) {
  std::map<std::string, int> counts;
  for (const Sweep& sweep : scene.sweeps) ++counts[sweep.file.sensor];
  for (const Picture& picture : scene.pictures) ++counts[picture.file.sensor];
  for (const auto& [sensor, count] : counts) std::cout << sensor << ": " << count << " files\n";
}

void convert(const Options& options) {
  check_files({{"--scene", options.scene}}, {{"--output", options.output},
                                             {"--boxes", options.labels.boxes},
                                             {"--truth-objects", options.labels.truth_objects}});
  RawlogWriter writer(options.output, options.overwrite);
  const Scene scene = open_scene(options.scene, options.cameras);
  report(scene);
  std::vector<importing::LogItem> items = items_of(scene);
  importing::check_room({"--output", options.output}, items);
  std::optional<importing::LabelFiles> labels;
  if (options.labels.any()) {
    labels.emplace(options.labels);
    SceneLabels read = read_labels(scene);
    warn(read.warnings);
    labels->write(labelled_log(scene, std::move(read.tracks)));
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

}  // namespace
}  // namespace lidar_upsampling::dgp

int main(int argc, char** argv) {
  using namespace lidar_upsampling;  // NOLINT(google-build-using-namespace)
  dgp::Options options;
  CLI::App app(
      "Turns a scene in the layout of TRI-ML's Dataset Governance Policy, as of DDAD, into a "
      "rawlog. "
      "The vehicle frame is the one that the scene's calibration refers to.",
      "dgp2rawlog");
  app.add_option("--scene", options.scene, "Folder of the scene, or its scene_*.json")->required();
  app.add_option("-o,--output", options.output, "The rawlog to write")->required();
  app.add_option("--cameras", options.cameras, "Names, as CAMERA_01,CAMERA_05 [all]")
      ->delimiter(',');
  app.add_option("--boxes", options.labels.boxes, "Detections CSV to make from the 3D boxes");
  app.add_option("--truth-objects", options.labels.truth_objects,
                 "Truth table ..._objects.csv to make from them, ..._ego.csv beside");
  app.add_flag("--overwrite", options.overwrite, "Replace existing outputs");
  app.footer(
      "Examples:\n  dgp2rawlog --scene ddad/000150 -o log.rawlog --truth-objects log_objects.csv");
  return run_tool(app, argc, argv, [&] {
    options.labels.overwrite = options.overwrite;
    dgp::convert(options);
  });
}
