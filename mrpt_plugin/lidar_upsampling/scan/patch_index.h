// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "lidar_upsampling/scan/patches.h"

namespace lidar_upsampling {

/// @brief Where to look for the patches that a beam may hit: cells of one row and a few columns.
class PatchIndex {
 public:
  /// @param patches as they are now; @param is_part of each, whether it counts.
  /// @param overlap how far a patch reaches, 1: to its edge.
  PatchIndex(const BeamPattern& pattern, const std::vector<Patch>& patches,
             const std::vector<std::uint8_t>& is_part, float overlap);

  /// Calls `visit(patch number)` for those that the cell of row and azimuth touches, in ascending
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
  [[nodiscard]] int column_of(float azimuth) const {
    return static_cast<int>(std::floor(azimuth / column_width_));
  }
  [[nodiscard]] std::size_t cell(int row, int column) const {
    const int wrapped = (column % num_columns_ + num_columns_) % num_columns_;
    return static_cast<std::size_t>(row) * num_columns_ + wrapped;
  }
  template <typename Visit>
  void visit_at(int row, int column, Visit visit) const {
    const std::size_t at = cell(row, column);
    for (int k = begin_[at]; k < begin_[at + 1]; ++k) visit(members_[k]);
  }

  int num_rows_ = 0, num_columns_ = 0;
  float column_width_ = 0;            // radians
  std::vector<int> begin_, members_;  // of each cell, its patches
};

}  // namespace lidar_upsampling
