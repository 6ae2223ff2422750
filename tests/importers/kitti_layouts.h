// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <filesystem>
#include <string>

#include "small_street.h"

namespace lidar_upsampling {

/// A scan's points in the order of KITTI's files, and as those files hold them.
struct KittiPoints {
  std::vector<Eigen::Vector3f> points;
  std::vector<float> intensity;
};
[[nodiscard]] KittiPoints kitti_points(const SmallStreet& street, Stamp stamp);

/// In a drive the pictures are taken 10 ms after the scans, and OXTS reports 1 ms before them.
[[nodiscard]] Stamp drive_picture_stamp(int frame);
[[nodiscard]] Stamp drive_oxts_stamp(int frame);

/// Of camera 0 as rectified; in the odometry layout, as it is.
[[nodiscard]] Pose T_camera_0_lidar(const SmallStreet& street);

/// The reader's world begins where OXTS does.
[[nodiscard]] Pose T_drive_world(const SmallStreet& street);

/// The first frame in which the n-th labelled object is labelled, and the one in which the first
/// is labelled as fully occluded.
[[nodiscard]] inline int first_labelled_frame(int n) { return n == 1 ? 1 : 0; }
constexpr int kOccludedFrame = 2;

/// @brief Writes `<day>/drive` in KITTI's raw layout, its calibration files in `day`.
/// @return the drive's folder.
std::filesystem::path write_drive(const std::filesystem::path& day, const SmallStreet& street);

/// @brief The drive's objects in the format of the tracking benchmark's label_02, the n-th labelled
/// one as track kFirstLabelTrack + n; every other frame has an area that nobody labelled, too.
[[nodiscard]] std::string label_02_text(const SmallStreet& street);
constexpr int kFirstLabelTrack = 7;

/// @brief Writes `<root>/sequences/04` and `<root>/poses/04.txt`, pictures and scans at one time.
/// @return the sequence's folder.
std::filesystem::path write_sequence(const std::filesystem::path& root, const SmallStreet& street);

}  // namespace lidar_upsampling
