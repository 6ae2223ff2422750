// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <string>
#include <vector>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// What becomes of the points that no camera sees: moved by the ego-motion, or left out.
enum class OutsideView { ego, drop };

/// Whether moving objects are part of the virtual scan: `drop` gives the static world only.
enum class MovingObjects { keep, drop };

struct ComposeOptions {
  OutsideView outside_view = OutsideView::ego;
  MovingObjects objects = MovingObjects::keep;
};

/// What a virtual scan is made of, besides the key scan.
struct ScanMotion {
  Stamp stamp;                                ///< of the image
  Pose T_lidar_t_lidar_k = Pose::Identity();  ///< static scene
  bool ego_extrapolated = false;
  std::vector<ObjectMotion> objects;
  std::vector<Camera> cameras;     ///< those that saw the scene at `stamp`
  std::vector<int> left_out = {};  ///< points of the key scan that the virtual one is to be without
};

/// @brief Whose motion each point of the key scan takes, the static scene's or an object's, and
/// which points are left out: a virtual scan but for its points. A point that two objects claim
/// (seen by two cameras) goes to the one with more inliers.
/// @param output_label the sensor label of the virtual scan.
[[nodiscard]] VirtualScan assign_points(const LidarScan& key_scan, ScanMotion motion,
                                        const std::string& output_label,
                                        const ComposeOptions& options);

/// @brief The points as they would be at the image's instant: static ones moved by T_S (paper,
/// eq. 4), each object's by its own T_D (eq. 5). Intensity, ring, column and time stay with them.
/// @param scan by assign_points() of this key scan.
void move_points(const LidarScan& key_scan, VirtualScan& scan);

/// @brief Both.
[[nodiscard]] VirtualScan compose_virtual_scan(const LidarScan& key_scan, ScanMotion motion,
                                               const std::string& output_label,
                                               const ComposeOptions& options);

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
