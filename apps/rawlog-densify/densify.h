// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "lidar_upsampling/config.h"
#include "lidar_upsampling/io/rig_overrides.h"
#include "report.h"

namespace lidar_upsampling {

struct DensifyJob {
  std::string input, output;
  std::string pictures;  ///< folder for pictures, empty: none
  bool overwrite = false;
  bool accept_truncated = false;  ///< keep what is readable of a broken log
  bool keep_rows = false;         ///< a report row per object and image
  Config config;
  RigOverrides rig;
};

/// @brief The main job: a log in, the same log with a virtual scan after every image between two
/// scans out. Observations go through byte for byte.
/// @param progress gets the share done, 0 to 1.
/// @throw std::runtime_error with one line that says what, where and what to do.
[[nodiscard]] DensifyReport densify(const DensifyJob& job,
                                    const std::function<void(double)>& progress);

}  // namespace lidar_upsampling
