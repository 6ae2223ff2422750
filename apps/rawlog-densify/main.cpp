// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "check.h"
#include "common/tool_main.h"
#include "densify.h"
#include "job_settings.h"

namespace {

using namespace lidar_upsampling;  // NOLINT(google-build-using-namespace)

void write_report(const DensifyReport& report, const std::string& path) {
  std::ofstream file(path);
  file << to_json(report).dump(1) << '\n';
  file.flush();
  if (!file) throw std::runtime_error(path + ": the report cannot be written");
}

LogCheck checked(const DensifyJob& job) {
  Progress progress("checking");
  return check_log(job, std::ref(progress));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Raises a LiDAR's frame rate to the camera's: adds a virtual 3D scan to a log at every image "
      "that falls between two real scans",
      "rawlog-densify");
  DensifyJob job;
  std::string config, detections, poses, report_path;
  std::vector<std::string> sets;
  bool print_config = false, check = false;
  app.add_option("--input", job.input, "the log to densify (.rawlog, plain or gzip)");
  app.add_option("--output", job.output, "the densified log");
  app.add_option("--config", config, "settings (INI); without it, the defaults");
  app.add_option("--set", sets,
                 "one setting: name=value of [lidar_upsampling], or section.name=value")
      ->expected(1)
      ->take_all();
  app.add_option("--detections", detections,
                 "boxes from a file: label,stamp,class,score,left,top,right,bottom[,track]");
  app.add_option("--poses", poses,
                 "ego-motion from a file: TUM, KITTI or CSV, see [ego_motion] poses_* of the "
                 "settings");
  app.add_option("--report", report_path, "counts, times, and a row per object and image (JSON)");
  app.add_option("--pictures", job.pictures, "folder for pictures of every virtual scan");
  app.add_flag("--overwrite", job.overwrite, "replace an existing output");
  app.add_flag("--accept-truncated", job.accept_truncated,
               "densify what is readable of a log that is cut off");
  app.add_flag("--check", check,
               "only look at --input: its streams, and how camera and LiDAR fit in space and time; "
               "with --pictures, a scan on a picture of each camera");
  app.add_flag("--print-config", print_config, "print all settings with their defaults, and stop");
  app.callback([&] {
    if (print_config) return;
    for (const char* name : {"--input", "--output"})
      if (app.get_option(name)->empty() && !(check && name == std::string("--output")))
        throw CLI::RequiredError(name);
  });
  return run_tool(app, argc, argv, [&] {
    if (print_config) {
      std::cout << default_ini();
      return;
    }
    if (!poses.empty()) sets.push_back("ego_motion.poses_file=" + poses);
    load_settings(job, config, sets, detections);
    if (check) {
      std::cout << to_text(checked(job));
      return;
    }
    job.keep_rows = !report_path.empty();
    DensifyReport report;
    {
      Progress progress("densifying");
      report = densify(job, std::ref(progress));
    }
    if (!report_path.empty()) write_report(report, report_path);
    std::cout << summary(report);
  });
}
