// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/scan/patches.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace lidar_upsampling {
namespace {

// The axes of the beam to a point.
struct BeamAxes {
  BeamAxes(const Eigen::Vector3f& origin, const Eigen::Vector3f& point) {
    const Eigen::Vector3f to_point = point - origin;
    range = to_point.norm();
    inverse_range = 1 / range;
    ahead = to_point * inverse_range;
    const float level = ahead.head<2>().norm(), inverse_level = 1 / level;
    left = Eigen::Vector3f(-ahead.y() * inverse_level, ahead.x() * inverse_level, 0);
    up = Eigen::Vector3f(-ahead.z() * left.y(), ahead.z() * left.x(), level);
  }

  Eigen::Vector3f ahead, left, up;
  float range, inverse_range;
};

// A neighbour as seen along a point's beam: offset to the left and upwards (tangents), inverse
// depth. Planes are linear in these.
struct Sight {
  Sight(const BeamAxes& axes, const Eigen::Vector3f& origin, const Eigen::Vector3f& point) {
    const float x = point.x(), y = point.y(), z = point.z() - origin.z();
    inverse_depth = 1 / (x * axes.ahead.x() + y * axes.ahead.y() + z * axes.ahead.z());
    left = (x * axes.left.x() + y * axes.left.y()) * inverse_depth;
    up = (x * axes.up.x() + y * axes.up.y() + z * axes.up.z()) * inverse_depth;
  }

  float inverse_depth, left, up;
};

// The way from a point to a neighbour of its surface: offset and difference of inverse depth.
struct Step {
  bool is_there = false;
  float offset = 0, rise = 0, slope = 0;
};

// What a point's beam sees of its neighbours. A missing one stands where the point does.
class Surroundings {
  // These come first, as the neighbours are seen by them.
  const std::vector<Eigen::Vector3f>& points_;
  const std::vector<BeamNeighbours>& neighbours_;
  const int* owner_;
  const Eigen::Vector3f& origin_;
  int point_;

 public:
  Surroundings(const std::vector<Eigen::Vector3f>& points,
               const std::vector<BeamNeighbours>& neighbours, const int* owner,
               const Eigen::Vector3f& origin, int point)
      : points_(points),
        neighbours_(neighbours),
        owner_(owner),
        origin_(origin),
        point_(point),
        axes(origin, points[point]),
        near{sight(kRight), sight(kLeft), sight(kDown), sight(kUp)} {}

  // `tilt` is the slope in the direction across.
  [[nodiscard]] Step step(Side side, float tilt) const {
    Step step;
    if (!has_near[side] || !is_own(neighbours_[point_][side])) return step;
    step.is_there = true;
    step.offset = is_upright(side) ? near[side].up : near[side].left;
    step.rise = near[side].inverse_depth - axes.inverse_range -
                tilt * (is_upright(side) ? near[side].left : near[side].up);
    step.slope = step.rise / step.offset;
    return step;
  }

  // How much the slope changes beyond a step; infinitely where there is nothing to tell it.
  [[nodiscard]] float bend_beyond(Side side, float tilt, const Step& step) const {
    constexpr float kUnknown = std::numeric_limits<float>::infinity();
    const int next = neighbours_[point_][side], far = neighbours_[next][side];
    if (far < 0 || !is_own(far)) return kUnknown;
    const Sight beyond(axes, origin_, points_[far]);
    const float left = beyond.left - near[side].left, up = beyond.up - near[side].up;
    const float along = is_upright(side) ? up : left, across = is_upright(side) ? left : up;
    if (along * step.offset <= 0) return kUnknown;
    return (beyond.inverse_depth - near[side].inverse_depth - tilt * across) / along - step.slope;
  }

  BeamAxes axes;
  std::array<Sight, 4> near;       // by side
  std::array<bool, 4> has_near{};  // by side

 private:
  static bool is_upright(Side side) { return side == kDown || side == kUp; }
  [[nodiscard]] Sight sight(Side side) const {
    const int neighbour = neighbours_[point_][side];
    return {axes, origin_, points_[neighbour < 0 ? point_ : neighbour]};
  }

