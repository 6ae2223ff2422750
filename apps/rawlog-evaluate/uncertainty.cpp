// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "uncertainty.h"

#include <map>

#include "text_table.h"

namespace lidar_upsampling {

namespace {

constexpr double kWithin95 = 7.815;  // chi-square of three degrees of freedom

struct Errors {
  std::vector<double> normalised, sigma, length;
};

}  // namespace

std::vector<Calibration> calibration_of(const LabelScore& score) {
  std::map<std::string, Errors> by_status;
  for (const RowError& row : score.rows) {
    Errors& errors = by_status[row.status];
    errors.normalised.push_back(row.normalised_sq);
    errors.sigma.push_back(row.sigma_m);
    errors.length.push_back(row.error_m);
  }

  std::vector<Calibration> calibrations;
  for (const auto& [status, errors] : by_status) {
    Calibration c;
    c.status = status;
    c.count = static_cast<int>(errors.normalised.size());
    int within = 0;
    for (const double sq : errors.normalised) {
      c.mean += sq / 3 / c.count;
      within += sq < kWithin95 ? 1 : 0;
    }
    c.median = median(errors.normalised) / 3;
    c.share_95 = static_cast<double>(within) / c.count;
    c.median_sigma = median(errors.sigma);
    c.median_error = median(errors.length);
    calibrations.push_back(c);
  }
  return calibrations;
}

std::string to_text(const std::vector<Calibration>& calibrations) {
  if (calibrations.empty()) return {};
  std::string text = heading("reported uncertainty of positions",
                             {"count", "NEES/3", "median", "in 95 %", "sigma m", "error m"});
  for (const Calibration& c : calibrations)
    text += named(c.status) + formatted("%9d", c.count) + cell(true, c.mean, 2) +
            cell(true, c.median, 2) + formatted("%8.0f%%", 100 * c.share_95) +
            cell(true, c.median_sigma) + cell(true, c.median_error) + "\n";
  return text;
}

}  // namespace lidar_upsampling
