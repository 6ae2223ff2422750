// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "uncertainty.h"

#include <gtest/gtest.h>

#include <random>

namespace lidar_upsampling {
namespace {

constexpr double kSigma = 0.02, kHorizon_s = 0.1, kYawRate = 1;

/// A car that turns while it drives, and a row that tells of its place at `place_k` of the key
/// scan.
LabelledInstant turning_car() {
  LabelledInstant instant;
  instant.dt = kHorizon_s;
  LabelledBox car;
  car.T_box_lidar = Pose(Eigen::Translation3d(-20, 0, 0));
  car.size = {4, 2, 1.5};
  car.velocity = {8, 0, 0};
  car.speed_mps = 8;
  car.T_lidar_t_lidar_k = Eigen::Translation3d(20.8, 0, 0) *
                          Eigen::AngleAxisd(kYawRate * kHorizon_s, Eigen::Vector3d::UnitZ()) *
                          Eigen::Translation3d(-20, 0, 0);
  instant.boxes.push_back(car);
  return instant;
}

ReportedObject row_of(const LabelledInstant& instant, const Eigen::Vector3d& place_k,
                      const Eigen::Vector3d& error) {
  ReportedObject row;
  row.stamp = instant.told_at;
  row.status = "moving";
  row.position = *instant.boxes.front().T_lidar_t_lidar_k * place_k + error;
  row.yaw_rate = kYawRate;
  row.middle = row.position + Eigen::Vector3d(1, 0.3, 0);
  row.velocity = (row.position - place_k) / kHorizon_s +
                 kYawRate * Eigen::Vector3d::UnitZ().cross(row.middle - row.position);
  row.covariance = kSigma * kSigma * Eigen::Matrix3d::Identity();
  row.sigma = kSigma;
  return row;
}

/// Objects in two pieces each that err as reported, but for `factor`.
LabelScore rows_that_err(double factor) {
  std::mt19937 random(3);
  std::normal_distribution<double> draw(0, factor * kSigma);
  LabelScore score;
  for (int i = 0; i < 250; ++i) {
    const LabelledInstant instant = turning_car();
    std::vector<ReportedObject> rows;
    for (const double x : {18.5, 21.})
      rows.push_back(row_of(instant, {x, 0.5, 0.2}, {draw(random), draw(random), draw(random)}));
    append(score, score_labels({instant}, rows, {}));
  }
  return score;
}

TEST(Calibration, true_covariances_have_a_normalised_error_of_one_for_every_piece) {
  const auto calibrations = calibration_of(rows_that_err(1));
  ASSERT_EQ(calibrations.size(), 1U);
  EXPECT_EQ(calibrations[0].status, "moving");
  EXPECT_EQ(calibrations[0].count, 500);
  EXPECT_NEAR(calibrations[0].mean, 1, 0.1);
  EXPECT_NEAR(calibrations[0].share_95, 0.95, 0.03);
  EXPECT_NEAR(calibrations[0].median_sigma, kSigma, 1e-9);
}

TEST(Calibration, covariances_that_promise_too_much_are_told_by_how_much) {
  const auto calibrations = calibration_of(rows_that_err(2));
  ASSERT_EQ(calibrations.size(), 1U);
  EXPECT_NEAR(calibrations[0].mean, 4, 0.4);
  EXPECT_LT(calibrations[0].share_95, 0.75);
}

TEST(Calibration, counts_what_has_a_covariance_and_lies_in_a_label_that_reaches_the_instant) {
  LabelledInstant instant = turning_car();
  ReportedObject row = row_of(instant, {20, 0, 0}, {0, 0, 0});
  const ReportedObject beside = row_of(instant, {20, 1.2, 0}, {0, 0, 0});
  EXPECT_EQ(score_labels({instant}, {row, beside}, {}).rows.size(), 1U);
  row.covariance.setZero();
  EXPECT_TRUE(score_labels({instant}, {row}, {}).rows.empty());
  row = row_of(instant, {20, 0, 0}, {0, 0, 0});
  instant.boxes.front().T_lidar_t_lidar_k.reset();
  EXPECT_TRUE(score_labels({instant}, {row}, {}).rows.empty());
}

}  // namespace
}  // namespace lidar_upsampling
