// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

#include "lidar_upsampling/scan/patches.h"

namespace lidar_upsampling {

/// R v, written out and inlined, which Eigen's product is not: it is needed a million times a scan.
[[gnu::always_inline]] inline Eigen::Vector3f turned(const Eigen::Matrix3f& R,
                                                     const Eigen::Vector3f& v) {
  return R.col(0) * v.x() + R.col(1) * v.y() + R.col(2) * v.z();
}

/// A rigid motion in single precision.
struct Motion {
  explicit Motion(const Pose& T) : R(T.linear().cast<float>()), t(T.translation().cast<float>()) {}

  [[nodiscard, gnu::always_inline]] Eigen::Vector3f operator*(const Eigen::Vector3f& p) const {
    return turned(R, p) + t;
  }

  Eigen::Matrix3f R;
  Eigen::Vector3f t;
};

/// @brief How patches have moved. The static scene's motion comes first.
struct PatchMotions {
  /// Goes on with those of another scan's patches.
  void append(const PatchMotions& other);

  static constexpr int kAbsent = -1;  ///< the motion of a patch that does not count

  std::vector<Motion> forth;  ///< to where they are now
  std::vector<Motion> back;
  std::vector<int> track_id;  ///< of each motion, -1: the static scene
  std::vector<int> of_patch;  ///< a position in those above
};

/// @param position of each point of the key scan, among the patches.
/// @throw std::invalid_argument a point is of a track that is no object of the virtual scan.
[[nodiscard]] PatchMotions motions_of(const std::vector<int>& position, const VirtualScan& moved);

/// @brief How far the static scene or an object moves, whichever moves most; mean over its points.
[[nodiscard]] double largest_motion(const std::vector<Eigen::Vector3f>& points,
                                    const PatchMotions& motions);

}  // namespace lidar_upsampling
