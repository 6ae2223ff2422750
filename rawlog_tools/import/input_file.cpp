// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "import/input_file.h"

#include <stdexcept>

#include "lidar_upsampling/io/file_places.h"

namespace lidar_upsampling::importing {

void check_is_no_pipe(const std::string& path) {
  if (is_device_or_pipe(path))
    throw std::runtime_error(path + " is a pipe, a socket or a device, and no file");
}

std::ifstream open_file(const std::string& path, std::ios::openmode mode) {
  check_is_no_pipe(path);
  return std::ifstream(path, mode);
}

}  // namespace lidar_upsampling::importing
