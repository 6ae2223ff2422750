// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/obs/CObservation.h>

#include <map>
#include <set>
#include <string>
#include <utility>

#include "densify.h"

namespace lidar_upsampling {

/// What of a log is no error, but makes the result worse: told as warnings.
class StampWatch {
 public:
  explicit StampWatch(DensifyReport& report) : report_(report) {}

  /// @return whether it is not the last one of its label and kind for the second time.
  bool note(const mrpt::obs::CObservation& observation);

 private:
  DensifyReport& report_;
  std::map<std::pair<std::string, std::string>, Stamp> last_;  ///< by label and class
};

/// @brief Warns of settings and boxes for sensors that the log does not have.
/// @param labels of all observations. @param cameras those whose images are used.
void warn_of_unused(const DensifyJob& job, const std::set<std::string>& labels,
                    const std::set<std::string>& cameras, DensifyReport& report);

/// Warns of a log of which nothing was made, or of boxes that met no object, and says why that may
/// be.
void warn_of_nothing_made(const DensifyJob& job, DensifyReport& report);

}  // namespace lidar_upsampling
