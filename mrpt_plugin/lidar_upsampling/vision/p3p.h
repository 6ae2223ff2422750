// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <array>
#include <vector>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// @brief The poses from which three points are seen in three directions: Finsterwalder's pencil of
/// conics (Haralick et al., IJCV 1994), its degenerate member split into lines by eigenvectors
/// (Persson & Nordberg, ECCV 2018), the distances polished by Newton's method. Written in
/// differences of distances, it keeps its digits for objects that fill a narrow angle only.
/// OpenCV's solveP3P finds the same in some 20 times as long, most of what MLESAC would then take.
/// @param bearings unit vectors in the camera frame.
/// @param points metres, in the source frame.
/// @param[out] poses T_camera_source, at most four are appended, all with the points in front of
/// the camera along their bearings; none for points on a line or together.
void solve_p3p(const std::array<Eigen::Vector3d, 3>& bearings,
               const std::array<Eigen::Vector3d, 3>& points, std::vector<Pose>* poses);

}  // namespace lidar_upsampling
