// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/obs/CObservation.h>

#include <functional>
#include <string>
#include <vector>

#include "lidar_upsampling/ego/trajectory.h"
#include "lidar_upsampling/io/file_places.h"
#include "lidar_upsampling/io/rawlog_stream.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling::importing {

/// An observation that is made when its turn to be written comes, so that one at a time is in
/// memory.
struct LogItem {
  Stamp stamp;
  std::function<mrpt::obs::CObservation::Ptr()> make;
  std::string file = {};  ///< that it is made of; empty: of less than that
};

/// @brief Looks whether a log of these has room, before the work.
/// @throw std::runtime_error how much is free, and how much it takes at least
void check_room(const FileUse& output, const std::vector<LogItem>& items);

/// @brief Writes in the order of the stamps; at equal ones, in the order given.
/// @param progress called with the share that is done, 0 to 1.
void write_items(RawlogWriter& writer, std::vector<LogItem> items,
                 const std::function<void(double)>& progress);

/// A CObservationRobotPose.
[[nodiscard]] mrpt::obs::CObservation::Ptr pose_observation(const PoseSample& sample,
                                                            const std::string& label);

/// @throw std::runtime_error the file holds no picture, or one of another size than the camera's.
[[nodiscard]] CameraImage read_picture(const std::string& path, Stamp stamp, const Camera& camera);

/// Width and height in pixels. @throw std::runtime_error the file holds no picture.
[[nodiscard]] cv::Size size_of_picture(const std::string& path);

}  // namespace lidar_upsampling::importing
