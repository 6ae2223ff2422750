// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "common/tool_main.h"
#include "evaluation.h"
#include "report.h"

namespace {

using namespace lidar_upsampling;  // NOLINT(google-build-using-namespace)

void write_json(const LogResult& result, const std::string& path) {
  std::ofstream file(path);
  file << to_json(result).dump(1) << '\n';
  file.flush();
  if (!file) throw std::runtime_error(path + ": the report cannot be written");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Compares the virtual scans of a densified log with the real ones withheld from it",
               "rawlog-evaluate");
  EvaluationJob job;
  std::string json;
  double tolerance_ms = 15;
  app.add_option("--reference", job.reference, "the full log, or the simulator's truth")
      ->required();
  app.add_option("--input", job.input, "the densified log")->required();
  app.add_option("--json", json, "everything, per scan and object");
  app.add_option("--label", job.label, "the LiDAR; default: the one that has virtual scans");
  app.add_option("--truth-objects", job.truth_objects,
                 "rawlog-simulate's ..._objects.csv (with ..._ego.csv beside it)");
  app.add_option("--max-range", job.options.max_range_m, "of objects, m")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--tolerance", tolerance_ms, "between a virtual scan and its reference, ms")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_flag("--all-around", job.options.all_around, "objects outside of the cameras' view, too");
  return run_tool(app, argc, argv, [&] {
    job.tolerance_s = 1e-3 * tolerance_ms;
    Progress progress("evaluating");
    const LogResult result = evaluate_log(job, std::ref(progress));
    std::cout << to_table(result);
    if (!json.empty()) write_json(result, json);
  });
}
