// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <utility>
#include <vector>

#include "lidar_upsampling/scan/azimuth.h"
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

/// @brief The patches of a scan, or of several one after the other; those that a mover's outline
/// changes are replaced.
struct PatchSet {
  const std::vector<Patch>& patches;
  std::vector<int> replacement;  ///< of each patch, a position in those below; -1: none
  std::vector<Patch> new_patches;

  [[nodiscard]] const Patch& patch(int i) const {
    return replacement[i] < 0 ? patches[i] : new_patches[replacement[i]];
  }
};

/// The columns of a row that a patch covers.
struct Footprint {
  int patch = -1;
  int first_column = 0, last_column = -1;
};

/// @brief What the patches of one row cover after their motion, by the row that they cover now.
class FootprintsOfRow {
 public:
  FootprintsOfRow() = default;
  /// @param own whose patches: from `begin` to `end` among all.
  /// @param pattern of the beams that are to be covered, which may be another scan's.
  /// @param reach of patches, 1: to their edges.
  FootprintsOfRow(const BeamRow& own, const BeamPattern& pattern, const Columns& columns,
                  const PatchSet& patches, const PatchMotions& motions, float reach);

  /// Of the patches' frames.
  [[nodiscard]] const Eigen::Vector3f& origin() const { return origin_; }

  /// Those on a row, in the order of patches.
  [[nodiscard]] std::pair<const Footprint*, const Footprint*> on_row(int row) const {
    return {prints_.data() + begin_[row], prints_.data() + begin_[row + 1]};
  }

 private:
  Eigen::Vector3f origin_ = Eigen::Vector3f::Zero();
  std::vector<int> begin_;  // of each row
  std::vector<Footprint> prints_;
};

}  // namespace lidar_upsampling
