// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/scan/patch_index.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace lidar_upsampling {
namespace {

constexpr float kTurn = 2 * static_cast<float>(M_PI);
constexpr float kBeamsPerCell = 1;
constexpr float kNearest = 0.1F;  // metres from the axis: nearer places have no azimuth to speak of

}  // namespace

PatchOutline outline_of(const Patch& patch, float overlap) {
  PatchOutline outline;
  const Eigen::Vector3f plane = patch.axes.transpose() * patch.slope;
  outline.centre = patch.origin + patch.axes.col(0) / plane.x();
  auto corner = outline.corners.begin();
  for (const float x : {-patch.right * overlap, patch.left * overlap})
    for (const float y : {-patch.down * overlap, patch.up * overlap}) {
      // A steep patch would reach to infinity.
      const float inverse = std::max(0.25F * plane.x(), plane.dot(Eigen::Vector3f(1, x, y)));
      *corner++ = patch.origin + patch.axes * Eigen::Vector3f(1, x, y) / inverse;
    }
  return outline;
}

PatchIndex::Footprint PatchIndex::footprint_of(const BeamPattern& pattern,
                                               const PatchOutline& outline, const Motion& motion,
                                               int row) const {
  const Eigen::Vector3f centre = motion * outline.centre;
  const float distance = centre.head<2>().norm();
  if (!(distance > kNearest)) return {};
  const Eigen::Vector2f ahead = centre.head<2>() / distance;
  float right = 0, left = 0;
  const int slack = static_cast<int>(std::ceil(2 * pattern.scatter - 0.5F));
  int first_row = pattern.num_rows(), last_row = -1;
  for (const Eigen::Vector3f& outlined : outline.corners) {
    const Eigen::Vector3f corner = motion * outlined;
    const float forward = corner.head<2>().dot(ahead);
    if (forward <= kNearest) continue;
    const float sideways = (corner.y() * ahead.x() - corner.x() * ahead.y()) / forward;
    right = std::min(right, sideways);
    left = std::max(left, sideways);
    row = pattern.first_row_above(corner.head<2>().norm(), corner.z(), row);
    first_row = std::min(first_row, row - slack);
    last_row = std::max(last_row, row - 1 + slack);
  }
  const float azimuth = std::atan2(centre.y(), centre.x());
  Footprint print;
  print.first_row = static_cast<std::int16_t>(std::max(0, first_row));
  print.last_row = static_cast<std::int16_t>(std::min(pattern.num_rows() - 1, last_row));
  print.first_column = column_of(azimuth + right);
  print.last_column = std::min(column_of(azimuth + left), print.first_column + num_columns_ - 1);
  return print;
}

PatchIndex::RowPrints PatchIndex::prints_of(const BeamPattern& pattern, const PatchSet& patches,
                                            const PatchMotions& motions, int row) const {
  RowPrints result;
  result.first_row = pattern.num_rows();
  result.prints.reserve(pattern.rows[row].end - pattern.rows[row].begin);
  for (int k = pattern.rows[row].begin; k < pattern.rows[row].end; ++k) {
    const int i = pattern.order[k], motion = motions.of_patch[i];
    if (motion < 0) continue;
    Footprint print = footprint_of(pattern, patches.outline(i), motions.forth[motion], row);
    if (print.last_row < print.first_row) continue;
    print.patch = i;
    result.first_row = std::min<int>(result.first_row, print.first_row);
    result.last_row = std::max<int>(result.last_row, print.last_row);
    result.prints.push_back(print);
  }
  return result;
}

PatchIndex::Row PatchIndex::cells_of(const std::vector<RowPrints>& prints, int row) const {
  Row cells;
  cells.begin.assign(num_columns_ + 2, 0);
  const auto for_each_cell = [&](const auto& act) {
    for (const RowPrints& from : prints) {
      if (row < from.first_row || row > from.last_row) continue;
      for (const Footprint& print : from.prints)
        if (row >= print.first_row && row <= print.last_row)
          for (int column = print.first_column; column <= print.last_column; ++column)
            act(wrapped(column), print.patch);
    }
  };
  // Counted two places on and filled one place on, the beginnings end up where they belong.
  for_each_cell([&](int at, int) { ++cells.begin[at + 2]; });
  for (int at = 2; at < num_columns_ + 2; ++at) cells.begin[at] += cells.begin[at - 1];
  cells.members.resize(cells.begin.back());
  for_each_cell([&](int at, int patch) { cells.members[cells.begin[at + 1]++] = patch; });
  return cells;
}

PatchIndex::PatchIndex(const BeamPattern& pattern, const PatchSet& patches,
                       const PatchMotions& motions)
    : num_rows_(pattern.num_rows()),
      num_columns_(std::max(3, static_cast<int>(kTurn / (kBeamsPerCell * pattern.azimuth_pitch)))),
      column_width_(kTurn / static_cast<float>(num_columns_)),
      rows_(num_rows_) {
  std::vector<RowPrints> prints(num_rows_);
  tbb::parallel_for(0, num_rows_,
                    [&](int row) { prints[row] = prints_of(pattern, patches, motions, row); });
  tbb::parallel_for(0, num_rows_, [&](int row) { rows_[row] = cells_of(prints, row); });
}

}  // namespace lidar_upsampling
