// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/metrics/label_velocity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace lidar_upsampling {
namespace {

Stamp label_stamp(double t) {
  return shifted(Stamp(mrpt::Clock::duration(132'000'000'000'000'000)), t);
}

std::vector<Stamp> label_stamps(int count, double interval_s) {
  std::vector<Stamp> stamps;
  for (int i = 0; i < count; ++i) stamps.push_back(label_stamp(i * interval_s));
  return stamps;
}

// Positions far from the origin, as in a city's coordinates, where `travelled` tells them to be.
template <typename Travelled>
std::vector<LabelledPosition> labels_of_travel(int count, double interval_s, double jitter_m,
                                               const Travelled& travelled) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise;
  std::vector<LabelledPosition> track;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d off(jitter_m * noise(random), jitter_m * noise(random),
                              jitter_m * noise(random));
    track.push_back({label_stamp(i * interval_s),
                     Eigen::Vector3d(5000, -3000, 100) + travelled(i * interval_s) + off});
  }
  return track;
}

const auto kDrivingOn = [](double t) { return Eigen::Vector3d(8 * t, -3 * t, 0.5 * t); };
const Eigen::Vector3d kDrivingOnVelocity(8, -3, 0.5);

TEST(LabelVelocity, of_a_steady_drive_is_exact_and_with_jitter_far_better_than_a_difference) {
  const LabelWindow window = label_window(label_stamps(200, 0.1));
  const auto exact = labels_of_travel(200, 0.1, 0, kDrivingOn);
  const auto found = fit_velocity(exact, label_stamp(3), window);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->num_labels, 7);
  EXPECT_LT((found->velocity - kDrivingOnVelocity).norm(), 1e-9);

  double fitted = 0, differences = 0;
  const auto jittery = labels_of_travel(200, 0.1, 0.07, kDrivingOn);
  for (std::size_t i = 3; i + 3 < jittery.size(); ++i) {
    const auto velocity = fit_velocity(jittery, jittery[i].stamp, window);
    ASSERT_TRUE(velocity);
    fitted += (velocity->velocity - kDrivingOnVelocity).squaredNorm();
    differences += ((jittery[i + 1].position - jittery[i - 1].position) / 0.2 - kDrivingOnVelocity)
                       .squaredNorm();
  }
  EXPECT_LT(std::sqrt(fitted / 194), 0.07 / 0.1 / std::sqrt(28) * std::sqrt(3) * 1.15);
  EXPECT_LT(fitted, 0.1 * differences);
}

TEST(LabelVelocity, of_one_who_brakes_is_unbiased_where_labels_lie_to_both_sides) {
  const LabelWindow window = label_window(label_stamps(20, 0.1));
  const auto track = labels_of_travel(
      20, 0.1, 0, [](double t) { return Eigen::Vector3d(15 * t - 3 * t * t, 0, 0); });
  const auto found = fit_velocity(track, label_stamp(1), window);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->velocity.x(), 15 - 6, 1e-9);
}

TEST(LabelVelocity, is_unknown_where_the_label_is_too_short) {
  const LabelWindow window = label_window(label_stamps(50, 0.1));
  EXPECT_EQ(window.min_labels, 5);
  EXPECT_NEAR(window.half_width_s, 0.35, 1e-9);
  EXPECT_FALSE(fit_velocity(labels_of_travel(4, 0.1, 0, kDrivingOn), label_stamp(0.1), window));
  const auto five = labels_of_travel(5, 0.1, 0, kDrivingOn);
  EXPECT_TRUE(fit_velocity(five, label_stamp(0.2), window));
  EXPECT_FALSE(fit_velocity(five, label_stamp(0), window));  // four of them are near
  EXPECT_FALSE(fit_velocity({}, label_stamp(0), window));
}

TEST(LabelVelocity, of_labels_at_one_instant_is_unknown) {
  const std::vector<LabelledPosition> twice(6, {label_stamp(1), Eigen::Vector3d::Ones()});
  EXPECT_FALSE(fit_velocity(twice, label_stamp(1), {0.35, 2}));
}

TEST(LabelVelocity, of_labels_twice_a_second_takes_the_neighbours) {
  const LabelWindow window = label_window(label_stamps(40, 0.5));
  EXPECT_NEAR(window.half_width_s, 0.75, 1e-9);
  EXPECT_EQ(window.min_labels, 2);
  const auto track = labels_of_travel(40, 0.5, 0, kDrivingOn);
  const auto inside = fit_velocity(track, label_stamp(5), window);
  ASSERT_TRUE(inside);
  EXPECT_EQ(inside->num_labels, 3);
  EXPECT_LT((inside->velocity - kDrivingOnVelocity).norm(), 1e-9);
  EXPECT_TRUE(fit_velocity(track, label_stamp(0), window));
}

TEST(LabelVelocity, in_a_clip_of_five_frames_needs_four_labels) {
  const LabelWindow window = label_window(label_stamps(5, 0.1036));
  EXPECT_EQ(window.min_labels, 4);
  const auto track = labels_of_travel(5, 0.1036, 0, kDrivingOn);
  EXPECT_TRUE(fit_velocity(track, track[0].stamp, window));
  EXPECT_TRUE(fit_velocity(track, track[4].stamp, window));
  EXPECT_FALSE(fit_velocity({track.begin(), track.begin() + 3}, track[1].stamp, window));
}

TEST(LabelVelocity, a_log_of_few_or_doubled_stamps_still_has_a_window) {
  EXPECT_EQ(label_window({}).min_labels, 2);
  EXPECT_EQ(label_window(label_stamps(1, 0.1)).min_labels, 2);
  auto stamps = label_stamps(5, 0.1);
  const auto others = stamps;
  stamps.insert(stamps.end(), others.begin(), others.end());  // two objects' labels
  EXPECT_EQ(label_window(stamps).min_labels, 4);
  EXPECT_NEAR(label_window(stamps).half_width_s, 0.35, 1e-9);
}

}  // namespace
}  // namespace lidar_upsampling
