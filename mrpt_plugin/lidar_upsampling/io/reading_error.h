// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <exception>
#include <string>

namespace lidar_upsampling {

/// What MRPT's exception says of an object that cannot be read, in our words and in one line.
[[nodiscard]] std::string why_not_read(const std::exception& error);

}  // namespace lidar_upsampling
