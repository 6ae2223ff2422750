// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "evaluation.h"
#include "lidar_upsampling/metrics/summary.h"

namespace lidar_upsampling {

/// Over objects.
struct ObjectFigures {
  ErrorSummary position_m, depth_percent, velocity_mps, yaw_deg;
};

/// Mean over scans, and how far it scatters from seed to seed (standard deviation).
struct SeededFigure {
  int num_scans = 0;
  double mean = 0, spread = 0;
};

struct SampledFigures {
  SeededFigure chamfer_m2, chamfer_m, emd_m2, emd_m, exact_emd_m2, exact_emd_m;
};

/// One row over the whole log; the figures of scans are means over scans.
struct RowFigures {
  ObjectFigures moving, standing;
  ErrorSummary moving_points_m, static_scene_m;
  ErrorSummary chamfer_m, chamfer_m2, view_chamfer_m, view_chamfer_m2;
  ErrorSummary epe_dynamic_m, epe_static_m, epe_background_m, epe_three_way_m;
  SampledFigures sampled, sampled_inliers;
};

/// Position errors of the objects whose horizon, range or number of points lies in [from, to).
struct Bin {
  double from = 0, to = 0;
  PerRow<ErrorSummary> rows;
  double mean_key = 0;  ///< of its objects
};

/// "10 to 20 m", "80 m and more"; times by their mean, as images are hardly at whole hundredths.
[[nodiscard]] std::string edges_of(const Bin& bin, const std::string& unit);

struct Binned {
  std::string key;   ///< as programs call it
  std::string unit;  ///< of the edges
  bool moving = false;
  std::vector<Bin> bins;  ///< those that hold something
};

struct Figures {
  PerRow<RowFigures> rows;
  std::vector<Binned> binned;
  std::map<std::string, PerRow<ErrorSummary>> depth_by_object;  ///< percent, by id; moving ones
  std::map<std::string, int> left_out;                          ///< reason, how many objects
  /// Mean uncertainty of the references, moving and standing objects, m.
  ErrorSummary reference_moving_m, reference_standing_m;
  int num_interpolated = 0;         ///< scans whose reference is of other instants
  std::vector<std::string> beaten;  ///< figures in which a baseline beats ours, in words
};

[[nodiscard]] Figures compute_figures(const LogResult& result);

}  // namespace lidar_upsampling
