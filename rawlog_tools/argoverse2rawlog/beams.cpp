// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "argoverse2rawlog/beams.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "lidar_upsampling/units.h"

namespace lidar_upsampling::argoverse {
namespace {

/// Less than the lasers' own spread says nothing about the LiDAR.
constexpr double kDecisive = 0.3 * kDegree;
constexpr double kFewestAgree = 0.9;

constexpr std::array<double, kLasersPerLidar> kElevationsDeg{
    15,     10.333, 7,      4.667,  3.333,  2.333,  1.667,  1.333,  1,       0.667, 0.333,
    0,      -0.333, -0.667, -1,     -1.333, -1.667, -2,     -2.333, -2.667,  -3,    -3.333,
    -3.667, -4,     -4.667, -5.333, -6.148, -7.254, -8.843, -11.31, -15.639, -25};

double elevation(const Eigen::Vector3d& p) { return std::atan2(p.z(), p.head<2>().norm()); }

// Positive where the point fits the upper LiDAR better, radians, one degree at most.
std::vector<double> votes_for_up(const std::vector<Eigen::Vector3d>& points,
                                 const std::vector<int>& lasers, const Calibration& calibration) {
  const Pose T_up = calibration.T_vehicle_up_lidar.inverse();
  const Pose T_down = calibration.T_vehicle_down_lidar.inverse();
  std::vector<double> votes;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double nominal = laser_elevation(lasers[i]);
    const double vote = std::abs(elevation(T_down * points[i]) - nominal) -
                        std::abs(elevation(T_up * points[i]) - nominal);
    votes.push_back(std::clamp(vote, -kDegree, kDegree));
  }
  return votes;
}

/// The points before `end_of_first` belong to one LiDAR, the others to the other.
struct Split {
  std::size_t end_of_first = 0;
  bool up_first = true;

  [[nodiscard]] bool is_up(std::size_t point) const { return (point < end_of_first) == up_first; }
};

// Where the votes of the points before and after contradict each other most.
Split best_split(const std::vector<double>& votes) {
  const double total = std::accumulate(votes.begin(), votes.end(), 0.);
  Split best{0, total < 0};
  double best_score = std::abs(total), before = 0;
  for (std::size_t i = 0; i < votes.size(); ++i) {
    before += votes[i];
    const double score = 2 * before - total;
    if (std::abs(score) <= best_score) continue;
    best_score = std::abs(score);
    best = {i + 1, score > 0};
  }
  return best;
}

bool agrees(const Split& split, const std::vector<double>& votes) {
  std::size_t num_decisive = 0, num_agreeing = 0;
  for (std::size_t i = 0; i < votes.size(); ++i) {
    if (std::abs(votes[i]) < kDecisive) continue;
    ++num_decisive;
    num_agreeing += (votes[i] > 0) == split.is_up(i) ? 1 : 0;
  }
  return static_cast<double>(num_agreeing) >= kFewestAgree * static_cast<double>(num_decisive);
}

// The ring of each laser, the upper LiDAR's first: by its elevation as it is mounted.
std::array<std::uint16_t, kRings> ring_of_beam(const Calibration& calibration) {
  std::array<double, kRings> elevations{};
  for (int laser = 0; laser < kLasersPerLidar; ++laser) {
    const double own = laser_elevation(laser);
    elevations[laser] = own * calibration.T_vehicle_up_lidar.linear()(2, 2);
    elevations[laser + kLasersPerLidar] = own * calibration.T_vehicle_down_lidar.linear()(2, 2);
  }
  std::array<int, kRings> order{};
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return elevations[a] < elevations[b]; });
  std::array<std::uint16_t, kRings> ring{};
  for (int i = 0; i < kRings; ++i) ring[order[i]] = static_cast<std::uint16_t>(i);
  return ring;
}

}  // namespace

double laser_elevation(int laser) { return kElevationsDeg.at(laser) * kDegree; }

std::vector<std::uint16_t> rings_of(const std::vector<Eigen::Vector3d>& points,
                                    const std::vector<int>& lasers,
                                    const Calibration& calibration) {
  for (const int laser : lasers) {
    if (laser < 0 || laser >= kLasersPerLidar) return {};
  }
  const std::vector<double> votes = votes_for_up(points, lasers, calibration);
  const Split split = best_split(votes);
  if (!agrees(split, votes)) return {};
  const auto ring = ring_of_beam(calibration);
  std::vector<std::uint16_t> rings;
  for (std::size_t i = 0; i < points.size(); ++i) {
    rings.push_back(ring[lasers[i] + (split.is_up(i) ? 0 : kLasersPerLidar)]);
  }
  return rings;
}

}  // namespace lidar_upsampling::argoverse
