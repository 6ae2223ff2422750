// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/vision/visibility.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "lidar_upsampling/checks.h"

namespace lidar_upsampling {
namespace {

constexpr std::size_t kGrainSize = 1024;

/// The points of a picture in cells of the size of half a neighbourhood.
class PixelGrid {
 public:
  PixelGrid(const std::vector<ProjectedPoint>& points, const Neighbourhood& neighbourhood)
      : half_width_(static_cast<float>(neighbourhood.half_width_px)),
        half_height_(static_cast<float>(neighbourhood.half_height_px)) {
    require(half_width_ > 0, "visibility: half_width_px must be positive", half_width_);
    require(half_height_ > 0, "visibility: half_height_px must be positive", half_height_);
    float right = std::numeric_limits<float>::lowest();
    float bottom = right;
    for (const auto& point : points) {
      left_ = std::min(left_, point.u);
      top_ = std::min(top_, point.v);
      right = std::max(right, point.u);
      bottom = std::max(bottom, point.v);
    }
    if (points.empty()) return;
    num_columns_ = column(right) + 1;
    num_rows_ = row(bottom) + 1;
    sort_into_cells(points);
  }

  /// Calls `action(neighbour, du, dv)` for each other point of the neighbourhood.
  template <typename Action>
  void for_each_neighbour(const ProjectedPoint& point, const Action& action) const {
    const int first_column = std::max(0, column(point.u) - 1);
    const int last_column = std::min(num_columns_ - 1, column(point.u) + 1);
    const int last_row = std::min(num_rows_ - 1, row(point.v) + 1);
    for (int r = std::max(0, row(point.v) - 1); r <= last_row; ++r) {
      const auto row_start = static_cast<std::size_t>(r) * static_cast<std::size_t>(num_columns_);
      const int begin = cell_start_[row_start + static_cast<std::size_t>(first_column)];
      const int end = cell_start_[row_start + static_cast<std::size_t>(last_column) + 1];
      for (int i = begin; i < end; ++i) {
        const ProjectedPoint& other = sorted_[static_cast<std::size_t>(i)];
        const float du = other.u - point.u;
        const float dv = other.v - point.v;
        if (std::abs(du) > half_width_ || std::abs(dv) > half_height_) continue;
        if (other.index != point.index) action(other, du / half_width_, dv / half_height_);
      }
    }
  }

 private:
  [[nodiscard]] int column(float u) const { return static_cast<int>((u - left_) / half_width_); }
  [[nodiscard]] int row(float v) const { return static_cast<int>((v - top_) / half_height_); }
  [[nodiscard]] std::size_t cell(const ProjectedPoint& point) const {
    return static_cast<std::size_t>(row(point.v)) * static_cast<std::size_t>(num_columns_) +
           static_cast<std::size_t>(column(point.u));
  }

  void sort_into_cells(const std::vector<ProjectedPoint>& points) {
    cell_start_.assign(
        static_cast<std::size_t>(num_columns_) * static_cast<std::size_t>(num_rows_) + 1, 0);
    for (const auto& point : points) ++cell_start_[cell(point) + 1];
    for (std::size_t i = 1; i < cell_start_.size(); ++i) cell_start_[i] += cell_start_[i - 1];
    std::vector<int> next(cell_start_.begin(), cell_start_.end() - 1);
    sorted_.resize(points.size());
    for (const auto& point : points) {
      sorted_[static_cast<std::size_t>(next[cell(point)]++)] = point;
    }
  }

  float half_width_;
  float half_height_;
  float left_ = std::numeric_limits<float>::max();
  float top_ = std::numeric_limits<float>::max();
  int num_columns_ = 0;
  int num_rows_ = 0;
  std::vector<int> cell_start_;
  std::vector<ProjectedPoint> sorted_;
};

/// The eighth of the full turn that a direction lies in.
unsigned octant(float x, float y) {
  if (y < 0) return 4 + octant(-x, -y);
  if (x > 0) return y < x ? 0 : 1;
  return y > -x ? 2 : 3;
}

template <typename Test>
std::vector<std::uint8_t> mark(const std::vector<ProjectedPoint>& points, const Test& test) {
  std::vector<std::uint8_t> marked(points.size(), 0);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), kGrainSize),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t i = range.begin(); i < range.end(); ++i) {
                        marked[i] = test(points[i]) ? 1 : 0;
                      }
                    });
  return marked;
}

}  // namespace

std::vector<std::uint8_t> mark_occluded(const std::vector<ProjectedPoint>& points,
                                        const Neighbourhood& neighbourhood) {
  const PixelGrid grid(points, neighbourhood);
  // What is nearer by this much, plus this part of the depth, may hide a point.
  constexpr auto margin = static_cast<float>(0.3), factor = static_cast<float>(1 - 0.03);
  return mark(points, [&](const ProjectedPoint& point) {
    unsigned nearer_in_octant = 0;
    const float limit = point.depth * factor - margin;
    grid.for_each_neighbour(point, [&](const ProjectedPoint& other, float du, float dv) {
      if (other.depth < limit) nearer_in_octant |= 1U << octant(du, dv);
    });
    return (nearer_in_octant & (nearer_in_octant >> 4)) != 0;
  });
}

std::vector<std::uint8_t> mark_depth_edges(const std::vector<ProjectedPoint>& points,
                                           const Neighbourhood& neighbourhood) {
  const PixelGrid grid(points, neighbourhood);
  return mark(points, [&](const ProjectedPoint& point) {
    const float depth = point.depth;
    // What deviates from the local plane by more is an edge.
    const float limit = static_cast<float>(0.15 + 0.01 * depth);
    float nearest = depth;
    float farthest = depth;
    // Least-squares plane of the inverse depths, relative to the point's own.
    Eigen::Matrix3f normal = Eigen::Matrix3f::Zero();
    Eigen::Vector3f right(1, 0, 0);
    normal(0, 0) = 1;
    grid.for_each_neighbour(point, [&](const ProjectedPoint& other, float du, float dv) {
      nearest = std::min(nearest, other.depth);
      farthest = std::max(farthest, other.depth);
      const Eigen::Vector3f row(1, du, dv);
      normal += row * row.transpose();
      right += row * (depth / other.depth);
    });
    // Most neighbourhoods are flat and facing the camera: no need for their plane.
    if (farthest - nearest < limit) return false;
    normal.diagonal().tail<2>().array() += 1e-3F;  // one row of points leaves slopes free: zero
    const Eigen::Vector3f plane = normal.inverse() * right;  // value, slope by du, slope by dv
    float deviation = std::abs(1 - plane[0]);
    grid.for_each_neighbour(point, [&](const ProjectedPoint& other, float du, float dv) {
      const float predicted = plane[0] + plane[1] * du + plane[2] * dv;
      deviation = std::max(deviation, std::abs(depth / other.depth - predicted));
    });
    return deviation * depth > limit;
  });
}

}  // namespace lidar_upsampling
