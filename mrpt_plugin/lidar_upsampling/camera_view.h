// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <memory>
#include <vector>

#include "lidar_upsampling/config.h"
#include "lidar_upsampling/objects/point_tracks.h"
#include "lidar_upsampling/se3.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// A picture, its instant on the LiDAR's clock, and what is computed from it once.
struct Picture {
  CameraImage image;
  Stamp instant;
  ImagePyramid pyramid;
};

/// An object of the key scan, as a camera follows it.
struct FollowedObject {
  std::vector<int> points;  ///< indices into the key scan, followed or not
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  ///< lidar frame at k
  double time_s = 0;           ///< of its points' own measurement, from the key scan's stamp
  Twist rate = Twist::Zero();  ///< motion over ground per second, lidar frame at k, by which its
                               ///< points were put on the anchor
};

/// @brief One camera's memory: its last picture, and what is followed on it since the key scan.
struct CameraView {
  explicit CameraView(Camera camera_in) : camera(std::move(camera_in)) {}

  Camera camera;
  std::shared_ptr<const Picture> last;
  std::shared_ptr<const Picture> of_key;  ///< taken about when the key scan was; null: none yet
  std::shared_ptr<const Picture>
      anchor;            ///< where the key scan's points were put; null: nowhere yet
  double anchor_dt = 0;  ///< s from the key scan to the anchor
  std::vector<FollowedObject> objects;
  PointTracks points;
};

[[nodiscard]] Pose T_camera_lidar_of(const Camera& camera, const Pose& T_vehicle_lidar);

}  // namespace lidar_upsampling
