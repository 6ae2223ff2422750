// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors

// What scans are worth for maps: those of a log at known poses, and the path a SLAM program found.
#include <filesystem>
#include <iomanip>
#include <iostream>

#include "common/tool_main.h"
#include "map_figures.h"
#include "path_errors.h"

namespace lidar_upsampling::maps {
namespace {

struct Options {
  std::string reference, truth_objects;
  std::vector<std::string> logs, simplemaps;
  MapOptions map;
  bool accept_truncated = false;
};

std::string stem(const std::string& path) { return std::filesystem::path(path).stem().string(); }

void warn_of(const std::vector<std::string>& warnings) {
  for (const std::string& text : warnings) warn("rawlog-map-compare", text);
}

void print_maps(const Options& options, const Reference& reference) {
  std::cout << "| map of | real | virtual | voxels | seen at rest | ghosts | others |\n"
            << "|---|---|---|---|---|---|---|\n";
  for (const std::string& log : options.logs) {
    const MapFigures figures = compare_map({log, options.accept_truncated}, reference, options.map);
    warn_of(figures.warnings);
    std::cout << "| " << stem(log) << " | " << figures.num_real << " | " << figures.num_virtual
              << " | " << figures.num_voxels << " | " << std::fixed << std::setprecision(1)
              << 100 * figures.coverage << " % | "
              << (reference.swept.empty() ? "?" : std::to_string(figures.num_ghosts)) << " | "
              << figures.num_others << " |\n";
  }
}

void print_paths(const Options& options, const Reference& reference) {
  std::cout << "| path | real | virtual | length, m | mean error, m | last, m | last yaw, deg |\n"
            << "|---|---|---|---|---|---|---|\n";
  for (const std::string& map : options.simplemaps) {
    const PathErrors errors = errors_of_path(map, reference.T_world_vehicle);
    if (errors.num_beyond > 0)
      warn_of({map + ": real scans that the reference does not reach, left out of the errors: " +
               std::to_string(errors.num_beyond)});
    std::cout << "| " << stem(map) << " | " << errors.num_real << " | " << errors.num_virtual
              << " | ";
    if (errors.num_real < 2) {
      std::cout << "lost | | | |\n";
      continue;
    }
    std::cout << std::fixed << std::setprecision(1) << errors.length_m << " | "
              << std::setprecision(3) << errors.mean_m << " | " << errors.last_m << " | "
              << std::setprecision(2) << errors.last_yaw_deg << " |\n";
  }
}

void compare(const Options& options) {
  std::optional<Truth> truth;
  if (!options.truth_objects.empty()) truth = load_truth(options.truth_objects);
  const Reference reference =
      make_reference({options.reference, options.accept_truncated}, truth, options.map);
  warn_of(reference.warnings);
  if (!options.logs.empty()) print_maps(options, reference);
  if (!options.logs.empty() && !options.simplemaps.empty()) std::cout << '\n';
  if (!options.simplemaps.empty()) print_paths(options, reference);
}

}  // namespace
}  // namespace lidar_upsampling::maps

int main(int argc, char** argv) {
  lidar_upsampling::maps::Options options;
  CLI::App app(
      "Compares the maps that logs make, and the paths of SLAM programs, with a reference.",
      "rawlog-map-compare");
  app.add_option("--reference", options.reference, "The log with all scans, and the true poses")
      ->required();
  app.add_option(
      "--truth-objects", options.truth_objects,
      "The simulator's *_objects.csv, with *_ego.csv beside it: tells ghosts from the rest");
  app.add_option("input,-i,--input", options.logs,
                 "Logs whose scans are mapped at the reference's poses");
  app.add_option("--simplemap", options.simplemaps, "What icp-slam or rbpf-slam wrote, as paths");
  app.add_option("--voxel", options.map.voxel_m, "Side of a voxel, m")
      ->capture_default_str()
      ->check(CLI::Range(0.01, 10.));
  app.add_option("--max-range", options.map.max_range_m, "Farther points are left out, m")
      ->capture_default_str()
      ->check(CLI::Range(1., 1000.));
  app.add_flag("--accept-truncated", options.accept_truncated,
               "Of a damaged log, take all that can be read, before and behind the damage");
  app.callback([&] {
    if (options.logs.empty() && options.simplemaps.empty())
      throw CLI::ValidationError("give something to compare: --input or --simplemap");
  });
  app.footer(
      "Examples:\n  rawlog-map-compare --reference full.rawlog -i sparse.rawlog dense.rawlog");
  return lidar_upsampling::run_tool(app, argc, argv,
                                    [&] { lidar_upsampling::maps::compare(options); });
}
