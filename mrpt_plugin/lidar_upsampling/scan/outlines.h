// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "lidar_upsampling/scan/patches.h"

/// Where moved patches are seen, four at a time, a lane each.
namespace lidar_upsampling {

using Four = Eigen::Array4f;

struct FourPoints {
  Four x, y, z;
};

/// @brief A motion for each lane.
class FourMotions {
 public:
  /// One for all.
  explicit FourMotions(const Eigen::Isometry3f& motion) {
    for (int column = 0; column < 4; ++column)
      for (int row = 0; row < 3; ++row) entry(row, column) = Four::Constant(motion(row, column));
  }
  /// @param lanes which of the motions, for each.
  FourMotions(const std::vector<FourMotions>& motions, const std::array<int, 4>& lanes) {
    for (std::size_t k = 0; k < entries_.size(); ++k)
      for (int lane = 0; lane < 4; ++lane)
        entries_[k][lane] = motions[lanes[lane]].entries_[k][lane];
  }

  [[nodiscard]] FourPoints operator*(const FourPoints& p) const {
    return {moved(p, 0), moved(p, 1), moved(p, 2)};
  }

 private:
  [[nodiscard]] Four& entry(int row, int column) { return entries_[3 * column + row]; }
  [[nodiscard]] Four moved(const FourPoints& p, int row) const {
    return entries_[row] * p.x + entries_[3 + row] * p.y + entries_[6 + row] * p.z +
           entries_[9 + row];
  }

  std::array<Four, 12> entries_;  // of 3x4 matrices, column by column
};

/// What patches cover, in tangents of elevation and azimuths that may lie beyond a turn.
struct Covers {
  Four lowest, highest;
  Four inverse_distance;  ///< 1/m, at which the tangents are seen
  Four right, left;
  std::array<bool, 4> is_somewhere;  ///< false: too near the axis to be anywhere
};

/// @param origin_height of the beams of the patches' row, lidar frame.
/// @param reach of patches, 1: to their edges.
[[nodiscard]] Covers covers_of(const std::array<const Patch*, 4>& patches,
                               const FourMotions& motions, float origin_height, float reach);

}  // namespace lidar_upsampling
