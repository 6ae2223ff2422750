// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "kitti2rawlog/hdl64_rings.h"

#include <algorithm>
#include <cmath>

#include "lidar_upsampling/units.h"

namespace lidar_upsampling::kitti {
namespace {

constexpr double kTurn = 2 * M_PI;
constexpr double kFallBack = 10 * kDegree;  // more than any jitter, less than any ring's extent

double azimuth_of(const Eigen::Vector3f& point) {
  const double azimuth = std::atan2(static_cast<double>(point.y()), static_cast<double>(point.x()));
  return azimuth < 0 ? azimuth + kTurn : azimuth;
}

std::vector<std::size_t> ring_starts(const std::vector<double>& azimuth) {
  std::vector<std::size_t> starts;
  for (std::size_t i = 0; i < azimuth.size(); ++i) {
    if (i == 0 || azimuth[i] < azimuth[i - 1] - kFallBack) starts.push_back(i);
  }
  return starts;
}

// Columns of one ring: by azimuth, moved on where two points would share one, and back from the
// end.
void assign_columns(const std::vector<double>& azimuth, std::size_t from, std::size_t to,
                    std::vector<std::uint16_t>& column) {
  int next = 0;
  for (std::size_t i = from; i < to; ++i) {
    const int nominal = static_cast<int>(azimuth[i] / kTurn * kHdl64Columns);
    next = std::max(nominal, next);
    const int last_free = kHdl64Columns - static_cast<int>(to - i);
    column[i] = static_cast<std::uint16_t>(std::min(next, last_free));
    ++next;
  }
}

}  // namespace

bool derive_rings(LidarScan& scan) {
  std::vector<double> azimuth;
  azimuth.reserve(scan.size());
  for (const Eigen::Vector3f& point : scan.points) azimuth.push_back(azimuth_of(point));
  std::vector<std::size_t> starts = ring_starts(azimuth);
  const std::size_t num_rings = starts.size();
  if (num_rings == 0 || num_rings > kHdl64Rings) return false;
  starts.push_back(scan.size());
  for (std::size_t i = 0; i < num_rings; ++i) {
    if (starts[i + 1] - starts[i] > kHdl64Columns) return false;
  }
  scan.ring.resize(scan.size());
  scan.column.resize(scan.size());
  for (std::size_t i = 0; i < num_rings; ++i) {
    // With rings missing, it is those on top: they may see nothing but sky.
    std::fill(scan.ring.begin() + static_cast<std::ptrdiff_t>(starts[i]),
              scan.ring.begin() + static_cast<std::ptrdiff_t>(starts[i + 1]),
              static_cast<std::uint16_t>(num_rings - 1 - i));
    assign_columns(azimuth, starts[i], starts[i + 1], scan.column);
  }
  scan.num_rings = kHdl64Rings;
  scan.num_columns = kHdl64Columns;
  return true;
}

}  // namespace lidar_upsampling::kitti
