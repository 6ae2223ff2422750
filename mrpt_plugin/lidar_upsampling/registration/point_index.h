// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// @brief A k-d tree over points that it owns, shared by its copies. Queries are safe from any
/// number of threads.
class PointIndex {
 public:
  struct Neighbor {
    int index = -1;         ///< into points(); -1: there is none
    float sq_distance = 0;  ///< where there is none, that asked for
  };

  explicit PointIndex(std::vector<Eigen::Vector3f> points);

  [[nodiscard]] const std::vector<Eigen::Vector3f>& points() const;

  /// @param max_sq_distance farther points are not looked for, which is faster: then there is none.
  [[nodiscard]] Neighbor nearest(const Eigen::Vector3f& query,
                                 float max_sq_distance = std::numeric_limits<float>::max()) const;

  struct Nearest {
    Neighbor first;
    float sq_others = 0;  ///< no other point lies nearer, as far as was looked
  };
  /// The nearest, and how far all others are at least.
  [[nodiscard]] Nearest nearest_of_all(const Eigen::Vector3f& query, float max_sq_distance) const;

  /// Fills `neighbors` with the k nearest (fewer if there are not so many), nearest first.
  void nearest(const Eigen::Vector3f& query, int k, std::vector<Neighbor>& neighbors) const;

  /// Fills `neighbors` with all that lie nearer, in no certain order.
  void within(const Eigen::Vector3f& query, float max_sq_distance,
              std::vector<Neighbor>& neighbors) const;

 private:
  struct Tree;
  std::shared_ptr<const Tree> tree_;
};

}  // namespace lidar_upsampling
