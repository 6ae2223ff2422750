// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <string>

namespace lidar_upsampling {

/// @brief Ends rawlog-grabber as a key press does: it takes an exception, the only other end that a
/// sensor can bring about, for an error.
/// @return whether this process is one that this can be done to.
[[nodiscard]] bool press_key_in_grabber();

/// @brief rawlog-grabber makes its recording even if no sensor starts. One that holds nothing is
/// removed when the process ends, if that is rawlog-grabber.
/// @param external_images the recording's folder of external images, which tells its name.
void remove_empty_recording_at_exit(const std::string& external_images);

/// The recording that such a folder belongs to; empty: none.
[[nodiscard]] std::string recording_of(const std::string& external_images);

}  // namespace lidar_upsampling
