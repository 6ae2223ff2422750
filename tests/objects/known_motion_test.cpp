// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/known_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace lidar_upsampling {
namespace {

constexpr double kPeriod = 0.1;

// The rear of a vehicle ahead at `x`, and its left side for `length` metres.
std::vector<Eigen::Vector3f> vehicle(float x, float length, float half_width = 0.9F) {
  std::vector<Eigen::Vector3f> points;
  for (float z = -1.2F; z < 0.3F; z += 0.15F) {
    for (float y = -half_width; y <= half_width; y += 0.1F) points.emplace_back(x, y, z);
    for (float along = 0.1F; along < length; along += 0.1F) points.emplace_back(x + along, 0.9F, z);
  }
  return points;
}

std::optional<KnownMotion> measured(std::vector<Eigen::Vector3f> before,
                                    std::vector<Eigen::Vector3f> now) {
  ObjectScans scans;
  scans.before = std::move(before);
  scans.now = std::move(now);
  scans.dt = kPeriod;
  return measure_between_scans(scans, Stamp{}, Eigen::Matrix3d::Identity());
}

TEST(MeasureBetweenScans, a_piece_of_a_rear_tells_the_motion_ahead_but_not_that_sideways) {
  const auto known = measured(vehicle(12, 0, 0.5F), vehicle(12.2F, 0));
  ASSERT_TRUE(known);
  EXPECT_NEAR(known->velocity_at_rest.x(), 2, 0.2);
  EXPECT_LT(std::sqrt(known->velocity_covariance(0, 0)), 0.5);
  EXPECT_GT(known->velocity_covariance(1, 1), 10 * known->velocity_covariance(0, 0));
  EXPECT_GT(evidence_of_motion(*known), 16.8);
}

TEST(MeasureBetweenScans, a_view_that_shrinks_is_found_in_the_larger_one_before) {
  const auto known = measured(vehicle(12, 4), vehicle(12.3F, 0.5F));
  ASSERT_TRUE(known);
  EXPECT_NEAR(known->velocity_at_rest.x(), 3, 0.3);
}

TEST(MeasureBetweenScans, no_road_user_jumps_up) {
  auto now = vehicle(12, 2);
  for (auto& point : now) point.z() += 0.4F;
  const auto known = measured(vehicle(12, 2), now);
  EXPECT_TRUE(!known || known->velocity_at_rest.norm() < 0.3) << known->velocity_at_rest;
}

// A street of walls 30 m ahead and 15 m to the sides, with what stands in it.
SeenSpace street_with(const std::vector<Eigen::Vector3f>& object) {
  constexpr float kColumn = 0.0035F, kRing = 0.007F, kGap = 0.005F;
  std::vector<Eigen::Vector3f> points = object;
  for (float azimuth = -1; azimuth < 1; azimuth += kColumn)
    for (float tangent = -0.15F; tangent < 0.1F; tangent += kRing) {
      const float range = std::min(30 / std::cos(azimuth), 15 / std::abs(std::sin(azimuth)));
      const Eigen::Vector3f far(range * std::cos(azimuth), range * std::sin(azimuth),
                                range * tangent);
      const bool is_hidden = std::any_of(object.begin(), object.end(), [&](const auto& near) {
        return std::abs(std::atan2(near.y(), near.x()) - azimuth) < kGap &&
               std::abs(near.z() / near.template head<2>().norm() - tangent) < kRing;
      });
      if (!is_hidden) points.push_back(far);
    }
  return {points, 0.4};
}

bool stood(float before_m, float now_m) {
  const auto before = vehicle(before_m, 3), now = vehicle(now_m, 3);
  const SeenSpace seen_before = street_with(before), seen_now = street_with(now);
  const Eigen::Vector2d step(1.2, 0);  // as claimed
  return was_there_then({now, seen_now, true}, step, Pose::Identity(), seen_before) &&
         was_there_then({before, seen_before, true}, -step, Pose::Identity(), seen_now);
}

TEST(WasThereThen, who_is_seen_where_it_was_has_not_moved_whatever_registration_says) {
  EXPECT_TRUE(stood(12, 12));
}

TEST(WasThereThen, who_has_left_or_taken_a_place_may_have_moved) {
  EXPECT_FALSE(stood(12, 13.2F));
  EXPECT_FALSE(stood(13.2F, 12));
}

TEST(WasThereThen, who_moves_with_its_front_behind_another_is_not_said_to_have_stood) {
  // A long side passes to the right; a post between sensor and street hides where it ends.
  const auto side = [](float from_m) {
    std::vector<Eigen::Vector3f> points;
    for (float x = from_m; x < from_m + 4; x += 0.08F)
      for (float z = -1; z < 0.5F; z += 0.1F)
        if (x < 15) points.emplace_back(x, 6, z);
    return points;
  };
  const auto behind_post = [](std::vector<Eigen::Vector3f> points) {
    for (float y = 4.05F; y < 5.2F; y += 0.025F)
      for (float z = -0.8F; z < 0.6F; z += 0.05F) points.emplace_back(10.5F, y, z);
    return points;
  };
  const auto before = side(11.6F), now = side(12.8F);
  const SeenSpace seen_before = street_with(behind_post(before)),
                  seen_now = street_with(behind_post(now));
  EXPECT_FALSE(was_there_then({now, seen_now, false}, {1.2, 0}, Pose::Identity(), seen_before));
}

TEST(WasThereThen, a_short_step_cannot_be_told) {
  const auto object = vehicle(12, 3);
  const SeenSpace seen = street_with(object);
  EXPECT_TRUE(was_there_then({object, seen, true}, {1.2, 0}, Pose::Identity(), seen));
  EXPECT_FALSE(was_there_then({object, seen, true}, {0.5, 0}, Pose::Identity(), seen));
}

KnownMotion velocity(double x, double y, double sigma_x, double sigma_y) {
  KnownMotion known;
  known.velocity_at_rest = {x, y, 0};
  known.velocity_covariance.diagonal() << sigma_x * sigma_x, sigma_y * sigma_y;
  return known;
}

TEST(FusedMotion, follows_in_each_direction_who_knows_it) {
  // The side of a car slides along itself; on the picture it does not.
  const KnownMotion both = fused(velocity(4, 0.5, 0.3, 2), velocity(1.8, 0, 5, 0.1), 3);
  EXPECT_NEAR(both.velocity_at_rest.x(), 4, 0.15);
  EXPECT_NEAR(both.velocity_at_rest.y(), 0, 0.01);
  EXPECT_LT(both.velocity_covariance(0, 0), 1.1);
  EXPECT_LE(both.velocity_covariance(1, 1), 0.01);
}

TEST(FusedMotion, is_the_newer_one_where_they_contradict_each_other) {
  EXPECT_NEAR(fused(velocity(9, 0, 0.1, 0.1), velocity(2, 0, 0.1, 0.1), 3).velocity_at_rest.x(), 2,
              1e-9);
}

TEST(FusedMotion, hardly_trusts_what_was_long_ago) {
  KnownMotion newer = velocity(0, 0, 0.5, 0.5);
  newer.stamp = shifted(newer.stamp, 2);
  EXPECT_LT(fused(velocity(1, 0, 0.1, 0.1), newer, 3).velocity_at_rest.x(), 0.02);
}

TEST(EvidenceOfMotion, is_negative_only_where_scans_have_clearly_seen_an_object_stand) {
  KnownMotion known = velocity(0.05, 0, 0.1, 0.1);
  known.from_scans = true;
  EXPECT_LT(evidence_of_motion(known), -5);
  KnownMotion creeping = velocity(0.7, 0, 0.1, 0.1);
  creeping.from_scans = true;
  EXPECT_GT(evidence_of_motion(creeping), 16.8);
  KnownMotion unclear = velocity(0.05, 0, 0.4, 0.4);
  unclear.from_scans = true;
  EXPECT_GE(evidence_of_motion(unclear), 0);
  known.from_scans = false;
  EXPECT_GE(evidence_of_motion(known), 0);
}

TEST(ExpectMotion, is_as_wide_in_each_direction_as_the_velocity_was_unsure) {
  KnownMotion known;
  known.velocity_covariance << 0.01, 0, 0, 25;
  const MotionPrior prior = expect_motion(known, known.stamp, Eigen::Matrix3d::Identity(),
                                          Eigen::Vector3d(10, 0, 0), 0.1, MotionPriorOptions());
  EXPECT_GT(prior.position_covariance(1, 1), 50 * prior.position_covariance(0, 0));
}

}  // namespace
}  // namespace lidar_upsampling
