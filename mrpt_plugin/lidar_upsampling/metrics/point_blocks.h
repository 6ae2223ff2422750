// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// Points in blocks of neighbours, coordinate by coordinate: what lies far away is passed over by
/// the block, what lies near is computed several points at once.
struct PointBlocks {
  static constexpr int kSize = 32;
  using Values = Eigen::Array<float, kSize, 1>;

  struct Block {
    Values x, y, z;
    Eigen::Vector3f min, max;
    int count = kSize;  ///< the places beyond repeat the block's first point

    [[nodiscard]] float sq_distance(const Eigen::Vector3f& point) const {
      return (min - point).cwiseMax(point - max).cwiseMax(0).squaredNorm();
    }
    [[nodiscard]] float sq_distance(const Block& other) const {
      return (min - other.max).cwiseMax(other.min - max).cwiseMax(0).squaredNorm();
    }
    [[nodiscard]] Values sq_distances(const Eigen::Vector3f& point) const {
      return (x - point.x()).square() + (y - point.y()).square() + (z - point.z()).square();
    }
    [[nodiscard]] Eigen::Vector3f point(int i) const { return {x[i], y[i], z[i]}; }
  };
  std::vector<Block> blocks;
};

/// Halves the cloud at the median of its widest side until a block is left. All but the last of
/// the blocks are full. Deterministic, whatever the standard library.
[[nodiscard]] PointBlocks make_point_blocks(const std::vector<Eigen::Vector3f>& points);

}  // namespace lidar_upsampling
