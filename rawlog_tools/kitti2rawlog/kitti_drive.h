// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling::kitti {

/// "2011-09-26 13:04:32.335337762", taken for UTC, to the nearest 100 ns. None if it is no such
/// text.
[[nodiscard]] std::optional<Stamp> parse_stamp(const std::string& text);

/// One file of one sensor.
struct Frame {
  int number = 0;
  Stamp stamp;
  std::string path;
};

/// One sensor's folder: what is there, and what its time stamps promise but is not.
struct SensorFolder {
  std::vector<Frame> frames;
  std::vector<int> missing;  ///< numbers with a time stamp and no file, or a file and no time stamp
};

/// @brief Lists `<folder>/data/<10 digits><one of the extensions>`, with the stamps in
/// `<folder>/timestamps.txt`, for frames within [first, last].
/// @throw std::runtime_error no time stamps, or a line among them that is none.
[[nodiscard]] SensorFolder list_frames(const std::string& folder,
                                       const std::vector<std::string>& extensions, int first,
                                       int last);

}  // namespace lidar_upsampling::kitti
