// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/vision/visibility.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "lidar_upsampling/checks.h"

namespace lidar_upsampling {
namespace {

constexpr int kGrainSize = 1024;

/// Values that are read four at a time, with room for reading on from the last one.
using ByFours = std::vector<float>;
using Four = Eigen::Map<const Eigen::Array4f>;

/// The points of a picture sorted into cells of the size of half a neighbourhood, row by row.
class PixelGrid {
 public:
  PixelGrid(const std::vector<ProjectedPoint>& points, const Neighbourhood& neighbourhood)
      : half_width(static_cast<float>(neighbourhood.half_width_px)),
        half_height(static_cast<float>(neighbourhood.half_height_px)) {
    require(half_width > 0, "visibility: half_width_px must be positive", half_width);
    require(half_height > 0, "visibility: half_height_px must be positive", half_height);
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

  /// Points of neighbouring cells of a row.
  struct Stretch {
    int begin = 0, end = 0;
  };
  /// All that may be neighbours of a cell's points; some of the three are empty at the border.
  using Block = std::array<Stretch, 3>;
  [[nodiscard]] Block around(int middle) const {
    const int c = middle % num_columns_, r = middle / num_columns_;
    const int first = std::max(0, c - 1), last = std::min(num_columns_ - 1, c + 1);
    Block block;
    for (int k = std::max(0, r - 1); k <= std::min(num_rows_ - 1, r + 1); ++k)
      block[k - r + 1] = {cell_start_[k * num_columns_ + first],
                          cell_start_[k * num_columns_ + last + 1]};
    return block;
  }

  const float half_width, half_height;
  std::vector<int> source, cell, index;  ///< of each point: in the order given; in the scan
  ByFours u, v, depth;

 private:
  [[nodiscard]] int column(float x) const { return static_cast<int>((x - left_) / half_width); }
  [[nodiscard]] int row(float y) const { return static_cast<int>((y - top_) / half_height); }

  void sort_into_cells(const std::vector<ProjectedPoint>& points) {
    const std::size_t size = points.size();
    std::vector<int> cell_of(size);
    cell_start_.assign(static_cast<std::size_t>(num_columns_) * num_rows_ + 1, 0);
    for (std::size_t i = 0; i < size; ++i) {
      cell_of[i] = row(points[i].v) * num_columns_ + column(points[i].u);
      ++cell_start_[cell_of[i] + 1];
    }
    for (std::size_t i = 1; i < cell_start_.size(); ++i) cell_start_[i] += cell_start_[i - 1];
    for (auto* whole : {&source, &cell, &index}) whole->resize(size);
    for (auto* values : {&u, &v, &depth}) values->resize(size + 3, 0);
    std::vector<int> next(cell_start_.begin(), cell_start_.end() - 1);
    for (std::size_t i = 0; i < size; ++i) {
      const int place = next[cell_of[i]]++;
      source[place] = static_cast<int>(i);
      cell[place] = cell_of[i];
      index[place] = points[i].index;
      u[place] = points[i].u;
      v[place] = points[i].v;
      depth[place] = points[i].depth;
    }
  }

  float left_ = std::numeric_limits<float>::max();
  float top_ = std::numeric_limits<float>::max();
  int num_columns_ = 0;
  int num_rows_ = 0;
  std::vector<int> cell_start_;
};

struct DepthRange {
  float nearest, farthest;
};

/// Of the point and its neighbours, without branches, as there is no telling who is one.
DepthRange depths_around(const PixelGrid& grid, const PixelGrid::Block& block, int i) {
  constexpr float kFar = 1e30F;  // times what a place is too far by: farther than any depth
  static constexpr std::array<float, 7> kBeyond{0, 0, 0, 0, kFar, kFar, kFar};  // ends a stretch
  Eigen::Array4f nearest = Eigen::Array4f::Constant(grid.depth[i]), farthest = nearest;
  for (const auto& [begin, end] : block)
    for (int k = begin; k < end; k += 4) {
      const Eigen::Array4f du = (Four(&grid.u[k]) - grid.u[i]).abs() - grid.half_width;
      const Eigen::Array4f dv = (Four(&grid.v[k]) - grid.v[i]).abs() - grid.half_height;
      const Eigen::Array4f outside =
          (du.max(dv) * kFar).max(Four(&kBeyond[4 - std::min(4, end - k)]));
      nearest = nearest.min(Four(&grid.depth[k]) + outside);
      farthest = farthest.max(Four(&grid.depth[k]) - outside);
    }
  return {nearest.minCoeff(), farthest.maxCoeff()};
}

/// The neighbours of a point. Offsets in units of the neighbourhood's half size.
struct Neighbours {
  int size = 0;
  ByFours du, dv, depth;

