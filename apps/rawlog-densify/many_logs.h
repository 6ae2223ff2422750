// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "densify.h"

namespace lidar_upsampling {

/// One log of many, and where its report goes (empty: nowhere).
struct LogJob {
  DensifyJob job;
  std::string report;
};

/// @brief A job per input: `output`, `report` and `pictures` are folders, in which a log goes by
/// its own name (a report by that and .json). Those of reports and pictures are made.
/// @param job what all have in common. @param report folder, empty: none.
/// @throw std::runtime_error the output is no folder; two logs of one name.
[[nodiscard]] std::vector<LogJob> jobs_of(const std::vector<std::string>& inputs,
                                          const DensifyJob& job, const std::string& report);

/// @brief Densifies all of them, `at_once` at a time, each in a process of its own; prints what
/// becomes of each as it ends.
/// @param densify_one does it, and returns its summary. @param progress gets the share done.
/// @throw std::runtime_error which have failed, and why, when all others are done.
void densify_all(const std::vector<LogJob>& jobs, std::size_t at_once,
                 const std::function<std::string(const LogJob&)>& densify_one,
                 const std::function<void(double)>& progress);

}  // namespace lidar_upsampling
