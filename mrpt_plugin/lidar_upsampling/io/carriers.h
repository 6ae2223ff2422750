// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/obs/CObservation.h>

#include <optional>
#include <string>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// The MRPT class that scans travel in. `automatic` is `range_scan_3d`, which keeps ring and column
/// and is read, mapped and drawn by every MRPT 2; `same` is the class of the real scans where it
/// can hold points, else `automatic`; `velodyne` has no name of its own in settings, as MRPT from
/// 2.13.2 on erases such points on the way to a map. Of a depth camera both make depth images
/// (scan_classes.h), `automatic` with points, which MRPT's maps need.
enum class Carrier { automatic, range_scan_3d, point_cloud, velodyne, same };

/// "auto", "3drangescan", "pointcloud", "same". @throw std::invalid_argument with the choices.
[[nodiscard]] Carrier carrier_from_string(const std::string& name);

/// Whether the observation can hold a 3D scan (CObservationPointCloud, 3DRangeScan, VelodyneScan,
/// RotatingScan).
[[nodiscard]] bool is_lidar_scan(const mrpt::obs::CObservation& observation);

/// @brief The points of a scan observation, in the lidar frame, with every per-point field it has:
/// intensity scaled to [0, 1], ring counted from the lowest beam, column, time. Points that are not
/// finite, lie 1000 km away or in the origin (MRPT's "no return") are left out.
/// Loads external storage, and unloads it again.
/// @return none if `is_lidar_scan` is false.
/// @throw std::runtime_error naming label and stamp: external file missing or broken.
[[nodiscard]] std::optional<LidarScan> scan_from_observation(
    const mrpt::obs::CObservation& observation);

/// @brief A stock observation that holds the scan, embedded, ready for 3D display and mapping.
/// 3DRangeScan: `points3D`; ring and column in `points3D_idxs_*`; 8-bit intensity in a ring x
/// column image. PointCloud: what this MRPT's points maps can store.
/// @param like a real scan's observation, read for `automatic` and `same`; may be null.
[[nodiscard]] mrpt::obs::CObservation::Ptr observation_from_scan(
    const LidarScan& scan, Carrier carrier, const mrpt::obs::CObservation* like = nullptr);

}  // namespace lidar_upsampling
