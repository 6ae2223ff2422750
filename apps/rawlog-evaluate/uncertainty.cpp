// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "uncertainty.h"

#include <Eigen/LU>
#include <algorithm>
#include <cstdio>
#include <map>

namespace lidar_upsampling {

namespace {

constexpr double kWithin95 = 7.815;  // chi-square of three degrees of freedom
constexpr double kSamePlace_m = 0.3;

struct Errors {
  std::vector<double> normalised, sigma, length;
};

const ReportedObject* reported(const ScanResult& scan, const Eigen::Vector3d& place,
                               const std::multimap<std::int64_t, const ReportedObject*>& rows) {
  const auto [first, last] = rows.equal_range(scan.stamp.time_since_epoch().count());
  const ReportedObject* nearest = nullptr;
  for (auto row = first; row != last; ++row)
    if (nearest == nullptr ||
        (row->second->position - place).norm() < (nearest->position - place).norm())
      nearest = row->second;
  const bool same = nearest != nullptr && (nearest->position - place).norm() < kSamePlace_m;
  return same ? nearest : nullptr;
}

void add(const ScanResult& scan, const ObjectResult& object,
         const std::multimap<std::int64_t, const ReportedObject*>& rows,
         std::map<std::string, Errors>& by_status) {
  const auto& estimate = object.estimates[Row::ours];
  if (!estimate || !object.object.excluded.empty()) return;
  const ReferenceMotion& truth = object.object.motion;
  const Eigen::Vector3d place = *estimate * truth.centroid_k;
  const ReportedObject* row = reported(scan, place, rows);
  if (row == nullptr || row->covariance.isZero()) return;
  const Eigen::Vector3d error = place - truth.T_lidar_t_lidar_k * truth.centroid_k;
  Errors& errors = by_status[row->status];
  errors.normalised.push_back(error.dot(row->covariance.inverse() * error));
  errors.sigma.push_back(row->sigma);
  errors.length.push_back(error.norm());
}

}  // namespace

std::vector<Calibration> calibration_of(const LogResult& log, const RunReport& report) {
  if (!log.has_truth) return {};
  std::multimap<std::int64_t, const ReportedObject*> rows;
  for (const ReportedObject& object : report.objects) rows.emplace(object.stamp, &object);
  std::map<std::string, Errors> by_status;
  log.scans.for_each([&](const ScanResult& scan) {
    for (const ObjectResult& object : scan.objects) add(scan, object, rows, by_status);
  });

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
  std::string text =
      "\nreported uncertainty of positions        count  NEES/3   median  in 95 %  sigma m  error "
      "m\n";
  char line[128];
  for (const Calibration& c : calibrations) {
    std::snprintf(line, sizeof line, "  %-38s%6d %7.2f %8.2f %7.0f%% %8.3f %8.3f\n",
                  c.status.c_str(), c.count, c.mean, c.median, 100 * c.share_95, c.median_sigma,
                  c.median_error);
    text += line;
  }
  return text;
}

}  // namespace lidar_upsampling
