// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

#include "lidar_upsampling/scan/patches.h"

namespace lidar_upsampling {

/// @brief How patches have moved. The static scene's motion comes first.
struct PatchMotions {
  /// Goes on with those of another scan's patches.
  void append(const PatchMotions& other);

  static constexpr int kAbsent = -1;  ///< the motion of a patch that does not count

  std::vector<Eigen::Isometry3f> forth;  ///< to where they are now
  std::vector<Eigen::Isometry3f> back;
  std::vector<int> track_id;  ///< of each motion, -1: the static scene
  std::vector<int> of_patch;  ///< a position in those above
};

/// @param position of each point of the key scan, among the patches.
[[nodiscard]] PatchMotions motions_of(const std::vector<int>& position, const VirtualScan& moved);

/// @brief How far the static scene or an object moves, whichever moves most; mean over its points.
[[nodiscard]] double largest_motion(const std::vector<Eigen::Vector3f>& points,
                                    const PatchMotions& motions);

/// The columns of a row that a patch covers.
struct Footprint {
  int patch = -1;
  int first_column = 0, last_column = -1;
};

/// What the patches of one row cover after their motion.
struct FootprintsOfRow {
  Eigen::Vector3f origin = Eigen::Vector3f::Zero();  ///< of the patches' frames
  std::vector<std::vector<Footprint>> on_row;        ///< by the row that they cover now
};

/// @param own whose patches: from `begin` to `end` among all.
/// @param pattern of the beams that are to be covered, which may be another scan's.
/// @param reach of patches, 1: to their edges.
[[nodiscard]] FootprintsOfRow find_footprints(const BeamRow& own, const BeamPattern& pattern,
                                              const Columns& columns, const PatchRefs& patches,
                                              const PatchMotions& motions, float reach);

}  // namespace lidar_upsampling
