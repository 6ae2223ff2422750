// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "uncertainty.h"

#include <gtest/gtest.h>

#include <random>

namespace lidar_upsampling {
namespace {

constexpr double kSigma = 0.02;

struct Case {
  LogResult log;
  RunReport report;
};

// Objects that err as reported, but for `factor`.
Case objects_that_err(double factor, bool has_truth = true) {
  Case made;
  made.log.has_truth = has_truth;
  std::mt19937 random(3);
  std::normal_distribution<double> error(0, factor * kSigma);
  for (int i = 0; i < 500; ++i) {
    ScanResult scan;
    scan.stamp = Stamp(Stamp::duration(1000 + i));
    ObjectResult object;
    object.object.motion.centroid_k = {10, 2, -1};
    const Eigen::Translation3d off(error(random), error(random), error(random));
    object.estimates[Row::ours] = off * object.object.motion.T_lidar_t_lidar_k;
    scan.objects.push_back(object);
    made.log.scans.add(scan);
    ReportedObject row;
    row.stamp = 1000 + i;
    row.status = "moving";
    row.position = {10, 2, -1};
    row.covariance = kSigma * kSigma * Eigen::Matrix3d::Identity();
    row.sigma = kSigma;
    made.report.objects.push_back(row);
  }
  return made;
}

TEST(Calibration, true_covariances_have_a_normalised_error_of_one) {
  const auto [log, report] = objects_that_err(1);
  const auto calibrations = calibration_of(log, report);
  ASSERT_EQ(calibrations.size(), 1U);
  EXPECT_EQ(calibrations[0].status, "moving");
  EXPECT_EQ(calibrations[0].count, 500);
  EXPECT_NEAR(calibrations[0].mean, 1, 0.1);
  EXPECT_NEAR(calibrations[0].share_95, 0.95, 0.03);
  EXPECT_NEAR(calibrations[0].median_sigma, kSigma, 1e-9);
}

TEST(Calibration, covariances_that_promise_too_much_are_told_by_how_much) {
  const auto [log, report] = objects_that_err(2);
  const auto calibrations = calibration_of(log, report);
  ASSERT_EQ(calibrations.size(), 1U);
  EXPECT_NEAR(calibrations[0].mean, 4, 0.4);
  EXPECT_LT(calibrations[0].share_95, 0.75);
}

TEST(Calibration, is_not_measured_against_references_that_err_themselves) {
  const auto [log, report] = objects_that_err(1, false);
  EXPECT_TRUE(calibration_of(log, report).empty());
}

}  // namespace
}  // namespace lidar_upsampling
