// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/scan/patch_index.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace lidar_upsampling {
namespace {

constexpr float kTurn = 2 * static_cast<float>(M_PI);
constexpr float kBeamsPerCell = 2;
constexpr float kNearest = 0.1F;  // metres from the axis: nearer places have no azimuth to speak of

// The rows and azimuths (unwrapped) that a patch covers.
struct Footprint {
  int first_row = 0, last_row = -1;
  float right = 0, left = 0;
};

Footprint footprint_of(const BeamPattern& pattern, const Patch& patch, int row, float overlap) {
  const Eigen::Vector3f plane = patch.axes.transpose() * patch.slope;
  const Eigen::Vector3f centre = patch.origin + patch.axes.col(0) / plane.x();
  const float distance = centre.head<2>().norm();
  if (!(distance > kNearest)) return {};
  const Eigen::Vector2f ahead = centre.head<2>() / distance;
  float right = 0, left = 0;
  Footprint print{pattern.num_rows(), -1, 0, 0};
  const int slack = static_cast<int>(std::ceil(2 * pattern.scatter - 0.5F));
  for (const float x : {-patch.right * overlap, patch.left * overlap})
    for (const float y : {-patch.down * overlap, patch.up * overlap}) {
      // A steep patch would reach to infinity.
      const float inverse = std::max(0.25F * plane.x(), plane.dot(Eigen::Vector3f(1, x, y)));
      const Eigen::Vector3f corner = patch.origin + patch.axes * Eigen::Vector3f(1, x, y) / inverse;
      const float forward = corner.head<2>().dot(ahead);
      if (forward <= kNearest) continue;
      const float sideways = (corner.y() * ahead.x() - corner.x() * ahead.y()) / forward;
      right = std::min(right, sideways);
      left = std::max(left, sideways);
      const int above = pattern.first_row_above(corner.head<2>().norm(), corner.z(), row);
      print.first_row = std::min(print.first_row, above - slack);
      print.last_row = std::max(print.last_row, above - 1 + slack);
    }
  const float azimuth = std::atan2(centre.y(), centre.x());
  print.first_row = std::max(0, print.first_row);
  print.last_row = std::min(pattern.num_rows() - 1, print.last_row);
  print.right = azimuth + right;
  print.left = azimuth + left;
  return print;
}

}  // namespace

PatchIndex::PatchIndex(const BeamPattern& pattern, const std::vector<Patch>& patches,
                       const std::vector<std::uint8_t>& is_part, float overlap)
    : num_rows_(pattern.num_rows()),
      num_columns_(std::max(3, static_cast<int>(kTurn / (kBeamsPerCell * pattern.azimuth_pitch)))),
      column_width_(kTurn / static_cast<float>(num_columns_)) {
  std::vector<Footprint> prints(patches.size());
  tbb::parallel_for(0, num_rows_, [&](int row) {
    for (int k = pattern.rows[row].begin; k < pattern.rows[row].end; ++k)
      if (const int i = pattern.order[k]; is_part[i] != 0)
        prints[i] = footprint_of(pattern, patches[i], row, overlap);
  });
  const auto for_each_cell = [&](const Footprint& print, const auto& act) {
    const int first = column_of(print.right);
    const int last = std::min(column_of(print.left), first + num_columns_ - 1);
    for (int row = print.first_row; row <= print.last_row; ++row)
      for (int column = first; column <= last; ++column) act(cell(row, column));
  };
  begin_.assign(static_cast<std::size_t>(num_rows_) * num_columns_ + 1, 0);
  for (const Footprint& print : prints)
    for_each_cell(print, [&](std::size_t at) { ++begin_[at + 1]; });
  for (std::size_t at = 1; at < begin_.size(); ++at) begin_[at] += begin_[at - 1];
  members_.resize(begin_.back());
  std::vector<int> next(begin_.begin(), begin_.end() - 1);
  for (int i = 0; i < static_cast<int>(prints.size()); ++i)
    for_each_cell(prints[i], [&](std::size_t at) { members_[next[at]++] = i; });
}

}  // namespace lidar_upsampling
