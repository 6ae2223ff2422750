// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <string>
#include <vector>

#include "lidar_upsampling/ego/trajectory.h"

namespace lidar_upsampling {

/// `automatic` tells them apart by the first line: commas, twelve numbers or eight.
enum class PoseFileFormat { automatic, tum, kitti, csv };

struct PoseFileOptions {
  std::string path;  ///< empty: none
  PoseFileFormat format = PoseFileFormat::automatic;
  std::string times;   ///< kitti: file with a time per line
  std::string sensor;  ///< label of the sensor whose poses these are; empty: see below
};

/// The format in force. @throw std::runtime_error the file cannot be read, or is of none.
[[nodiscard]] PoseFileFormat format_of(const PoseFileOptions& options);

/// @brief The vehicle's poses from a file of those of a sensor (T_world_sensor, in any world at
/// rest):
/// - tum: `t x y z qx qy qz qw`, t in UNIX seconds; `#` starts a comment. By custom of the vehicle.
/// - kitti: the 3x4 matrix, row by row, by custom of a camera; the times stand in a file of their
///   own, in seconds since the first scan or UNIX seconds, or there is one line per scan.
/// - csv: a header with `stamp,x,y,z` and `yaw,pitch,roll` (rad) or `qx,qy,qz,qw`, in any order,
///   further columns ignored; stamps in MRPT ticks or UNIX seconds. By custom of the vehicle.
/// @param scans stamps of the log's real scans, for kitti.
/// @param T_vehicle_sensor identity if the poses are the vehicle's.
/// @throw std::runtime_error with file and line: not readable, no number, no rotation, no time.
[[nodiscard]] std::vector<PoseSample> read_pose_file(const PoseFileOptions& options,
                                                     const std::vector<Stamp>& scans,
                                                     const Pose& T_vehicle_sensor);

}  // namespace lidar_upsampling
