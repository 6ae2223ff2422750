// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <string>
#include <vector>

#include "import/object_tracks.h"
#include "kitti2rawlog/kitti_drive.h"

namespace lidar_upsampling::kitti {

/// One object of a drive's `tracklet_labels.xml`, labelled in consecutive scans.
struct Tracklet {
  struct Placed {
    Pose T_lidar_object = Pose::Identity();  ///< of the box's centre, +X along its length
    bool hidden = false;                     ///< labelled as fully occluded
  };
  std::string type;
  Eigen::Vector3d size = Eigen::Vector3d::Zero();  ///< m: length, width, height
  int first_frame = 0;
  std::vector<Placed> poses;  ///< of first_frame and those that follow
};

/// @throw std::runtime_error with the file and what is missing in it.
[[nodiscard]] std::vector<Tracklet> read_tracklets(const std::string& path);

/// @brief The tracklets over ground, numbered in the file's order. Frames without a scan or a pose
/// of the vehicle are left out, and tracklets that then have none.
[[nodiscard]] std::vector<importing::ObjectTrack> tracks_in_world(
    const std::vector<Tracklet>& tracklets, const std::vector<Frame>& scans,
    const Pose& T_vehicle_lidar, const Trajectory& ego);

}  // namespace lidar_upsampling::kitti
