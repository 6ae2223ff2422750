// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/scan/patches.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lidar_upsampling {
namespace {

// A neighbour as seen along a point's beam: offsets to the left and upwards (tangents), inverse
// depth. Planes are linear in these.
struct Sight {
  bool is_there = false;
  bool is_same_owner = false;
  float x = 0, y = 0, inverse_depth = 0;
};

// What the beam of the point whose patch is made sees.
class View {
 public:
  View(const LidarScan& scan, const std::vector<int>& owner, int point,
       const Eigen::Vector3f& origin)
      : scan_(scan), owner_(owner), point_(point) {
    patch.origin = origin;
    const Eigen::Vector3f to_point = scan.points[point] - origin;
    range = to_point.norm();
    const Eigen::Vector3f ahead = to_point / range;
    const Eigen::Vector3f left = Eigen::Vector3f(-ahead.y(), ahead.x(), 0).normalized();
    patch.axes.col(0) = ahead;
    patch.axes.col(1) = left;
    patch.axes.col(2) = ahead.cross(left);
  }

  [[nodiscard]] Sight see(int neighbour) const {
    Sight sight;
    if (neighbour < 0) return sight;
    const Eigen::Vector3f q = patch.axes.transpose() * (scan_.points[neighbour] - patch.origin);
    if (q.x() <= 0) return sight;
    sight.is_there = true;
    sight.is_same_owner = owner_[neighbour] == owner_[point_];
    sight.x = q.y() / q.x();
    sight.y = q.z() / q.x();
    sight.inverse_depth = 1 / q.x();
    return sight;
  }

  Patch patch;
  float range = 0;

 private:
  const LidarScan& scan_;
  const std::vector<int>& owner_;
  int point_;
};

// The way to a neighbour of the same surface: offset and difference of inverse depth, and how much
// its slope changes beyond.
struct Step {
  bool is_there = false;
  float offset = 0, rise = 0;
  float bend = std::numeric_limits<float>::infinity();

  [[nodiscard]] float slope() const { return rise / offset; }
};

class SlopeRule {
 public:
  SlopeRule(const PatchOptions& options, float range)
      : metres_(range * range),  // of depth, per inverse depth
        max_step_(static_cast<float>(options.max_step_m + options.max_step_per_range * range)),
        max_bend_(static_cast<float>(options.max_bend_m + options.max_bend_per_range * range)) {}

  // Change of inverse depth per offset: of both sides where the surface goes straight on, else of
  // the flatter side, as an edge is the steeper one; zero where both are depth edges.
  [[nodiscard]] float slope(const Step& before, const Step& after) const {
    if (before.is_there && after.is_there &&
        is_straight(after.slope() - before.slope(), after.offset - before.offset))
      return (after.rise - before.rise) / (after.offset - before.offset);
    const bool before_counts = counts(before), after_counts = counts(after);
    if (before_counts && after_counts)
      return std::abs(before.slope()) < std::abs(after.slope()) ? before.slope() : after.slope();
    if (before_counts) return before.slope();
    return after_counts ? after.slope() : 0;
  }

 private:
  [[nodiscard]] bool is_straight(float bend, float length) const {
    return 0.5F * metres_ * std::abs(bend * length) < max_bend_;
  }
  // A long step is no depth edge if the surface goes on with the same slope, as the ground does far
  // away.
  [[nodiscard]] bool counts(const Step& step) const {
    return step.is_there &&
           (metres_ * std::abs(step.rise) < max_step_ || is_straight(step.bend, 2 * step.offset));
  }

  float metres_, max_step_, max_bend_;
};

// `tilt` is the slope in the direction `across` this one.
struct Direction {
  float Sight::*along;
  float Sight::*across;
  float inverse_depth, tilt;

