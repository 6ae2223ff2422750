// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/scan/sweep.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "lidar_upsampling/scan/compose.h"
#include "lidar_upsampling/units.h"

namespace lidar_upsampling {
namespace {

std::vector<float> times_by_azimuth(const LidarScan& scan, const SweepOptions& options,
                                    double period_s) {
  const double start = options.start_deg * kDegree;
  const double sign = options.direction == TurnDirection::clockwise ? -1 : 1;
  std::vector<float> times(scan.size());
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double azimuth = std::atan2(scan.points[i].y(), scan.points[i].x());
    double turned = sign * (azimuth - start) / (2 * M_PI);
    turned -= std::floor(turned);
    times[i] = static_cast<float>((turned - options.reference) * period_s);
  }
  return times;
}

bool is_near(float time_s) {
  constexpr float kFarthest_s = 1;
  return std::abs(time_s) <= kFarthest_s;  // not if it is not finite
}

// Whether the log tells that a scan's points were measured at different instants.
bool tells_instants(const LidarScan& scan) {
  constexpr float kAtOnce_s = 1e-3F;  // 3 cm at 30 m/s
  if (scan.points.empty() || scan.time_s.size() != scan.size()) return false;
  if (!std::all_of(scan.time_s.begin(), scan.time_s.end(), is_near)) return false;
  const auto [first, last] = std::minmax_element(scan.time_s.begin(), scan.time_s.end());
  return *last - *first > kAtOnce_s;
}

}  // namespace

std::size_t drop_points_without_time(LidarScan& scan, const SweepOptions& options) {
  const bool is_asked =
      options.scan_time == ScanTime::points || options.scan_time == ScanTime::as_told;
  if (!is_asked || scan.time_s.size() != scan.size()) return 0;
  std::vector<int> timed;
  for (std::size_t i = 0; i < scan.size(); ++i)
    if (is_near(scan.time_s[i])) timed.push_back(static_cast<int>(i));
  const std::size_t num_dropped = scan.size() - timed.size();
  if (num_dropped == 0) return 0;
  if (options.scan_time == ScanTime::as_told && timed.size() < num_dropped) return 0;
  const LidarScan all = std::move(scan);
  scan = {};
  scan.stamp = all.stamp;
  scan.label = all.label;
  scan.T_vehicle_lidar = all.T_vehicle_lidar;
  scan.points = taken(all.points, timed);
  take_fields(all, timed, scan);
  return num_dropped;
}

std::vector<float> point_times(const LidarScan& scan, const SweepOptions& options,
                               double period_s) {
  if (options.scan_time == ScanTime::none) return {};
  if (options.scan_time == ScanTime::as_told)
    return tells_instants(scan) ? scan.time_s : std::vector<float>{};
  if (options.scan_time == ScanTime::azimuth)
    return period_s > 0 && is_near(static_cast<float>(period_s))
               ? times_by_azimuth(scan, options, period_s)
               : std::vector<float>{};
  if (scan.time_s.size() != scan.size())
    throw std::runtime_error("scan_time = points, but the scans of '" + scan.label +
                             "' have no times of their points: of a spinning scanner choose "
                             "scan_time = azimuth");
  if (!std::all_of(scan.time_s.begin(), scan.time_s.end(), is_near))
    throw std::runtime_error("scan_time = points, but a point of '" + scan.label +
                             "' has no time within a second of its scan's");
  return scan.time_s;
}

double turn_s(const SweepOptions& options, const std::vector<Stamp>& scans, double at_most) {
  if (options.period_ms > 0) return 1e-3 * options.period_ms;
  double shortest_s = at_most;
  for (std::size_t i = 1; i < scans.size(); ++i) {
    const double between_s = seconds_between(scans[i - 1], scans[i]);
    if (between_s > 0 && (shortest_s <= 0 || between_s < shortest_s)) shortest_s = between_s;
  }
  return shortest_s;
}

void deskew(LidarScan& scan, const std::vector<float>& times, const LidarPath& path) {
  if (times.empty()) return;
  constexpr double kStep_s = 0.002;
  const auto [first, last] = std::minmax_element(times.begin(), times.end());
  const double from = *first;
  const auto num_steps = 1 + static_cast<std::size_t>((*last - from) / kStep_s);
  std::vector<Eigen::Matrix<float, 3, 4>> T_k_lidar;
  for (std::size_t i = 0; i <= num_steps; ++i)
    T_k_lidar.emplace_back(
        path(from + static_cast<double>(i) * kStep_s).matrix().topRows<3>().cast<float>());
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const double place = (times[i] - from) / kStep_s;
    const std::size_t step = std::min(static_cast<std::size_t>(place), num_steps - 1);
    const auto share = static_cast<float>(place - static_cast<double>(step));
    // Within a step the pose is all but affine in time.
    const Eigen::Vector4f point = scan.points[i].homogeneous();
    scan.points[i] =
        (1 - share) * (T_k_lidar[step] * point) + share * (T_k_lidar[step + 1] * point);
  }
  scan.time_s = times;
}

}  // namespace lidar_upsampling
