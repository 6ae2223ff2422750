// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <fstream>
#include <string>

namespace lidar_upsampling::importing {

/// @brief A file of a data set, at its beginning; bad if it cannot be read.
/// @throw std::runtime_error it is a pipe, a socket or a device, which may keep its reader waiting
/// for ever.
[[nodiscard]] std::ifstream open_file(const std::string& path,
                                      std::ios::openmode mode = std::ios::in);

/// @throw std::runtime_error as open_file()
void check_is_no_pipe(const std::string& path);

}  // namespace lidar_upsampling::importing
