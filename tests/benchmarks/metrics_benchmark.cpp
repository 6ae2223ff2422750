// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <benchmark/benchmark.h>

#include <random>

#include "lidar_upsampling/metrics/chamfer.h"
#include "lidar_upsampling/metrics/emd.h"
#include "lidar_upsampling/metrics/sampling.h"
#include "scene.h"

namespace lidar_upsampling::bench {
namespace {

using Points = std::vector<Eigen::Vector3f>;

const Points& scan(int cycle) { return scene().cycles[cycle].scan.points; }

Points uniform_points(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> any(-1, 1);
  Points points;
  for (int i = 0; i < count; ++i) {
    const float x = 60 * any(random), y = 60 * any(random);
    points.emplace_back(x, y, 2 * any(random));
  }
  return points;
}

void report(benchmark::State& state, const Points& first, const Points& second) {
  state.counters["points"] = static_cast<double>(first.size());
  state.counters["others"] = static_cast<double>(second.size());
}

// Two scans 0.1 s apart, the older one left where it was.
void chamfer_of_scans(benchmark::State& state) {
  const Points &first = scan(0), &second = scan(1);
  Chamfer chamfer;
  while (state.KeepRunning()) chamfer = compute_chamfer(first, second);
  report(state, first, second);
  state.counters["mm"] = 1000 * chamfer.mean_m();
}

void chamfer_uniform_120k(benchmark::State& state) {
  const Points first = uniform_points(120000, 1), second = uniform_points(120000, 2);
  Chamfer chamfer;
  while (state.KeepRunning()) chamfer = compute_chamfer(first, second);
  report(state, first, second);
  state.counters["mm"] = 1000 * chamfer.mean_m();
}

// Two scans, sampled to as many points each.
void approximate_emd_of_scans(benchmark::State& state) {
  const Points first = sample_points(scan(0), state.range(0), 1);
  const Points second = sample_points(scan(1), state.range(0), 2);
  EarthMoverDistance emd;
  while (state.KeepRunning()) emd = approximate_emd(first, second);
  report(state, first, second);
  state.counters["m"] = emd.plain_m;
}

void exact_emd_of_scans(benchmark::State& state) {
  const Points first = sample_points(scan(0), state.range(0), 1);
  const Points second = sample_points(scan(1), state.range(0), 2);
  EarthMoverDistance emd;
  while (state.KeepRunning()) emd = exact_emd(first, second);
  report(state, first, second);
  state.counters["m"] = emd.plain_m;
}

// A car's surface against a whole scan: hardly a pair agrees on where to go.
void exact_emd_hard(benchmark::State& state) {
  const Points first = sample_points(scan(0), state.range(0), 1);
  Points second = uniform_points(static_cast<int>(state.range(0)), 2);
  for (auto& point : second) point = point.cwiseProduct(Eigen::Vector3f(1 / 30.F, 1 / 60.F, 0.5F));
  EarthMoverDistance emd;
  while (state.KeepRunning()) emd = exact_emd(first, second);
  report(state, first, second);
  state.counters["m"] = emd.plain_m;
}

#define LIDAR_UPSAMPLING_BENCHMARK(name) \
  BENCHMARK(name)->Unit(benchmark::kMillisecond)->UseRealTime()
LIDAR_UPSAMPLING_BENCHMARK(chamfer_of_scans);
LIDAR_UPSAMPLING_BENCHMARK(chamfer_uniform_120k);
LIDAR_UPSAMPLING_BENCHMARK(approximate_emd_of_scans)->Arg(2500)->Arg(16384);
LIDAR_UPSAMPLING_BENCHMARK(exact_emd_of_scans)->Arg(2048);
LIDAR_UPSAMPLING_BENCHMARK(exact_emd_hard)->Arg(2048);

}  // namespace
}  // namespace lidar_upsampling::bench
