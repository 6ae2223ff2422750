// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <string>
#include <vector>

#include "kitti2rawlog/kitti_labels.h"
#include "kitti2rawlog/kitti_recording.h"

namespace lidar_upsampling::kitti {

struct LabelFile {
  std::string path;
  std::vector<LabelRow> rows;
};

struct LabelledDrive {
  std::vector<importing::ObjectTrack> tracks;  ///< with the numbers that they have in the file
  std::vector<importing::IgnoredArea> ignored;
  std::vector<std::string> warnings;  ///< what was left out, counted, in a line each
};

/// @brief The labels over ground. Label frames are scan frames; those without a scan, or without a
/// pose of the vehicle, are left out. Ignored areas go to camera 2, whose pictures they were drawn
/// on, or where the recording has none, to the first of 3, 0 and 1.
/// @throw std::runtime_error no label is of a scan that is there.
[[nodiscard]] LabelledDrive labels_in_world(const LabelFile& file, const Recording& recording,
                                            const Trajectory& ego);

}  // namespace lidar_upsampling::kitti
