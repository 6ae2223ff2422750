// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <memory>
#include <vector>

#include "lidar_upsampling/registration/point_index.h"

namespace lidar_upsampling {

/// @brief All of the points, or `max_points` of them at even steps of their order.
[[nodiscard]] std::vector<Eigen::Vector3f> evenly_thinned(
    const std::vector<Eigen::Vector3f>& points, std::size_t max_points);

struct NormalOptions {
  int num_neighbors = 10;
  double min_radius_m = 0.1;   ///< where all of these lie within, those as far again are asked, too
  double max_radius_m = 2.0;   ///< neighbours further away do not count
  double max_flatness = 0.15;  ///< smallest over middle eigenvalue of the neighbours' scatter
  double min_width = 0.01;     ///< middle over largest eigenvalue: less is a line
};

/// @brief A point cloud that knows the surface's normal at each point: by principal components of
/// the neighbours, made when first asked for, as registration asks for few. Safe from any number of
/// threads.
class Surface {
 public:
  explicit Surface(std::vector<Eigen::Vector3f> points, const NormalOptions& options = {});
  ~Surface();
  Surface(Surface&&) noexcept;
  Surface& operator=(Surface&&) noexcept;

  [[nodiscard]] const std::vector<Eigen::Vector3f>& points() const { return index_.points(); }
  /// @param max_sq_distance as PointIndex has it.
  [[nodiscard]] PointIndex::Neighbor nearest(
      const Eigen::Vector3f& query,
      float max_sq_distance = std::numeric_limits<float>::max()) const {
    return index_.nearest(query, max_sq_distance);
  }
  /// @param max_sq_distance as PointIndex has it.
  [[nodiscard]] PointIndex::Nearest nearest_of_all(const Eigen::Vector3f& query,
                                                   float max_sq_distance) const {
    return index_.nearest_of_all(query, max_sq_distance);
  }
  /// Unit length; zero where the neighbours form no plane.
  [[nodiscard]] Eigen::Vector3f normal(int point) const;
  /// m, to the nearest other point that lies beside rather than above or below, as surfaces slide
  /// level; where there is none near, to the farthest that was asked, as it is no less; infinite
  /// without another point.
  [[nodiscard]] float spacing(int point) const;

 private:
  struct Known;  // normals so far; std::once_flag wakes others at a system call each

  PointIndex index_;
  NormalOptions options_;
  std::unique_ptr<Known> known_;
};

}  // namespace lidar_upsampling
