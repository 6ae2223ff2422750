// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_set>

namespace lidar_upsampling {

/// Which voxels of an endless grid are occupied.
class VoxelSet {
 public:
  /// @param side_m of a voxel; 2^20 of them fit on each side of the origin.
  explicit VoxelSet(double side_m) : side_m_(side_m) {}

  void insert(const Eigen::Vector3d& point) { keys_.insert(key(cell(point))); }

  [[nodiscard]] bool contains(const Eigen::Vector3d& point) const {
    return keys_.count(key(cell(point))) > 0;
  }

  /// Whether the voxel of the point, or one that touches it, is occupied.
  [[nodiscard]] bool has_near(const Eigen::Vector3d& point) const {
    const Cell center = cell(point);
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dz = -1; dz <= 1; ++dz)
          if (keys_.count(key(center + Cell(dx, dy, dz))) > 0) return true;
    return false;
  }

  [[nodiscard]] std::size_t size() const { return keys_.size(); }

  /// Calls use(Eigen::Vector3d) with the centre of each occupied voxel, in no order.
  template <typename Use>
  void for_each_center(const Use& use) const {
    for (const std::uint64_t k : keys_) use(center_of(k));
  }

 private:
  using Cell = Eigen::Matrix<std::int64_t, 3, 1>;
  static constexpr std::int64_t kHalf = 1 << 20, kMask = 2 * kHalf - 1;

  [[nodiscard]] Cell cell(const Eigen::Vector3d& point) const {
    return (point / side_m_).array().floor().cast<std::int64_t>();
  }

  [[nodiscard]] static std::uint64_t key(const Cell& cell) {
    const auto part = [](std::int64_t index) {
      return static_cast<std::uint64_t>((index + kHalf) & kMask);
    };
    return part(cell.x()) << 42U | part(cell.y()) << 21U | part(cell.z());
  }

  [[nodiscard]] Eigen::Vector3d center_of(std::uint64_t key) const {
    const auto index = [&](unsigned shift) {
      return static_cast<double>(static_cast<std::int64_t>(key >> shift & kMask) - kHalf) + 0.5;
    };
    return side_m_ * Eigen::Vector3d(index(42), index(21), index(0));
  }

  double side_m_;
  std::unordered_set<std::uint64_t> keys_;
};

}  // namespace lidar_upsampling
