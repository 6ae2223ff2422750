// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <map>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// What moves, in the LiDAR's frame of a scan.
struct Mover {
  int track = -1;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< over ground
};

/// A scan to be seen from above.
struct BirdScene {
  std::string title;
  std::vector<Eigen::Vector3f> points;
  std::vector<int> mover_of;  ///< of each point, the track of what moves, -1: none
  std::vector<Mover> movers;
  Pose T_rest_lidar = Pose::Identity();
};

[[nodiscard]] BirdScene scene_of(const VirtualScan& scan);
/// The real scan that a virtual one was made of, with what is known to move by then.
[[nodiscard]] BirdScene scene_of_key(const VirtualScan& scan, const LidarScan& key);
/// A real scan as the sensor took it, nothing known of what moves.
[[nodiscard]] BirdScene scene_of(const LidarScan& scan);

/// Where movers were before, by track, in the frame at rest.
class Trails {
 public:
  void remember(const BirdScene& scene);
  [[nodiscard]] const std::vector<Eigen::Vector3d>* of(int track) const;

 private:
  std::map<int, std::vector<Eigen::Vector3d>> trails_;
};

/// The ground from above: x forward is up, y left is left.
struct BirdView {
  double ahead_m = 62, behind_m = 10, aside_m = 32;
  double pixels_per_m = 14;

  /// Wide enough for nearly all of a scan.
  static BirdView for_scan(const LidarScan& scan, int width_px);
  [[nodiscard]] cv::Size size() const;
  [[nodiscard]] cv::Point2d at(const Eigen::Vector3d& p) const;
};

/// @param before drawn in gray below, if not null: a real scan as it was taken.
/// @param cameras on `T_vehicle_lidar`, whose view is marked.
[[nodiscard]] cv::Mat from_above(const BirdScene& scene, const LidarScan* before,
                                 const Trails& trails, const std::vector<Camera>& cameras,
                                 const Pose& T_vehicle_lidar, const BirdView& view);

}  // namespace lidar_upsampling