  [[nodiscard]] Step step(const Sight& near, const Sight& far) const {
    Step step;
    if (!near.is_there || !near.is_same_owner) return step;
    step.is_there = true;
    step.offset = near.*along;
    step.rise = near.inverse_depth - inverse_depth - tilt * near.*across;
    if (!far.is_there || !far.is_same_owner) return step;
    const float further = far.*along - near.*along;
    if (further * step.offset <= 0) return step;
    const float rise = far.inverse_depth - near.inverse_depth - tilt * (far.*across - near.*across);
    step.bend = rise / further - step.slope();
    return step;
  }
};

Patch make_patch(View view, const BeamNeighbours& neighbours, const Eigen::Vector3f& cell,
                 const PatchOptions& options) {
  Patch& patch = view.patch;
  const float inverse = 1 / view.range, tiny = 0.05F * cell.x();
  const SlopeRule rule(options, view.range);
  Sight right = view.see(neighbours.right[0]), left = view.see(neighbours.left[0]);
  Sight down = view.see(neighbours.down[0]), up = view.see(neighbours.up[0]);
  right.is_there = right.is_there && right.x < -tiny;
  left.is_there = left.is_there && left.x > tiny;
  down.is_there = down.is_there && down.y < -0.2F * cell.y();
  up.is_there = up.is_there && up.y > 0.2F * cell.z();

  const Direction along{&Sight::x, &Sight::y, inverse, 0};
  const float sideways = rule.slope(along.step(right, view.see(neighbours.right[1])),
                                    along.step(left, view.see(neighbours.left[1])));
  const Direction across{&Sight::y, &Sight::x, inverse, sideways};
  const float upwards = rule.slope(across.step(down, view.see(neighbours.down[1])),
                                   across.step(up, view.see(neighbours.up[1])));
  patch.slope = patch.axes * Eigen::Vector3f(inverse, sideways, upwards);

  patch.right = 0.5F * (right.is_there ? -right.x : cell.x());
  patch.left = 0.5F * (left.is_there ? left.x : cell.x());
  patch.down = 0.5F * (down.is_there ? std::min(-down.y, 2 * cell.y()) : cell.y());
  patch.up = 0.5F * (up.is_there ? std::min(up.y, 2 * cell.z()) : cell.z());
  return patch;
}

// Angles between the beams of a row (x), to the row below (y) and above (z).
Eigen::Vector3f cell_of(const BeamPattern& pattern, int row) {
  const auto elevation = [&](int r) { return std::atan(pattern.rows[r].tan_elevation); };
  const int last = pattern.num_rows() - 1;
  const float below = row > 0 ? elevation(row) - elevation(row - 1) : elevation(1) - elevation(0);
  const float above = row < last ? elevation(row + 1) - elevation(row) : below;
  return {pattern.azimuth_pitch * std::cos(elevation(row)), below, above};
}

}  // namespace

PatchMaker::PatchMaker(const LidarScan& scan, const BeamPattern& pattern,
                       const PatchOptions& options)
    : scan_(scan),
      pattern_(pattern),
      options_(options),
      neighbours_(scan.size()),
      row_(scan.size()),
      cells_(pattern.num_rows()) {
  tbb::parallel_for(0, pattern.num_rows(), [&](int r) {
    const BeamRow& row = pattern.rows[r];
    cells_[r] = cell_of(pattern, r);
    const std::vector<BeamNeighbours> found = find_neighbours(pattern, r);
    for (int k = row.begin; k < row.end; ++k) {
      neighbours_[pattern.order[k]] = found[k - row.begin];
      row_[pattern.order[k]] = static_cast<std::uint16_t>(r);
    }
  });
}

Patch PatchMaker::make(int point, const std::vector<int>& owner) const {
  const int row = row_[point];
  return make_patch({scan_, owner, point, pattern_.rows[row].origin()}, neighbours_[point],
                    cells_[row], options_);
}

std::vector<Patch> PatchMaker::make_all(const std::vector<int>& owner) const {
  std::vector<Patch> patches(scan_.size());
  tbb::parallel_for(0, pattern_.num_rows(), [&](int r) {
    for (int k = pattern_.rows[r].begin; k < pattern_.rows[r].end; ++k)
      patches[pattern_.order[k]] = make(pattern_.order[k], owner);
  });
  return patches;
}

}  // namespace lidar_upsampling