  /// Without branches, too.
  void take(const PixelGrid& grid, const PixelGrid::Block& block, int i) {
    std::size_t most = 4;
    for (const auto& [begin, end] : block) most += end - begin;
    if (du.size() < most)
      for (auto* values : {&du, &dv, &depth}) values->resize(2 * most);
    size = 0;
    for (const auto& [begin, end] : block)
      for (int k = begin; k < end; ++k) {
        du[size] = grid.u[k] - grid.u[i];
        dv[size] = grid.v[k] - grid.v[i];
        depth[size] = grid.depth[k];
        size += static_cast<int>(std::abs(du[size]) <= grid.half_width) &
                static_cast<int>(std::abs(dv[size]) <= grid.half_height) &
                static_cast<int>(grid.index[k] != grid.index[i]);
      }
    for (int k = 0; k < size; k += 4) {
      Eigen::Map<Eigen::Array4f>(&du[k]) /= grid.half_width;
      Eigen::Map<Eigen::Array4f>(&dv[k]) /= grid.half_height;
    }
  }
};

/// The eighth of the full turn that a direction lies in.
unsigned octant(float x, float y) {
  if (y < 0) return 4 + octant(-x, -y);
  if (x > 0) return y < x ? 0 : 1;
  return y > -x ? 2 : 3;
}

/// What is nearer than this may hide a point.
float hiding_depth(float depth) {
  constexpr auto margin = static_cast<float>(0.3), factor = static_cast<float>(1 - 0.03);
  return depth * factor - margin;
}

bool is_hidden(const Neighbours& around, float limit) {
  unsigned nearer_in_octant = 0;
  for (int k = 0; k < around.size; ++k)
    if (around.depth[k] < limit) nearer_in_octant |= 1U << octant(around.du[k], around.dv[k]);
  return (nearer_in_octant & (nearer_in_octant >> 4)) != 0;
}

/// What deviates from the local plane by more is an edge.
float edge_height(float depth) { return static_cast<float>(0.15 + 0.01 * depth); }

/// @param around whose depths are changed to inverse ones, relative to the point's own.
bool is_edge(Neighbours& around, float depth, float limit) {
  // Least-squares plane of the inverse depths: value, slope by du, slope by dv.
  Eigen::Matrix3f normal = Eigen::Matrix3f::Zero();
  Eigen::Vector3f right(1, 0, 0);
  normal(0, 0) = 1 + static_cast<float>(around.size);
  const ByFours &du = around.du, &dv = around.dv, &inverse = around.depth;
  for (int k = 0; k < around.size; k += 4) {
    Eigen::Map<Eigen::Array4f> four(&around.depth[k]);
    four = depth / four;
  }
  for (int k = 0; k < around.size; ++k) {
    normal(1, 0) += du[k];
    normal(2, 0) += dv[k];
    normal(1, 1) += du[k] * du[k];
    normal(2, 1) += du[k] * dv[k];
    normal(2, 2) += dv[k] * dv[k];
    right[0] += inverse[k];
    right[1] += du[k] * inverse[k];
    right[2] += dv[k] * inverse[k];
  }
  normal(0, 1) = normal(1, 0);
  normal(0, 2) = normal(2, 0);
  normal(1, 2) = normal(2, 1);
  normal.diagonal().tail<2>().array() += 1e-3F;  // one row of points leaves slopes free: zero
  const Eigen::Vector3f plane = normal.inverse() * right;
  if (std::abs(1 - plane[0]) * depth > limit) return true;
  for (int k = 0; k < around.size; ++k) {
    const float predicted = plane[0] + plane[1] * du[k] + plane[2] * dv[k];
    if (std::abs(inverse[k] - predicted) * depth > limit) return true;
  }
  return false;
}

Visibility judge(const std::vector<ProjectedPoint>& points, const Neighbourhood& neighbourhood,
                 bool hidden, bool edges) {
  const PixelGrid grid(points, neighbourhood);
  Visibility result{std::vector<std::uint8_t>(points.size(), 0),
                    std::vector<std::uint8_t>(points.size(), 0)};
  tbb::parallel_for(
      tbb::blocked_range<int>(0, static_cast<int>(points.size()), kGrainSize), [&](auto range) {
        Neighbours neighbours;
        PixelGrid::Block block;
        for (int i = range.begin(), last_cell = -1; i < range.end(); ++i) {
          if (grid.cell[i] != last_cell) block = grid.around(last_cell = grid.cell[i]);
          const float depth = grid.depth[i];
          const DepthRange depths = depths_around(grid, block, i);
          const bool may_hide = hidden && depths.nearest < hiding_depth(depth);
          // Most neighbourhoods are flat and facing the camera: no need for their plane.
          const bool may_be_edge = edges && depths.farthest - depths.nearest >= edge_height(depth);
          if (!may_hide && !may_be_edge) continue;
          neighbours.take(grid, block, i);
          if (may_hide) result.hidden[grid.source[i]] = is_hidden(neighbours, hiding_depth(depth));
          if (may_be_edge)
            result.on_edge[grid.source[i]] = is_edge(neighbours, depth, edge_height(depth));
        }
      });
  return result;
}

}  // namespace

Visibility mark_visibility(const std::vector<ProjectedPoint>& points,
                           const Neighbourhood& neighbourhood) {
  return judge(points, neighbourhood, true, true);
}

std::vector<std::uint8_t> mark_occluded(const std::vector<ProjectedPoint>& points,
                                        const Neighbourhood& neighbourhood) {
  return judge(points, neighbourhood, true, false).hidden;
}

std::vector<std::uint8_t> mark_depth_edges(const std::vector<ProjectedPoint>& points,
                                           const Neighbourhood& neighbourhood) {
  return judge(points, neighbourhood, false, true).on_edge;
}

}  // namespace lidar_upsampling