  [[nodiscard]] bool is_own(int other) const {
    return owner_ == nullptr || owner_[other] == owner_[point_];
  }
};

class SlopeRule {
 public:
  SlopeRule(const PatchOptions& options, const Surroundings& around)
      : around_(around),
        metres_(around.axes.range * around.axes.range),  // of depth, per inverse depth
        max_step_(static_cast<float>(options.max_step_m +
                                     options.max_step_per_range * around.axes.range)),
        max_bend_(static_cast<float>(options.max_bend_m +
                                     options.max_bend_per_range * around.axes.range)) {}

  // Change of inverse depth per offset: of both sides where the surface goes straight on, else of
  // the flatter side, as an edge is the steeper one; zero where both are depth edges.
  // @param tilt the slope in the direction across.
  [[nodiscard]] float slope(Side before_side, Side after_side, float tilt) const {
    const Step before = around_.step(before_side, tilt), after = around_.step(after_side, tilt);
    if (before.is_there && after.is_there &&
        is_straight(after.slope - before.slope, after.offset - before.offset))
      return (after.rise - before.rise) / (after.offset - before.offset);
    const bool before_counts = counts(before, before_side, tilt);
    const bool after_counts = counts(after, after_side, tilt);
    if (before_counts && after_counts)
      return std::abs(before.slope) < std::abs(after.slope) ? before.slope : after.slope;
    if (before_counts) return before.slope;
    return after_counts ? after.slope : 0;
  }

 private:
  [[nodiscard]] bool is_straight(float bend, float length) const {
    return 0.5F * metres_ * std::abs(bend * length) < max_bend_;
  }
  // A long step is no depth edge if the surface goes on with the same slope, as the ground does far
  // away.
  [[nodiscard]] bool counts(const Step& step, Side side, float tilt) const {
    return step.is_there && (metres_ * std::abs(step.rise) < max_step_ ||
                             is_straight(around_.bend_beyond(side, tilt, step), 2 * step.offset));
  }

  const Surroundings& around_;
  float metres_, max_step_, max_bend_;
};

Patch patch_of(const Surroundings& around, const Eigen::Vector3f& cell,
               const PatchOptions& options) {
  const BeamAxes& axes = around.axes;
  const SlopeRule rule(options, around);
  const float sideways = rule.slope(kRight, kLeft, 0);
  const float upwards = rule.slope(kDown, kUp, sideways);
  Patch patch;
  patch.frame.row(0) = axes.inverse_range * axes.ahead + sideways * axes.left + upwards * axes.up;
  patch.frame.row(1) = axes.ahead;
  patch.frame.row(2) = axes.left;
  patch.frame.row(3) = axes.up;
  const auto reach = [&](Side side, float offset, float usual, float largest) {
    return 0.5F * (around.has_near[side] ? std::min(offset, largest) : usual);
  };
  constexpr float kAny = std::numeric_limits<float>::infinity();
  patch.inverse_reach =
      Eigen::Array4f(1, -1, 1, -1) /
      Eigen::Array4f(reach(kLeft, around.near[kLeft].left, cell.x(), kAny),
                     reach(kRight, -around.near[kRight].left, cell.x(), kAny),
                     reach(kUp, around.near[kUp].up, cell.z(), 2 * cell.z()),
                     reach(kDown, -around.near[kDown].up, cell.y(), 2 * cell.y()));
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

PatchMaker::PatchMaker(const std::vector<Eigen::Vector3f>& points, const BeamPattern& pattern,
                       const PatchOptions& options)
    : points_(points),
      pattern_(pattern),
      options_(options),
      neighbours_(points.size()),
      cells_(pattern.num_rows()) {
  tbb::parallel_for(0, pattern.num_rows(), [&](int row) {
    cells_[row] = cell_of(pattern, row);
    find_neighbours(pattern, row, neighbours_);
  });
}

Patch PatchMaker::make(int row, int point, const int* owner) const {
  const Eigen::Vector3f &cell = cells_[row], origin = pattern_.rows[row].origin();
  Surroundings around(points_, neighbours_, owner, origin, point);
  const float tiny = 0.05F * cell.x();
  around.has_near = {around.near[kRight].left<-tiny, around.near[kLeft].left> tiny,
                     around.near[kDown].up<-0.2F * cell.y(), around.near[kUp].up> 0.2F * cell.z()};
  // Cells of rows that do not rise have negative heights, which a missing one would pass.
  for (const Side side : {kRight, kLeft, kDown, kUp})
    if (neighbours_[point][side] < 0) around.has_near[side] = false;
  return patch_of(around, cell, options_);
}

}  // namespace lidar_upsampling
