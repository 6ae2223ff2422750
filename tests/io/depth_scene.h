// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>

#include <cmath>
#include <optional>
#include <vector>

#include "lidar_upsampling/io/images.h"
#include "lidar_upsampling/vision/projection.h"

namespace lidar_upsampling {

using mrpt::obs::CObservation3DRangeScan;

inline constexpr int kWidth = 80, kHeight = 60;

/// n . p = d in the lidar frame.
struct SceneWall {
  Eigen::Vector3d normal;
  double distance;
  double left = -100, right = 100;  ///< of y, where it ends
};

/// Of the nearest plane on the ray.
inline std::optional<double> depth_of(const std::vector<SceneWall>& planes,
                                      const Eigen::Vector3d& ray) {
  std::optional<double> nearest;
  for (const SceneWall& plane : planes) {
    const double depth = plane.distance / plane.normal.dot(ray);
    const double y = depth * ray.y();
    if (depth <= 0 || y < plane.left || y > plane.right) continue;
    if (!nearest || depth < *nearest) nearest = depth;
  }
  return nearest;
}

inline const std::vector<SceneWall> kSlantedWall{{Eigen::Vector3d(1, 0.3, -0.2), 4}};
// A board 2 m ahead of a camera that looks at a wall in 5 m.
inline const std::vector<SceneWall> kBoard{{Eigen::Vector3d(1, 0, 0), 2, -0.3, 0.3}};
inline const std::vector<SceneWall> kWall{{Eigen::Vector3d(1, 0, 0), 5}};

inline std::vector<SceneWall> both(std::vector<SceneWall> planes,
                                   const std::vector<SceneWall>& more) {
  planes.insert(planes.end(), more.begin(), more.end());
  return planes;
}

inline CObservation3DRangeScan depth_camera() {
  CObservation3DRangeScan camera;
  camera.sensorLabel = "KINECT";
  camera.sensorPose = mrpt::poses::CPose3D(0.3, 0.1, 1.1, 0.2, 0, 0);
  camera.cameraParams.ncols = kWidth;
  camera.cameraParams.nrows = kHeight;
  camera.cameraParams.setIntrinsicParamsFromValues(70, 72, 39.2, 30.1);
  camera.cameraParamsIntensity = camera.cameraParams;
  camera.maxRange = 12;
  camera.stdError = 0.02F;
  camera.rangeUnits = 0.0005F;
  camera.hasRangeImage = true;
  camera.rangeImage_setSize(kHeight, kWidth);
  return camera;
}

inline Eigen::Vector3d ray_of(const CObservation3DRangeScan& camera, int row, int column) {
  const auto seen = undistort(from_mrpt(camera.cameraParams), Eigen::Vector2d(column, row)).value();
  return {1, -seen.x(), -seen.y()};
}

inline void look_at(const std::vector<SceneWall>& planes, CObservation3DRangeScan& camera) {
  for (int row = 0; row < kHeight; ++row) {
    for (int column = 0; column < kWidth; ++column) {
      const Eigen::Vector3d ray = ray_of(camera, row, column);
      const double depth = depth_of(planes, ray).value_or(0);
      const double range = camera.range_is_depth ? depth : depth * ray.norm();
      camera.rangeImage(row, column) =
          static_cast<std::uint16_t>(std::lround(range / static_cast<double>(camera.rangeUnits)));
    }
  }
}

inline CObservation3DRangeScan looking_at(const std::vector<SceneWall>& planes) {
  CObservation3DRangeScan camera = depth_camera();
  look_at(planes, camera);
  return camera;
}

}  // namespace lidar_upsampling
