// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/registration/voxel_grid.h"

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

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

/// Counts keys by first appearance, by open addressing, as std::unordered_map allocates each.
class KeyNumbers {
 public:
  /// The key's number, a new one's is size() before.
  int of(std::uint64_t key) {
    if (2 * keys_.size() >= places_.size()) grow();
    int& number = places_[place_of(key)];
    if (number < 0) {
      number = static_cast<int>(keys_.size());
      keys_.push_back(key);
    }
    return number;
  }
  [[nodiscard]] std::size_t size() const { return keys_.size(); }

 private:
  /// Where it is, or would be.
  [[nodiscard]] std::size_t place_of(std::uint64_t key) const {
    constexpr std::uint64_t kGolden = 0x9E3779B97F4A7C15;  // Knuth's multiplicative hashing, 6.4
    std::size_t place = (key * kGolden) >> shift_;
    while (places_[place] >= 0 && keys_[places_[place]] != key)
      place = (place + 1) & (places_.size() - 1);
    return place;
  }
  void grow() {
    --shift_;
    places_.assign(2 * places_.size(), -1);
    for (std::size_t i = 0; i < keys_.size(); ++i)
      places_[place_of(keys_[i])] = static_cast<int>(i);
  }

  std::vector<std::uint64_t> keys_;
  std::vector<int> places_ = std::vector<int>(256, -1);
  unsigned shift_ = 64 - 8;  // 2^8 places
};

}  // namespace

VoxelGroups group_by_voxel(const std::vector<Eigen::Vector3f>& points, double side_m) {
  if (!(side_m > 0)) {
    throw std::invalid_argument("voxel size must be positive, is " + std::to_string(side_m) + " m");
  }
  VoxelGroups groups;
  groups.of_point.reserve(points.size());
  const auto per_metre = static_cast<float>(1 / side_m);
  KeyNumbers number;
  std::vector<int> counts;
  for (const Eigen::Vector3f& point : points) {
    const int group = number.of(voxel_key(point, per_metre));
    if (number.size() > counts.size()) {
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
