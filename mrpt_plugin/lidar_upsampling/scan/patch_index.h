// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "lidar_upsampling/scan/patches.h"

namespace lidar_upsampling {

/// @brief Where the middle and the corners of a patch are, lidar frame.
struct PatchOutline {
  Eigen::Vector3f centre;
  std::array<Eigen::Vector3f, 4> corners;
};

/// @param overlap how far the patch reaches, 1: to its edge.
[[nodiscard]] PatchOutline outline_of(const Patch& patch, float overlap);

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

/// @brief How patches have moved: a position in `motions` for each, -1 for those that do not count.
struct PatchMotions {
  std::vector<Motion> forth;  ///< to where they are now
  std::vector<Motion> back;
  std::vector<int> of_patch;
};

/// @brief The patches of a key scan; those that a mover's outline changes are replaced.
struct PatchSet {
  const std::vector<Patch>& patches;
  const std::vector<PatchOutline>& outlines;
  std::vector<int> replacement;  ///< of each patch, a position in those below; -1: none
  std::vector<Patch> new_patches;
  std::vector<PatchOutline> new_outlines;

  [[nodiscard]] const Patch& patch(int i) const {
    return replacement[i] < 0 ? patches[i] : new_patches[replacement[i]];
  }
  [[nodiscard]] const PatchOutline& outline(int i) const {
    return replacement[i] < 0 ? outlines[i] : new_outlines[replacement[i]];
  }
};

/// @brief Where to look for the patches that a beam may hit: cells of one row and a few columns.
class PatchIndex {
 public:
  PatchIndex(const BeamPattern& pattern, const PatchSet& patches, const PatchMotions& motions);

  /// Calls `visit(patch number)` for those that the cell of row and azimuth touches, in a fixed
  /// order.
  template <typename Visit>
  void visit_cell(int row, float azimuth, Visit visit) const {
    visit_at(row, column_of(azimuth), visit);
  }

  /// The same for the cells around; a patch may come up several times.
  template <typename Visit>
  void visit_around(int row, float azimuth, Visit visit) const {
    for (int r = std::max(0, row - 1); r <= std::min(num_rows_ - 1, row + 1); ++r)
      for (int c = column_of(azimuth) - 1, last = c + 2; c <= last; ++c) visit_at(r, c, visit);
  }

 private:
  // The rows and columns (unwrapped) that a patch covers.
  struct Footprint {
    int patch = -1;
    std::int16_t first_row = 0, last_row = -1;
    int first_column = 0, last_column = -1;
  };
  // What the patches of one row cover now.
  struct RowPrints {
    int first_row = 0, last_row = -1;
    std::vector<Footprint> prints;
  };
  // The cells of one row.
  struct Row {
    std::vector<int> begin, members;  // of each cell, its patches
  };

  [[nodiscard]] Footprint footprint_of(const BeamPattern& pattern, const PatchOutline& outline,
                                       const Motion& motion, int row) const;
  [[nodiscard]] RowPrints prints_of(const BeamPattern& pattern, const PatchSet& patches,
                                    const PatchMotions& motions, int row) const;
  [[nodiscard]] Row cells_of(const std::vector<RowPrints>& prints, int row) const;
  [[nodiscard]] int column_of(float azimuth) const {
    return static_cast<int>(std::floor(azimuth / column_width_));
  }
  [[nodiscard]] int wrapped(int column) const {
    return (column % num_columns_ + num_columns_) % num_columns_;
  }
  template <typename Visit>
  void visit_at(int row, int column, Visit visit) const {
    const Row& cells = rows_[row];
    const int at = wrapped(column);
    for (int k = cells.begin[at]; k < cells.begin[at + 1]; ++k) visit(cells.members[k]);
  }

  int num_rows_ = 0, num_columns_ = 0;
  float column_width_ = 0;  // radians
  std::vector<Row> rows_;
};

}  // namespace lidar_upsampling
