// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <utility>
#include <vector>

#include "lidar_upsampling/scan/azimuth.h"
#include "lidar_upsampling/scan/patch_motions.h"

namespace lidar_upsampling {

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
