// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <map>
#include <string>
#include <vector>

#include "label_score.h"
#include "lidar_upsampling/metrics/summary.h"
#include "rows.h"

namespace lidar_upsampling {

/// The figures of one row by labels.
struct LabelFigures {
  int num_images = 0;
  ErrorSummary movers_m;  ///< all labelled movers, those without a row left standing
  ErrorSummary found_m;   ///< those with a row
  ErrorSummary velocity_mps, found_velocity_mps;
  double velocity_rms_mps = 0, found_velocity_rms_mps = 0;
  int num_parked = 0, num_parked_told = 0;  ///< with a row; of them told to move
  double parked_shift_m = 0;                ///< mean over those with a row
  double false_per_image = 0, false_shift_m = 0;
  int num_followed = 0, num_switches = 0;
};

/// Mean errors of all labelled movers of one kind, by row.
struct LabelGroup {
  std::string name;  ///< as "10 to 20 m"
  int count = 0;
  PerRow<std::optional<double>> mean_m;
};

using LabelScores = PerRow<std::optional<LabelScore>>;

[[nodiscard]] LabelFigures label_figures(const LabelScore& score);

/// By range, speed and class.
[[nodiscard]] std::map<std::string, std::vector<LabelGroup>> label_groups(
    const LabelScores& scores);

/// @brief The headline, for people. Empty without labels.
/// @param num_unlabelled virtual scans that no label tells of.
[[nodiscard]] std::string to_text(const LabelScores& scores, int num_unlabelled);

/// Each figure by its name as programs call it, in the order of the table.
[[nodiscard]] std::vector<std::pair<std::string, double>> named_figures(
    const LabelFigures& figures);

}  // namespace lidar_upsampling
