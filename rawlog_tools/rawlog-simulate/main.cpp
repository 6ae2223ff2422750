// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <cmath>
#include <filesystem>
#include <iostream>
#include <set>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "common/tool_main.h"
#include "lidar_upsampling/ini_text.h"
#include "lidar_upsampling/io/file_places.h"
#include "simulate.h"
#include "simulator/variation.h"

namespace {

using lidar_upsampling::sim::SimulationSummary;

void print(const SimulationSummary& s, const std::string& output, double duration_s) {
  std::cout << output << ": " << duration_s << " s, " << s.num_scans << " scans of "
            << std::lround(s.mean_points) << " points on average, " << s.num_images << " images, "
            << s.num_ego << " ego poses; " << s.num_moving << " moving and " << s.num_parked
            << " standing traffic participants; " << s.num_truth_scans << " truth scans\n";
}

// Noise packs badly; without it, some tenth of a picture is left.
double least_bytes(const lidar_upsampling::sim::Scenario& scenario) {
  constexpr double kLeastShare = 0.1;
  double pixels = 0;
  for (const auto& spec : scenario.cameras)
    pixels +=
        scenario.duration_s * spec.rate_hz * spec.camera.model.width * spec.camera.model.height;
  return kLeastShare * 3 * pixels;
}

namespace fs = std::filesystem;

/// Where the tools' own scenarios are: installed, or beside the build.
std::vector<fs::path> scenario_folders() {
  const fs::path bin = fs::read_symlink("/proc/self/exe").parent_path();
  return {(bin / "../share/lidar_upsampling/config/scenarios").lexically_normal(),
          (bin / "../../../config/scenarios").lexically_normal()};
}

std::string no_such_scenario(const std::string& given) {
  std::set<std::string> names;
  for (const fs::path& folder : scenario_folders()) {
    std::error_code ignored;
    for (const auto& file : fs::directory_iterator(folder, ignored))
      names.insert(file.path().stem().string());
  }
  const std::vector<std::string> known(names.begin(), names.end());
  std::string message = "--scenario " + given +
                        ": there is no such file, nor a scenario of that name" +
                        lidar_upsampling::did_you_mean(given, known);
  const char* separator = known.empty() ? "" : " There are ";
  if (!known.empty() && message.back() != '?') separator = "; there are ";
  for (const std::string& name : known) {
    message += separator + name;
    separator = ", ";
  }
  return message;
}

/// What is no file may be the name of one of the tools' own.
std::string scenario_file(const std::string& given) {
  if (fs::exists(given)) return given;
  for (const fs::path& folder : scenario_folders()) {
    const fs::path file = (folder / given).replace_extension(".ini");
    if (fs::exists(file)) return file.string();
  }
  throw std::runtime_error(no_such_scenario(given));
}

}  // namespace

int main(int argc, char** argv) {
  using namespace lidar_upsampling;  // NOLINT(google-build-using-namespace)
  CLI::App app("Makes a log of a simulated town street, with exact truth beside it",
               "rawlog-simulate");
  sim::SimulationJob job;
  std::string scenario_path;
  double duration_s = 0;
  std::uint32_t seed = 0;
  app.add_option(
         "--scenario", scenario_path,
         "the world, its vehicles and sensors (INI), or the name of one that comes with the "
         "tools, as demo")
      ->required();
  app.add_option("-o,--output", job.output, "the log to make (.rawlog)")->required();
  app.add_option("--truth", job.truth, "log of a scan and the exact pose at every image's stamp");
  const auto* duration =
      app.add_option("--duration", duration_s, "seconds, instead of the scenario's")
          ->check(CLI::Range(0., 3600.));
  const auto* seed_option = app.add_option(
      "--seed", seed,
      "draws another situation of the same kind: places, speeds, colours, light, noise, street, as "
      "far as the scenario's [variation] lets; without it, it is exactly as written");
  app.add_flag("--overwrite", job.overwrite, "replace existing files");
  app.footer(
      "Examples:\n  rawlog-simulate --scenario demo -o sim.rawlog --truth truth.rawlog --seed "
      "7");
  return run_tool(app, argc, argv, [&] {
    scenario_path = scenario_file(scenario_path);
    check_files({{"--scenario", scenario_path}},
                {{"--output", job.output}, {"--truth", job.truth}});
    static_cast<void>(read_ini(scenario_path, IniRepeats::allow));  // lines that do nothing
    job.scenario = sim::load_scenario(scenario_path);
    // First, so that however much of it is asked for, a seed's situation is one.
    if (!seed_option->empty()) job.scenario = sim::drawn(job.scenario, seed);
    if (!duration->empty()) job.scenario.duration_s = duration_s;
    check_room({"--output", job.output}, least_bytes(job.scenario));
    SimulationSummary summary;
    {
      Progress progress("simulating");
      summary = sim::simulate(job, std::ref(progress));
    }
    print(summary, job.output, job.scenario.duration_s);
  });
}
