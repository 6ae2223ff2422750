// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <exception>
#include <string>

namespace lidar_upsampling {

/// @brief What an exception says, in one line: MRPT's own carry a call stack behind the message.
[[nodiscard]] std::string one_line(const std::exception& error);

}  // namespace lidar_upsampling
