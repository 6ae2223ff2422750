// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

#include "lidar_upsampling/registration/point_index.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// Distances between two point clouds at full resolution: nothing sampled, nothing cropped.
struct Chamfer {
  double forward_m = 0;       ///< mean distance of a point of the first cloud to the second
  double backward_m = 0;      ///< mean distance of a point of the second cloud to the first
  double forward_sq_m2 = 0;   ///< mean squared distance, first to second
  double backward_sq_m2 = 0;  ///< mean squared distance, second to first

  /// Mean of both directions, metres.
  [[nodiscard]] double mean_m() const { return 0.5 * (forward_m + backward_m); }
  /// Both directions added, square metres (the paper's eq. for CD, and pytorch3d's).
  [[nodiscard]] double sum_sq_m2() const { return forward_sq_m2 + backward_sq_m2; }
};

/// @brief In parallel; the same figures for any number of threads.
/// @throw std::invalid_argument one of the clouds is empty.
[[nodiscard]] Chamfer compute_chamfer(const std::vector<Eigen::Vector3f>& first,
                                      const std::vector<Eigen::Vector3f>& second);

/// @brief The nearest point of a cloud to each point, in parallel.
/// @param beside where given, squared distances of each point to another cloud. Where that is as
/// near, this distance is told, with no index: a cloud that differs in few points need not be
/// searched anew.
[[nodiscard]] std::vector<PointIndex::Neighbor> nearest_neighbors(
    const std::vector<Eigen::Vector3f>& from, const PointIndex& to,
    const std::vector<float>* beside = nullptr);

/// @brief From the squared distances of each direction.
/// @throw std::invalid_argument one of them is empty.
[[nodiscard]] Chamfer chamfer_of(const std::vector<float>& forward_sq,
                                 const std::vector<float>& backward_sq);

}  // namespace lidar_upsampling
