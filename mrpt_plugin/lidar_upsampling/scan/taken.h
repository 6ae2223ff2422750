// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// The values at these places, in their order; none of none.
template <typename T>
[[nodiscard]] std::vector<T> taken(const std::vector<T>& values, const std::vector<int>& indices) {
  if (values.empty()) return {};
  std::vector<T> result(indices.size());
  for (std::size_t k = 0; k < indices.size(); ++k) result[k] = values[indices[k]];
  return result;
}

/// All that a scan tells of these points but where they are.
inline void take_fields(const LidarScan& from, const std::vector<int>& indices, LidarScan& to) {
  to.intensity = taken(from.intensity, indices);
  to.ring = taken(from.ring, indices);
  to.column = taken(from.column, indices);
  to.time_s = taken(from.time_s, indices);
  to.num_rings = from.num_rings;
  to.num_columns = from.num_columns;
}

}  // namespace lidar_upsampling
