// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "import/label_files.h"
#include "import/log_items.h"
#include "kitti2rawlog/kitti_drive.h"

namespace lidar_upsampling::kitti {

/// What to read of a recording.
struct Selection {
  std::vector<int> cameras = {2};  ///< KITTI's numbers
  FrameRange frames{0, std::numeric_limits<int>::max() - 1};
};

/// The frames of one sensor.
struct SensorFrames {
  std::string name;  ///< of its folder or file, as messages call it
  SensorFolder files;
};

struct CameraFrames {
  Camera camera;
  SensorFrames pictures;
};

/// A drive of the raw layout or a sequence of the odometry layout.
struct Recording {
  Pose T_vehicle_lidar = Pose::Identity();
  Pose T_vehicle_rectified_0 = Pose::Identity();  ///< of camera 0, which labels are given in
  SensorFrames scans;
  std::vector<CameraFrames> cameras;
  SensorFrames pose_frames;       ///< no name: there are no poses
  std::string pose_label;         ///< OXTS or POSES
  std::vector<PoseSample> poses;  ///< one per frame of `pose_frames`
  std::vector<importing::ObjectTrack> tracks;
  std::vector<importing::IgnoredArea> ignored;
};

/// @brief A drive's folder, its calibration files one up.
/// @throw std::runtime_error the folder, a calibration, or time stamps are missing.
[[nodiscard]] Recording open_drive(const std::string& folder, const Selection& selection);

/// @brief A folder `<root>/sequences/NN`, with `<root>/poses/NN.txt` where it is there.
/// @throw std::runtime_error as above, or no picture to tell a camera's size.
[[nodiscard]] Recording open_sequence(const std::string& folder, const Selection& selection);

/// @brief Adds the tracks of a label file: `labels`, or if that is empty the drive's
/// `tracklet_labels.xml`, or its `label_02.txt`.
/// @return what of the labels was left out, in a line each.
/// @throw std::runtime_error there is none, it is none of this drive, or there are no poses to put
/// it over ground with.
[[nodiscard]] std::vector<std::string> add_tracks(Recording& recording, const std::string& drive,
                                                  const std::string& labels);

/// Every scan, picture and pose. The recording must outlive the items.
[[nodiscard]] std::vector<importing::LogItem> items_of(const Recording& recording);

[[nodiscard]] importing::LabelledLog labels_of(const Recording& recording);

}  // namespace lidar_upsampling::kitti
