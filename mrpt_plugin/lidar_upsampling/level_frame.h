// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include "lidar_upsampling/types.h"

/// A LiDAR may sit tilted on its vehicle; road users stay level. So scans are worked on in axes
/// that have the LiDAR's origin and heading, and are level with the vehicle; what comes out is in
/// the LiDAR's own again.
namespace lidar_upsampling {

/// @return R_level_lidar, the identity for a LiDAR that sits level within a degree.
[[nodiscard]] Eigen::Matrix3d level_rotation(const Pose& T_vehicle_lidar);

/// @brief The scan in other axes of the same origin: its points, and of a virtual one all places,
/// motions and poses.
/// @param R_new_old the identity leaves all as it is, to the bit.
void put_in_axes(LidarScan& scan, const Eigen::Matrix3d& R_new_old);
void put_in_axes(VirtualScan& scan, const Eigen::Matrix3d& R_new_old);

}  // namespace lidar_upsampling
