// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "common/tool_main.h"
#include "evaluation.h"
#include "figures.h"
#include "lidar_upsampling/io/file_places.h"
#include "lidar_upsampling/io/output_file.h"
#include "page/page.h"
#include "page/plots.h"
#include "page/running_time.h"
#include "rawlog-densify/job_settings.h"
#include "report.h"
#include "truth.h"
#include "uncertainty.h"

namespace {

using namespace lidar_upsampling;  // NOLINT(google-build-using-namespace)

struct Request {
  EvaluationJob job;
  std::vector<std::string> references, inputs, truth_objects;  ///< of each log
  std::string json, csv, html, report, config, protocol;
  std::vector<std::string> sets;
  bool no_paper = false;
  double tolerance_ms = 100;
};

void add_options(CLI::App& app, Request& request) {
  EvaluationJob& job = request.job;
  auto* const reference =
      app.add_option("--reference", request.references,
                     "the full log, or the simulator's truth; without it, --labels judge what "
                     "--report tells, --html and --report tell of coverage, tracks and times")
          ->expected(1)
          ->take_all();
  app.add_option("input,-i,--input", request.inputs,
                 "the densified log; several are judged together, each with its --reference")
      ->required()
      ->expected(1)
      ->take_all();
  app.add_option("--json", request.json, "everything, per scan and object");
  app.add_option("--csv", request.csv, "the headline as row,figure,value: for tables over logs");
  app.add_option("--html", request.html,
                 "one page for people: tables, plots, and pictures of the worst objects");
  app.add_option(
      "--report", request.report,
      "what rawlog-densify --report wrote: running time, tracks and velocities; row `ours` by "
      "labels");
  app.add_option("--label", job.label, "the LiDAR; default: the one that has virtual scans");
  app.add_option("--truth-objects,--labels", request.truth_objects,
                 "..._objects.csv of rawlog-simulate, an importer or your own (with ..._ego.csv "
                 "beside it): exact truth or people's labels")
      ->expected(1)
      ->take_all();
  app.add_option("--max-range", job.options.max_range_m, "of objects, m")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--tolerance", request.tolerance_ms,
                 "from a virtual scan to the nearest withheld scan, ms; further ones are left out")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_flag("--all-around", job.options.all_around, "objects outside of the cameras' view, too");
  app.add_option("--protocol", request.protocol,
                 "cut clouds to size as one of the paper's tables did")
      ->check(CLI::IsMember(protocol_names()))
      ->needs(reference);
  app.add_option("--seeds", job.options.num_seeds, "samples drawn for a protocol")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_flag("--accept-truncated", job.accept_truncated,
               "of a damaged log, take all that can be read, before and behind the damage");
  app.add_flag("--exact-emd", job.options.exact_emd,
               "the exact assignment of 2048 points beside the published EMD (slow)");
  app.add_option(
      "--config", request.config,
      "settings that the log was densified with, for row `paper`, `scan_time` and `output_label`");
  app.add_option("--set", request.sets, "one such setting, as for rawlog-densify")
      ->expected(1)
      ->take_all();
  app.add_flag("--no-paper", request.no_paper,
               "leave out row `paper`, which densifies the log anew");
  app.add_flag_callback(
      "--no-chamfer", [&job] { job.options.chamfer = false; },
      "leave out the distances of whole clouds, which take a third of the time");
  app.callback([&request] {
    const std::size_t logs = request.inputs.size();
    const bool compares = !request.references.empty() || !request.truth_objects.empty();
    if (!compares && request.html.empty() && request.report.empty())
      throw CLI::RequiredError("--reference (or --labels, --html or --report)");
    if (!compares && (!request.json.empty() || !request.csv.empty()))
      throw CLI::ValidationError("--json, --csv", "need --reference or --labels");
    if (!request.references.empty() && request.references.size() != logs)
      throw CLI::ValidationError("--reference", "each --input needs one");
    if (!request.truth_objects.empty() && request.truth_objects.size() != logs)
      throw CLI::ValidationError("--truth-objects", "each --input needs one, or none has one");
    if (logs > 1 && (!request.html.empty() || !request.report.empty()))
      throw CLI::ValidationError("--html, --report", "tell of one log");
  });
}

