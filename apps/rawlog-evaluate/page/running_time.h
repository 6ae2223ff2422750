// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "run_report.h"

namespace lidar_upsampling {

/// A line of the paper's table of running times.
struct TimedComponent {
  std::string name;
  double ms = 0;                    ///< per virtual scan
  std::optional<double> published;  ///< of the paper, ms
};

/// What other papers print for making one scan.
struct PublishedTime {
  const char* method;
  double ms;
};

struct RunningTime {
  std::vector<TimedComponent> components;  ///< of the method; the total comes last
  std::vector<TimedComponent> log;         ///< reading, packing and writing the log
  std::vector<PublishedTime> others;
};

/// @brief A densification's stages summed up as in the paper's tables (section Running Time
/// Analysis).
/// @return nothing in it if there were no virtual scans.
[[nodiscard]] RunningTime running_time_of(const RunReport& report);

/// For the terminal.
[[nodiscard]] std::string to_text(const RunningTime& time);

/// Tables and bars for the page.
[[nodiscard]] std::string running_time_html(const RunReport& report);

}  // namespace lidar_upsampling
