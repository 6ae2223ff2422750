// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <cmath>

#include "simulator/scenario.h"

namespace lidar_upsampling::sim {

std::vector<double> hdl64_elevations() {
  std::vector<double> elevations;
  elevations.reserve(64);
  for (int i = 0; i < 32; ++i) elevations.push_back((-24.33 + 0.5 * i) * M_PI / 180);
  for (int i = 0; i < 32; ++i) elevations.push_back((-8.33 + i / 3.) * M_PI / 180);
  return elevations;
}

Stamp start_stamp() {
  // MRPT's ticks count from 1601, UNIX time from 1970.
  constexpr std::int64_t unix_epoch = 116444736000000000, seconds_2026 = 1767225600;
  return Stamp(mrpt::Clock::duration(unix_epoch + seconds_2026 * 10000000));
}

Stamp stamp_of(int index, double rate_hz, double phase_s) {
  return shifted(start_stamp(), phase_s + index / rate_hz);
}

std::vector<Stamp> stamps_of(double rate_hz, double phase_s, double duration_s) {
  std::vector<Stamp> stamps;
  const Stamp end = shifted(start_stamp(), duration_s);
  for (int i = 0;; ++i) {
    const Stamp stamp = stamp_of(i, rate_hz, phase_s);
    if (stamp > end) return stamps;
    stamps.push_back(stamp);
  }
}

}  // namespace lidar_upsampling::sim
