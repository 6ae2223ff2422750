// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "html.h"
#include "lidar_upsampling/io/log_index.h"
#include "log_streams.h"
#include "plots.h"

namespace lidar_upsampling {

/// How densely something is there in time.
struct StreamCoverage {
  std::string name;
  std::vector<Stamp> stamps;  ///< ascending
  double rate_hz = 0;
  double median_gap_s = 0, longest_gap_s = 0;
};

/// A camera's images, and how many of them have a scan of their instant.
struct CameraCoverage {
  std::string label;
  int num_images = 0, num_with_virtual = 0, num_with_real = 0;
};

struct Coverage {
  StreamCoverage real, virtual_scans, both;
  std::vector<CameraCoverage> cameras;
};

/// @param tolerance_s between an image and a scan of its instant.
[[nodiscard]] Coverage measure_coverage(const LogIndex& index, const ScanLabels& labels,
                                        double tolerance_s);

/// Seconds from each scan to the next, over time, with and without the virtual ones.
[[nodiscard]] Plot gap_plot(const Coverage& coverage);

/// @param gaps the drawn gap_plot().
[[nodiscard]] std::string coverage_html(const Coverage& coverage, const std::string& gaps);

}  // namespace lidar_upsampling
