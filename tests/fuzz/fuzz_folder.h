// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <string>

#include "fuzz/byte_mutations.h"

namespace lidar_upsampling::fuzz {

/// The folder that inputs are written to, in memory where there is such.
[[nodiscard]] const std::string& work_folder();

[[nodiscard]] inline std::string in_work_folder(const std::string& name) {
  return work_folder() + "/" + name;
}

void write_file_of(const std::string& path, const Bytes& bytes);
void write_file_of(const std::string& path, const std::string& text);

}  // namespace lidar_upsampling::fuzz
