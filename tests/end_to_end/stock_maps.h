// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/maps/CSimpleMap.h>

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "pipeline.h"

namespace lidar_upsampling {

/// Change of the street: scans of few points, as these programs take their time over each.
inline constexpr const char* kFewBeams = "[lidar]\nrings = 16\ncolumns = 300\n";

/// In place of the street's LiDAR.
inline constexpr const char* kDepthCamera = R"(
[lidar]
type = depth_camera
label = DEPTH
width = 160
height = 120
fx = 145
max_range_m = 14
position_m = 1.5 0.05 1.1
)";

/// Points that are the same but for what writing as text has rounded.
inline constexpr double kRounding_m = 0.002;

inline bool is_installed(const std::string& program) {
  return run("command -v " + program).status == 0;
}

/// MRPT before 2.11.3 inserts a CObservationPointCloud as if the vehicle stood in the origin.
[[nodiscard]] bool maps_misplace_point_clouds();

/// An observation in a simplemap, and what a points map can take of it: the points that it carries
/// itself. A range picture without points gives none.
struct MappedScan {
  std::string label;
  bool is_point_cloud = false;
  Pose T_map_vehicle = Pose::Identity();
  std::vector<Eigen::Vector3d> points_in_vehicle;
};

/// The scans of a simplemap, in its order. Fails the test if there is no such file.
[[nodiscard]] std::vector<MappedScan> scans_in_simplemap(const std::string& path);

[[nodiscard]] std::vector<MappedScan> with_label(const std::vector<MappedScan>& scans,
                                                 const std::string& label);

enum class Placing { by_pose, at_origin, as_this_mrpt_does };

/// The points of the scans, in the map.
[[nodiscard]] std::vector<Eigen::Vector3d> placed(const std::vector<MappedScan>& scans,
                                                  Placing placing);

/// The points that a stock program has written, "x y z" in a line.
[[nodiscard]] std::vector<Eigen::Vector3d> read_points(const std::string& path);

/// The one file below the folder whose name ends so; empty if there is none.
[[nodiscard]] std::string file_ending_in(const std::string& folder, const std::string& ending);

/// Share of `points` with one of `others` closer than about `tolerance_m`.
[[nodiscard]] double share_found(const std::vector<Eigen::Vector3d>& points,
                                 const std::vector<Eigen::Vector3d>& others, double tolerance_m);

[[nodiscard]] Eigen::AlignedBox3d extent(const std::vector<Eigen::Vector3d>& points);

/// The largest difference of two boxes' corners.
[[nodiscard]] double difference(const Eigen::AlignedBox3d& a, const Eigen::AlignedBox3d& b);

}  // namespace lidar_upsampling
