// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/scan/outlines.h"

#include <cmath>
#include <limits>

#include "lidar_upsampling/azimuth.h"

namespace lidar_upsampling {
namespace {

constexpr float kNearest = 0.1F;  // metres from the axis: nearer places have no azimuth to speak of

struct FourPatches {
  explicit FourPatches(const std::array<const Patch*, 4>& patches) {
    const auto lanes = [&](const auto& column_of) -> Eigen::Array44f {
      Eigen::Matrix4f columns;
      for (int lane = 0; lane < 4; ++lane) columns.col(lane) = column_of(*patches[lane]);
      columns.transposeInPlace();
      return columns.array();
    };
    for (int axis = 0; axis < 3; ++axis)
      frame[axis] = lanes([&](const Patch& patch) { return patch.frame.col(axis); });
    inverse_reach = lanes([](const Patch& patch) { return patch.inverse_reach.matrix(); });
  }

  std::array<Eigen::Array44f, 3> frame;  // by axis: a column for each row of Patch::frame
  Eigen::Array44f inverse_reach;         // a column for each side
};

// Corner by corner, lidar frame.
using Outlines = std::array<FourPoints, 4>;

Outlines outlines_of(const FourPatches& patches, float origin_height, float reach) {
  const auto& [fx, fy, fz] = patches.frame;
  const auto plane = [&, &x = fx, &y = fy, &z = fz](int row) -> Four {
    return x.col(row) * x.col(0) + y.col(row) * y.col(0) + z.col(row) * z.col(0);
  };
  const Four ahead = plane(1), left = plane(2), up = plane(3);
  const Eigen::Array44f edge = reach / patches.inverse_reach;
  Outlines outlines;
  for (int corner = 0; corner < 4; ++corner) {
    const Four x = edge.col(corner / 2), y = edge.col(2 + corner % 2);
    // A steep patch would reach to infinity.
    const Four depth = 1 / (ahead + left * x + up * y).max(0.25F * ahead);
    const auto along = [&](const Eigen::Array44f& axis) -> Four {
      return (axis.col(1) + axis.col(2) * x + axis.col(3) * y) * depth;
    };
    outlines[corner] = {along(fx), along(fy), along(fz) + origin_height};
  }
  return outlines;
}

}  // namespace

Covers covers_of(const std::array<const Patch*, 4>& patches, const FourMotions& motions,
                 float origin_height, float reach) {
  Outlines corners = outlines_of(FourPatches(patches), origin_height, reach);
  for (FourPoints& corner : corners) corner = motions * corner;
  const auto sum = [&](Four FourPoints::*axis) -> Four {
    return (corners[0].*axis + corners[2].*axis) + (corners[1].*axis + corners[3].*axis);
  };
  const Four x = 0.25F * sum(&FourPoints::x), y = 0.25F * sum(&FourPoints::y);
  const Four sq_distance = x * x + y * y;
  constexpr float kAny = std::numeric_limits<float>::infinity();
  Four right = Four::Constant(kAny), left = -right;
  Covers covers{right, left, {}, {}, {}, {}};
  for (int k = 3; k >= 0; --k) {  // the first one last, whose distance stays
    const auto& [cx, cy, cz] = corners[k];
    const Four ahead = (cx * x + cy * y).max(0.1F * sq_distance);
    const Four sideways = (cy * x - cx * y) / ahead;
    right = right.min(sideways);
    left = left.max(sideways);
    covers.inverse_distance = 1 / (cx * cx + cy * cy).sqrt();
    const Four tangent = (cz - origin_height) * covers.inverse_distance;
    covers.lowest = covers.lowest.min(tangent);
    covers.highest = covers.highest.max(tangent);
  }
  for (int lane = 0; lane < 4; ++lane) {
    const float azimuth = azimuth_of(x[lane], y[lane]);
    covers.right[lane] = azimuth + right[lane];  // an angle's tangent is the larger one
    covers.left[lane] = azimuth + left[lane];
    covers.is_somewhere[lane] =
        sq_distance[lane] > kNearest * kNearest && std::isfinite(sq_distance[lane]);
  }
  return covers;
}

}  // namespace lidar_upsampling
