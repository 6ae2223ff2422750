// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

#include "lidar_upsampling/objects/clusters.h"

namespace lidar_upsampling {

/// Two neighbours; `ratio` of their squared distance to the squared reach of the further reaching
/// one.
struct Link {
  int a, b;
  float ratio;
};
using Links = std::vector<Link>;

/// Which points of a selection lie near to each other, by one representative for each voxel.
struct Neighbourhoods {
  std::vector<int> representative;  ///< of each selected point
  int num_representatives = 0;
  std::vector<Links> links;  ///< between representatives, each once, in no certain order
};

/// @param points lidar frame; `indices` are the selected ones.
[[nodiscard]] Neighbourhoods find_neighbours(const std::vector<Eigen::Vector3f>& points,
                                             const std::vector<int>& indices,
                                             const ClusterOptions& options);

}  // namespace lidar_upsampling