/// All that is written; whether it can be is told before the work.
class Outputs {
 public:
  explicit Outputs(const Request& request) {
    std::vector<FileUse> read{{"--report", request.report}, {"--config", request.config}};
    for (const std::string& path : request.inputs) read.push_back({"--input", path});
    for (const std::string& path : request.references) read.push_back({"--reference", path});
    for (const std::string& path : request.truth_objects)
      for (const std::string& table : truth_tables(path)) read.push_back({"--labels", table});
    check_files(read, {{"--json", request.json}, {"--csv", request.csv}, {"--html", request.html}});
    for (const std::string& path : {request.json, request.csv, request.html})
      if (!path.empty()) files_.emplace(path, OutputFile(path, {true, true}));
  }

  void write(const std::string& path, const std::string& text) {
    files_.at(path).write(text);
    files_.at(path).commit();
  }

  void write_json(const std::string& path, const Comparison& comparison) {
    OutputFile& file = files_.at(path);
    lidar_upsampling::write_json(comparison.result, comparison.figures,
                                 [&](const std::string& text) { file.write(text); });
    file.commit();
  }

 private:
  std::map<std::string, OutputFile> files_;
};

Comparison compare(Request& request, const std::optional<RunReport>& run, bool with_pictures) {
  EvaluationJob& job = request.job;
  job.tolerance_s = 1e-3 * request.tolerance_ms;
  job.report = run ? &*run : nullptr;
  job.paper_row = !request.no_paper;
  for (const std::string& output : {request.html, request.csv, request.json})
    if (!output.empty()) job.scratch_beside = output;
  job.options.labels.max_range_m = job.options.max_range_m;
  job.options.labels.all_around = job.options.all_around;
  if (!request.protocol.empty()) job.options.protocol = find_protocol(request.protocol);
  if (run) job.paper.config.timing.camera_time_offset_ms = run->camera_time_offset_ms;
  Comparison comparison;
  if (with_pictures)
    job.on_scan = [&](const ScanSet& scans, const ScanResult& result, const Pictured& pictures) {
      comparison.worst.add(scans, result, pictures);
    };
  for (std::size_t i = 0; i < request.inputs.size(); ++i) {
    job.input = request.inputs[i];
    if (!request.references.empty()) job.reference = request.references[i];
    if (!request.truth_objects.empty()) job.truth_objects = request.truth_objects[i];
    Progress progress("evaluating");
    append(comparison.result, evaluate_log(job, std::ref(progress)));
  }
  comparison.figures = compute_figures(comparison.result);
  comparison.protocol = job.options.protocol;
  job.on_scan = nullptr;
  return comparison;
}

void evaluate(Request& request) {
  const bool wants_page = !request.html.empty();
  if (wants_page && !has_gnuplot())
    throw std::runtime_error(
        "--html needs gnuplot for its plots, and it is not installed (Debian: gnuplot-nox)");
  Outputs outputs(request);
  request.sets.emplace_back("preset=paper");
  load_settings(request.job.paper, request.config, request.sets, "");
  PageContent content;
  content.input = request.inputs.front();
  if (!request.report.empty()) content.run = load_run_report(request.report);
  if (!request.references.empty() || !request.truth_objects.empty())
    content.comparison = compare(request, content.run, wants_page);
  if (const auto& comparison = content.comparison) {
    std::cout << to_table(comparison->result, comparison->figures, comparison->protocol);
    if (const auto& ours = comparison->result.labels[Row::ours])
      std::cout << to_text(calibration_of(*ours));
  }
  if (content.run) std::cout << to_text(running_time_of(*content.run));
  if (!request.json.empty()) outputs.write_json(request.json, *content.comparison);
  if (!request.csv.empty())
    outputs.write(request.csv, to_csv(content.comparison->result, content.comparison->figures));
  if (!wants_page) return;
  const LogIndex index = index_streams({request.inputs.front(), request.job.accept_truncated});
  content.coverage =
      measure_coverage(index, find_labels(index, request.job.label, request.job.paper.config),
                       1e-3 * request.tolerance_ms);
  outputs.write(request.html, to_page(content));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Compares the virtual scans of a densified log with the real ones withheld from it",
               "rawlog-evaluate");
  Request request;
  add_options(app, request);
  app.footer(
      "Examples:\n  rawlog-evaluate --reference full.rawlog -i dense.rawlog --html page.html");
  return run_tool(app, argc, argv, [&] { evaluate(request); });
}
