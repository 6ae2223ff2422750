// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <string>

#include "evaluation.h"
#include "page/run_report.h"

namespace lidar_upsampling {

/// What a densification moved by a motion of its own, by whether something moves there: pieces of
/// walls that are told to move are no objects of the truth, so that no error tells of them.
struct ToldMovers {
  int near = 0;       ///< objects times images, within 6 m of one that moves
  int elsewhere = 0;  ///< with none that near
};

/// @brief Counts what the report says to move at the instants that were evaluated.
/// @param max_range_m as the evaluation had it; only what lies nearer than that is counted.
[[nodiscard]] ToldMovers told_movers(const LogResult& log, const RunReport& report,
                                     double max_range_m);

/// Empty without true objects, as a log without them may not know of all that move.
[[nodiscard]] std::string to_text(const ToldMovers& movers, bool has_truth);

}  // namespace lidar_upsampling
