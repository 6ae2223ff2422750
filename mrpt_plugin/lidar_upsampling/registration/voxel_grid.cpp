// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/registration/voxel_grid.h"

#include <cstdint>
#include <stdexcept>
#include <string>
#include <unordered_map>

namespace lidar_upsampling {
namespace {

/// 21 bits per axis: enough for 100 km of 0.1 m cubes.
std::uint64_t voxel_key(const Eigen::Vector3f& point, float per_metre) {
  constexpr double kOffset = 1 << 20;  // positive, what is cut off is the same as by std::floor
  constexpr std::int64_t kMask = (1 << 21) - 1;
  std::uint64_t key = 0;
  for (const float x : {point.x(), point.y(), point.z()}) {
    const auto cell = static_cast<std::int64_t>(static_cast<double>(x * per_metre) + kOffset);
    key = (key << 21) | static_cast<std::uint64_t>(cell & kMask);
  }
  return key;
}

}  // namespace

VoxelGroups group_by_voxel(const std::vector<Eigen::Vector3f>& points, double side_m) {
  if (!(side_m > 0)) {
    throw std::invalid_argument("voxel size must be positive, is " + std::to_string(side_m) + " m");
  }
  VoxelGroups groups;
  groups.of_point.reserve(points.size());
  const auto per_metre = static_cast<float>(1 / side_m);
  std::unordered_map<std::uint64_t, int> number_of;
  std::vector<int> counts;
  for (const Eigen::Vector3f& point : points) {
    const int next = static_cast<int>(counts.size());
    const auto [place, is_new] = number_of.try_emplace(voxel_key(point, per_metre), next);
    const int group = place->second;
    if (is_new) {
      groups.means.emplace_back(Eigen::Vector3f::Zero());
      counts.push_back(0);
    }
    groups.means[group] += point;
    ++counts[group];
    groups.of_point.push_back(group);
  }
  for (std::size_t i = 0; i < counts.size(); ++i) groups.means[i] /= static_cast<float>(counts[i]);
  return groups;
}

}  // namespace lidar_upsampling
