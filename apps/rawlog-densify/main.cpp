// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "check.h"
#include "common/tool_main.h"
#include "densify.h"
#include "job_settings.h"
#include "lidar_upsampling/io/file_places.h"
#include "lidar_upsampling/io/text_file.h"
#include "many_logs.h"
#include "mrpt_needs.h"
#include "parts.h"

namespace {

using namespace lidar_upsampling;  // NOLINT(google-build-using-namespace)

LogCheck checked(const DensifyJob& job) {
  Progress progress("checking");
  return check_log(job, std::ref(progress));
}

struct Request {
  DensifyJob job;
  std::vector<std::string> inputs, sets;
  std::string config, detections, poses, report, for_mrpt;
  int num_jobs = 1;
  double warm_up_s = PartOptions().warm_up_s;
  bool print_config = false, check = false;
};

void add_settings(CLI::App& app, Request& request) {
  app.add_option("--config", request.config, "settings (INI); without it, the defaults");
  app.add_option("--set", request.sets,
                 "one setting: name=value of [lidar_upsampling], or section.name=value")
      ->expected(1)
      ->take_all();
  app.add_option("--detections", request.detections,
                 "boxes from a file: label,stamp,class,score,left,top,right,bottom[,track]");
  app.add_option("--poses", request.poses,
                 "ego-motion from a file: TUM, KITTI or CSV, see [ego_motion] poses_* of the "
                 "settings");
}

void add_files(CLI::App& app, Request& request) {
  DensifyJob& job = request.job;
  app.add_option(
      "input,-i,--input", request.inputs,
      "the log to densify (.rawlog, plain, gzip or zstd); of several, output, report, film "
      "and pictures are folders");
  app.add_option("-o,--output", job.output, "the densified log");
  app.add_option("--report", request.report,
                 "counts, times, and a row per object and image (JSON)");
  app.add_option("--pictures", job.pictures, "folder for pictures of every virtual scan");
  app.add_option(
      "--film", job.film,
      "a film (.mp4, .avi, .mkv), slowed down three times: the camera, and from above the "
      "scans as the sensor took them beside those with virtual ones");
}

void add_ways_to_work(CLI::App& app, Request& request) {
  app.add_option("--jobs", request.num_jobs,
                 "several inputs: so many at a time, each with its share of the cores; those that "
                 "fail are named at the end. One input: in so many parts side by side, joined to "
                 "one output. As many always give the same; other than with one is what rests on "
                 "what came before a part's --warm-up")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  app.add_option("--warm-up", request.warm_up_s,
                 "s, that each part of a log looks back from its begin")
      ->capture_default_str()
      ->check(CLI::Range(0., 60.));
  app.add_flag("--overwrite", request.job.overwrite, "replace an existing output");
  app.add_flag("--accept-truncated", request.job.accept_truncated,
               "of a damaged log, take all that can be read, before and behind the damage");
  app.add_flag("--check", request.check,
               "only look at --input: its streams, and how camera and LiDAR fit in space and time; "
               "with --pictures, a scan on a picture of each camera");
  app.add_option("--for-mrpt", request.for_mrpt,
                 "a release of MRPT, as 2.5: refuse settings whose logs it cannot read");
  app.add_flag("--print-config", request.print_config,
               "print all settings with their defaults, and stop");
}

// @return its summary.
std::string densify_one(DensifyJob job, const std::string& report_path, const PartOptions& parts,
                        const std::function<void(double)>& progress) {
  // Whether it can be written is told before the work.
  check_room({"--output", job.output}, job.input, job.config.compression == Compression::none);
  std::optional<TextFile> file;
  if (!report_path.empty()) file.emplace(report_path, OutputOptions{true, true});
  job.rows_beside = report_path;
  const DensifyReport report =
      parts.most > 1 ? densify_in_parts(job, parts, progress) : densify(job, progress);
  if (file) {
    write_json(report, file->stream());
    file->commit();
  }
  return summary(report);
}

void densify_several(const Request& request) {
  const auto jobs = jobs_of(request.inputs, request.job, request.report);
  Progress progress("densifying");
  densify_all(
      jobs, static_cast<std::size_t>(request.num_jobs),
      [](const LogJob& one) { return densify_one(one.job, one.report, {}, nullptr); },
      std::ref(progress));
}

void check_files_of(const Request& request) {
  check_files({{"--input", request.inputs.front()},
               {"--config", request.config},
               {"--poses", request.poses},
               {"--detections", request.detections}},
              {{"--output", request.job.output},
               {"--report", request.report},
               {"--film", request.job.film}});
}

std::string further_files(const Request& request) {
  std::string text;
  if (!request.report.empty()) text += "report            " + request.report + "\n";
  if (!request.job.pictures.empty()) text += "pictures          " + request.job.pictures + "\n";
  if (!request.job.film.empty()) text += "film              " + request.job.film + "\n";
  return text;
}

void work_on(Request& request) {
  if (request.print_config) {
    std::cout << default_ini();
    return;
  }
  if (!request.poses.empty()) request.sets.push_back("ego_motion.poses_file=" + request.poses);
  load_settings(request.job, request.config, request.sets, request.detections);
  if (!request.for_mrpt.empty())
    check_readable_by(parse_release(request.for_mrpt), request.job.config);
  if (request.inputs.size() > 1) {
    densify_several(request);
    return;
  }
  request.job.input = request.inputs.front();
  if (request.check) {
    std::cout << to_text(checked(request.job));
    return;
  }
  check_files_of(request);
  const PartOptions parts{static_cast<std::size_t>(request.num_jobs), request.warm_up_s};
  std::string text;
  {
    Progress progress("densifying");
    text = densify_one(request.job, request.report, parts, std::ref(progress));
  }
  std::cout << text << further_files(request);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Raises a LiDAR's frame rate to the camera's: adds a virtual 3D scan to a log at every image "
      "that falls between two real scans",
      "rawlog-densify");
  Request request;
  add_files(app, request);
  add_settings(app, request);
  add_ways_to_work(app, request);
  app.callback([&] {
    if (request.print_config) return;
    for (const char* name : {"--input", "--output"})
      if (app.get_option(name)->empty() && !(request.check && name == std::string("--output")))
        throw CLI::RequiredError(name);
    if (request.check && request.inputs.size() > 1)
      throw CLI::ValidationError("--check", "looks at one input");
  });
  app.footer(
      "Examples:\n  rawlog-densify -i log.rawlog -o dense.rawlog --report report.json --film "
      "film.mp4");
  return run_tool(app, argc, argv, [&] { work_on(request); });
}
