// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <benchmark/benchmark.h>

#include <array>
#include <chrono>
#include <map>
#include <string>

#include "scene.h"

namespace lidar_upsampling::bench {
namespace {

// Whole rounds of the scene's three cycles after the first, so that every run times the same.
constexpr int kIterations = 12;

enum Step : int { insert_scan, key_image, first_image, second_image, all_steps };

// What the virtual scans of a run hold, and the stages' times in them, as means per virtual scan.
class Summary {
 public:
  void add(const VirtualScan& scan) {
    ++scans_;
    sums_["points"] += static_cast<double>(scan.scan.size());
    sums_["objects"] += static_cast<double>(scan.objects.size());
    for (const ObjectMotion& object : scan.objects) {
      sums_["tracked"] += object.num_tracked;
      sums_["moving"] += moves(object) ? 1 : 0;
    }
    for (const StageTime& time : scan.timing) sums_["ms: " + std::string(time.stage)] += time.ms;
  }

  void report(benchmark::State& state, bool with_stages) const {
    for (const auto& [name, sum] : sums_)
      if (with_stages || name.compare(0, 3, "ms:") != 0) state.counters[name] = sum / scans_;
  }

 private:
  int scans_ = 0;
  std::map<std::string, double> sums_;
};

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// One cycle through the upsampler. @return how long the step to be timed took, s.
double run_cycle(LidarUpsampler& upsampler, const Cycle& cycle, Step timed, Summary& summary) {
  LidarScan scan = cycle.scan;
  std::array<double, all_steps> seconds{};
  auto start = std::chrono::steady_clock::now();
  upsampler.insert_scan(std::move(scan));
  seconds[insert_scan] = seconds_since(start);
  for (int i = 0; i < 3; ++i) {
    start = std::chrono::steady_clock::now();
    const auto virtual_scan = upsampler.insert_image(cycle.images[i]);
    seconds[key_image + i] = seconds_since(start);
    if (virtual_scan) summary.add(*virtual_scan);
  }
  if (timed != all_steps) return seconds[timed];
  // Two virtual scans come of it.
  return (seconds[insert_scan] + seconds[key_image] + seconds[first_image] +
          seconds[second_image]) /
         2;
}

void time_step(benchmark::State& state, Step timed) {
  Feed feed;
  Summary summary;
  while (state.KeepRunning()) {
    const Cycle& cycle = feed.next();
    state.SetIterationTime(run_cycle(feed.upsampler(), cycle, timed, summary));
  }
  summary.report(state, timed == all_steps);
}

// The real scan: registered to the one before, as there are no poses.
void whole_scan(benchmark::State& state) { time_step(state, insert_scan); }
// The image at the scan's instant: objects are found, and points put on it.
void whole_key_image(benchmark::State& state) { time_step(state, key_image); }
void whole_image_first(benchmark::State& state) { time_step(state, first_image); }
void whole_image_second(benchmark::State& state) { time_step(state, second_image); }
// All of it per virtual scan: what decides whether a log is densified as fast as it was driven.
void scan_and_two_images(benchmark::State& state) { time_step(state, all_steps); }

#define LIDAR_UPSAMPLING_WHOLE_BENCHMARK(name) \
  BENCHMARK(name)->Unit(benchmark::kMillisecond)->UseManualTime()->Iterations(kIterations)
LIDAR_UPSAMPLING_WHOLE_BENCHMARK(whole_scan);
LIDAR_UPSAMPLING_WHOLE_BENCHMARK(whole_key_image);
LIDAR_UPSAMPLING_WHOLE_BENCHMARK(whole_image_first);
LIDAR_UPSAMPLING_WHOLE_BENCHMARK(whole_image_second);
LIDAR_UPSAMPLING_WHOLE_BENCHMARK(scan_and_two_images);

}  // namespace
}  // namespace lidar_upsampling::bench
