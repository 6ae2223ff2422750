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

/// Of a sensor's files: zero-padded frame numbers, and one of the extensions.
struct FileNames {
  std::size_t digits = 10;
  std::vector<std::string> extensions;
};

/// The first and last frame that is wanted.
struct FrameRange {
  int first = 0;
  int last = 0;
};

/// The stamp of each frame, by its number; none for a frame that was not taken.
using FrameStamps = std::vector<std::optional<Stamp>>;

/// @brief The lines of a timestamps.txt. @throw std::runtime_error it cannot be read, or a line
/// that is no time stamp.
[[nodiscard]] FrameStamps read_stamps(const std::string& path);

/// Lists `<folder>/<number><one of the extensions>`.
[[nodiscard]] SensorFolder list_frames(const std::string& folder, const FrameStamps& stamps,
                                       const FileNames& names, const FrameRange& range);

}  // namespace lidar_upsampling::kitti
