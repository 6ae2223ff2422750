// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <functional>

#include "simulator/scenario.h"

namespace lidar_upsampling::sim {

struct SimulationJob {
  Scenario scenario;
  std::string output;  ///< the log
  std::string truth;   ///< a log of scans at every image's stamp, and of exact poses; empty: none
  bool overwrite = false;
};

struct SimulationSummary {
  int num_scans = 0, num_images = 0, num_ego = 0, num_truth_scans = 0;
  int num_moving = 0, num_parked = 0;
  double mean_points = 0;  ///< per scan
};

/// @brief Makes the log, the truth, and beside the log `<stem>_objects.csv`, `<stem>_ego.csv` and
/// `<stem>_boxes.csv`. Files get their names when all of them are complete.
/// @param progress called with the share that is done, 0 to 1.
/// @throw std::runtime_error a file exists and `overwrite` is off, or cannot be written.
[[nodiscard]] SimulationSummary simulate(const SimulationJob& job,
                                         const std::function<void(double)>& progress);

}  // namespace lidar_upsampling::sim
