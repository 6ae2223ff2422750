// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <string>
#include <vector>

#include "label_score.h"

namespace lidar_upsampling {

/// How true the reported covariances of one kind of answer are: the position error squared, in
/// units of its covariance, over its three dimensions. Its mean is 1 where they are true
/// (Bar-Shalom et al., Estimation with Applications to Tracking and Navigation, section 5.4: NEES),
/// 95 % lie below 7.81 / 3. Labels that err themselves add to it.
struct Calibration {
  std::string status;  ///< of the object, as in the report
  int count = 0;
  double mean = 0, median = 0;
  double share_95 = 0;      ///< of the errors that lie within their 95 % ellipsoid
  double median_sigma = 0;  ///< m, reported, worst direction
  double median_error = 0;  ///< m
};

/// @return by status; every row of the report that lies on a labelled object counts.
[[nodiscard]] std::vector<Calibration> calibration_of(const LabelScore& score);

[[nodiscard]] std::string to_text(const std::vector<Calibration>& calibrations);

}  // namespace lidar_upsampling
