// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "plugin/statistics.h"

#include <cmath>
#include <iomanip>
#include <sstream>

namespace lidar_upsampling {
namespace {

std::string quantiles(const Latencies& latencies) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(1) << "median " << latencies.quantile_ms(0.5) << ", p95 "
       << latencies.quantile_ms(0.95) << ", max " << latencies.quantile_ms(1) << " ms";
  return text.str();
}

}  // namespace

void Latencies::add(double ms) {
  ++tenths_[static_cast<int>(std::lround(10 * ms))];
  ++count_;
}

double Latencies::quantile_ms(double share) const {
  if (count_ == 0) return 0;
  auto rank = std::lround(share * static_cast<double>(count_ - 1));
  for (const auto& [tenths, count] : tenths_) {
    rank -= static_cast<long>(count);
    if (rank < 0) return 0.1 * tenths;
  }
  return 0.1 * tenths_.rbegin()->first;
}

std::string summary(const SensorStatistics& statistics) {
  std::ostringstream text;
  text << statistics.num_real << " real observations (" << statistics.num_scans << " scans, "
       << statistics.num_images << " images), " << statistics.num_virtual_scans
       << " virtual scans\n"
       << "hurried: " << statistics.num_hurried
       << " images, on which no object was followed; dropped as late: "
       << statistics.num_late_images << " virtual scans, " << statistics.num_late_scans
       << " key scans; real observations out of order: " << statistics.num_out_of_order << '\n'
       << "latency from image to virtual scan: " << quantiles(statistics.ready)
       << "; until handed out: " << quantiles(statistics.delivered);
  return text.str();
}

}  // namespace lidar_upsampling
