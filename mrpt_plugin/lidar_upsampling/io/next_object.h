// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <cstddef>
#include <cstdint>

namespace lidar_upsampling {

/// @brief Whether an object of a log may begin here: one that logs hold by itself, not what it is
/// made of.
/// @param in_frames the log is one of frames and actions, whose observations are in frames.
[[nodiscard]] bool begins_object(const std::uint8_t* bytes, std::size_t size, bool in_frames);

}  // namespace lidar_upsampling
