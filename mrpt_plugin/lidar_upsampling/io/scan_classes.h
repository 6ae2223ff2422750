// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationRotatingScan.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

#include "lidar_upsampling/types.h"

/// Scans in each of MRPT's classes. Stamp, label and pose are carriers.h's business; `read_...`
/// adds the valid points and what belongs to them to a scan that has none.
namespace lidar_upsampling {

/// @brief Whether a point was measured: finite, no further away than any LiDAR sees, and not in the
/// origin, which is MRPT's "no return".
[[nodiscard]] inline bool is_measured(const Eigen::Vector3f& point) {
  constexpr float kFarthest = 1e6F;  // m
  return point.allFinite() && point.cwiseAbs().maxCoeff() < kFarthest && !point.isZero(0.F);
}

/// @brief Points embedded, with what this MRPT's points maps store of them (compat/point_fields.h):
/// before 2.11 intensity only, then ring and time, too, from 2.15.4 on all.
[[nodiscard]] mrpt::obs::CObservationPointCloud::Ptr make_point_cloud(const LidarScan& scan);

/// @brief Points, and as far as they are there intensity, ring, time and column, the last found
/// from azimuths where it is not. Intensities above 1 are taken for 8-bit ones.
void read_point_cloud(const mrpt::obs::CObservationPointCloud& observation, LidarScan& scan);

/// @brief Points embedded in `points3D`, ring and column in `points3D_idxs_*`, and the intensity
/// (8 bit) in a ring x column picture, highest ring on top. A scan without rings or columns gets
/// another picture layout, so that its intensities travel all the same. Per-point times have no
/// place there. Points that share a cell share the last one's intensity.
[[nodiscard]] mrpt::obs::CObservation3DRangeScan::Ptr make_range_scan_3d(const LidarScan& scan);

/// @brief Points, ring (picture row, from below), column and intensity. Of a depth camera's range
/// picture without points, the unprojected ones (+X forward).
void read_range_scan_3d(const mrpt::obs::CObservation3DRangeScan& observation, LidarScan& scan);

/// Whether the observation is a depth camera's: a range picture, and the intrinsics that belong to
/// it. Its pixels may be left external and unloaded.
[[nodiscard]] bool is_depth_image(const mrpt::obs::CObservation3DRangeScan& observation);

/// @brief The scan as the depth camera of `like` shows it: a range picture of the same size,
/// intrinsics, kind and unit of ranges. Neighbours on the key scan's picture (ring and column) span
/// a surface, unless there is a depth edge between them; the nearest surface is what a pixel sees,
/// at its own centre. What comes out from behind another surface has no return. Points without
/// neighbours fill the pixel they lie in. With an intensity picture of the same place in `like`,
/// and intensities in the scan, a gray one comes along.
/// @param like a depth image.
/// @param with_points also as `points3D`, one for each pixel with a return.
[[nodiscard]] mrpt::obs::CObservation3DRangeScan::Ptr make_depth_image(
    const LidarScan& scan, const mrpt::obs::CObservation3DRangeScan& like, bool with_points);

/// @brief Points without raw packets: 8-bit intensity, ring as laser id, and per-point times as far
/// as the scan has them.
[[nodiscard]] mrpt::obs::CObservationVelodyneScan::Ptr make_velodyne_scan(const LidarScan& scan);

/// @brief Points of the observation's point cloud, or, if that is empty, of its raw packets, with
/// intensity, ring and time.
/// @throw std::exception raw packets of an unknown model without calibration.
void read_velodyne_scan(const mrpt::obs::CObservationVelodyneScan& observation, LidarScan& scan);

/// @brief Points of the range picture, with intensity, ring and column. The class holds no
/// elevations: they come from MRPT's calibration of the model.
/// @throw std::runtime_error a model that MRPT has no calibration of.
void read_rotating_scan(const mrpt::obs::CObservationRotatingScan& observation, LidarScan& scan);

}  // namespace lidar_upsampling
