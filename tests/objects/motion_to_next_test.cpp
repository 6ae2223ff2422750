// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/motion_to_next.h"

#include <gtest/gtest.h>

namespace lidar_upsampling {
namespace {

using Points = std::vector<Eigen::Vector3f>;

constexpr double kScanPeriod = 0.1;
constexpr double kRings_deg = 0.4;
const LevelGaussian kAnywhere{{0, 0}, 1.44 * Eigen::Matrix2d::Identity()};

Points rear(float x) {
  Points points;
  for (float z = -1.2F; z < 0.3F; z += 0.15F)
    for (float y = -0.9F; y <= 0.9F; y += 0.1F) points.emplace_back(x, y, z);
  return points;
}

// The rear of a vehicle ahead at `x`, and its left side.
Points vehicle(float x) {
  Points points = rear(x);
  for (float z = -1.2F; z < 0.3F; z += 0.15F)
    for (float along = 0.1F; along < 3; along += 0.1F) points.emplace_back(x + along, 0.9F, z);
  return points;
}

NextScan next_scan(const Points& points, const Pose& T_next_k = Pose::Identity()) {
  return {shifted(Stamp{}, kScanPeriod), Surface(points), T_next_k,
          SeenSpace(points, kRings_deg), nullptr,         kRings_deg};
}

std::optional<MotionToNext> measured(const NextScan& next,
                                     const LevelGaussian& expected = kAnywhere) {
  return measure_to_next({vehicle(12), Stamp{}, {}, expected, true}, next);
}

double evidence_of(const MotionToNext& motion) {
  const Travel unknown =
      expect_travel({}, Stamp{}, Eigen::Matrix3d::Identity(), MotionPriorOptions());
  return evidence_of_motion(having_seen(unknown, motion.step, motion.dt), motion.dt, false);
}

TEST(MeasureToNext, a_step_of_which_nothing_was_known_is_found) {
  const auto motion = measured(next_scan(vehicle(13.2F)));
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->step.mean.x(), 1.2, 0.02);
  EXPECT_NEAR(motion->step.mean.y(), 0, 0.02);
  EXPECT_DOUBLE_EQ(motion->dt, kScanPeriod);
  EXPECT_GT(evidence_of(*motion), 100);
}

TEST(MeasureToNext, the_step_is_one_over_ground) {
  // The ego has moved on by 1 m, the vehicle has not.
  const auto motion =
      measured(next_scan(vehicle(11), Eigen::Translation3d(-1, 0, 0) * Pose::Identity()));
  ASSERT_TRUE(motion);
  EXPECT_LT(motion->step.mean.norm(), 0.02);
  EXPECT_LT(evidence_of(*motion), 4);
}

TEST(MeasureToNext, a_scan_that_does_not_show_the_object_says_nothing) {
  EXPECT_FALSE(measured(next_scan(vehicle(40))));
}

TEST(MeasureToNext, a_lookalike_far_from_where_the_object_is_expected_is_another_one) {
  const LevelGaussian parked{{0, 0}, 0.01 * Eigen::Matrix2d::Identity()};
  EXPECT_FALSE(measured(next_scan(vehicle(13.2F)), parked));
}

TEST(MeasureToNext, of_two_alike_the_expected_one_is_taken) {
  Points both = vehicle(12), moved = vehicle(13.2F);
  both.insert(both.end(), moved.begin(), moved.end());
  const LevelGaussian expected{{1.1, 0}, 0.04 * Eigen::Matrix2d::Identity()};
  const Pose guess = Eigen::Translation3d(1.1, 0, 0) * Pose::Identity();
  const auto motion =
      measure_to_next({vehicle(12), Stamp{}, {guess}, expected, false}, next_scan(both));
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->step.mean.x(), 1.2, 0.03);
}

TEST(MeasureToNext, a_lookalike_that_stood_there_before_is_another_one) {
  Points both = vehicle(12), neighbour = vehicle(13.2F);
  both.insert(both.end(), neighbour.begin(), neighbour.end());
  const LevelGaussian expected{{1.1, 0}, 0.04 * Eigen::Matrix2d::Identity()};
  const Pose guess = Eigen::Translation3d(1.1, 0, 0) * Pose::Identity();
  const SoughtObject object{vehicle(12), Stamp{}, {guess}, expected, false};
  const SeenSpace seen_k(both, kRings_deg);
  NextScan next = next_scan(both);
  next.seen_k = &seen_k;
  EXPECT_FALSE(measure_to_next(object, next));
  next.seen_k = nullptr;
  EXPECT_TRUE(measure_to_next(object, next));
}

TEST(MeasureToNext, what_is_hidden_by_then_does_not_speak_against_a_step) {
  // Of the vehicle's rear all but the left third hides behind a wall.
  Points next;
  for (const Eigen::Vector3f& point : rear(12.8F))
    if (point.y() > 0.25F) next.push_back(point);
  for (float z = -1; z < 0.5F; z += 0.03F)
    for (float y = -0.8F; y < 0.08F; y += 0.02F) next.emplace_back(6, y, z);
  const Pose guess = Eigen::Translation3d(0.7, 0, 0) * Pose::Identity();
  const auto motion =
      measure_to_next({rear(12), Stamp{}, {guess}, kAnywhere, false}, next_scan(next));
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->step.mean.x(), 0.8, 0.03);
}

TEST(MeasureToNext, the_farther_apart_the_rings_the_less_sure_is_the_step) {
  NextScan next = next_scan(vehicle(13.2F));
  const auto dense = measured(next);
  next.vertical_step_deg = 2;
  const auto sparse = measured(next);
  ASSERT_TRUE(dense && sparse);
  EXPECT_EQ(sparse->step.mean, dense->step.mean);
  EXPECT_GT(sparse->step.covariance.trace(), 2 * dense->step.covariance.trace());
}

MotionToNext two_metres_in(double seconds) {
  MotionToNext motion;
  motion.dt = seconds;
  motion.T_mov = Eigen::Translation3d(2, 0, 0) * Pose::Identity();
  motion.centroid_k = {10, 3, 0};
  motion.step = {{2, 0}, 1e-4 * Eigen::Matrix2d::Identity()};
  return motion;
}

// Columns of points on a wall along the view, each 0.2 m from one to the next, as a LiDAR that
// passes by draws them: `step` apart along the wall.
Points wall_along(float first, float step) {
  Points points;
  for (float x = first; x < first + 5; x += step)
    for (float z = -1; z < 1; z += 0.2F) points.emplace_back(x, -8, z);
  return points;
}

TEST(MeasureToNext, of_a_wall_along_the_view_no_step_is_told_by_how_its_points_happen_to_lie) {
  // The next scan's columns lie 0.15 m off the key scan's, and end where those do.
  constexpr float kStep = 0.4F;
  const auto motion = measure_to_next({wall_along(25, kStep), Stamp{}, {}, kAnywhere, true},
                                      next_scan(wall_along(25.15F, kStep)));
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->step.mean.x(), 0.15, 0.05);
  EXPECT_GT(motion->step.covariance(0, 0), 0.1 * 0.1);
  EXPECT_LT(motion->step.covariance(1, 1), 0.05 * 0.05);
  EXPECT_LT(evidence_of(*motion), 5.99);
}

TEST(MeasureToNext, who_has_lost_a_third_of_its_surface_is_another_one) {
  Points object = rear(12);
  for (float z = -1.2F; z < 0.3F; z += 0.15F)
    for (float y = -0.4F; y <= 0.4F; y += 0.1F) object.emplace_back(11, y, z);
  const auto to = [&](const Points& next) {
    return measure_to_next({object, Stamp{}, {}, kAnywhere, true}, next_scan(next));
  };
  Points whole = object;
  for (Eigen::Vector3f& point : whole) point.x() += 0.5F;
  EXPECT_TRUE(to(whole));
  EXPECT_FALSE(to(rear(12.5F)));
}

// Of a vehicle's side, 2.5 m to the right, what a view shows between its edge and a panel that
// hides all that lies farther than 4.8 m ahead.
Points side_in_gap(float until) {
  Points points;
  for (float z = -0.9F; z < -0.4F; z += 0.05F)
    for (float x = 4.6F; x < until; x += 0.02F) points.emplace_back(x, -2.5F, z);
  return points;
}

Points with_panel(Points points) {
  for (float z = -1; z < 0.2F; z += 0.01F)
    for (float x = 2.9F; x < 4.6F; x += 0.01F) points.emplace_back(x, -1.5F, z);
  return points;
}

TEST(MeasureToNext, what_may_have_gone_behind_something_is_not_told_by_what_has_come_after_it) {
  const auto variance_along = [&](const Points& scan_k) {
    const SeenSpace seen_k(scan_k, kRings_deg);
    NextScan known = next_scan(with_panel(side_in_gap(4.8F)));
    known.seen_k = &seen_k;
    const auto motion = measure_to_next({side_in_gap(4.7F), Stamp{}, {}, kAnywhere, true}, known);
    return motion ? motion->step.covariance(0, 0) : -1;
  };
  const Points cut_off = with_panel(side_in_gap(4.7F));
  EXPECT_GT(variance_along(cut_off), 0.5 * 0.5);
  // Where the key scan saw that nothing was to come after it, it is what is seen now.
  Points with_background = cut_off;
  for (float z = -6; z < -2; z += 0.1F)
    for (float y = -17; y < -13; y += 0.05F) with_background.emplace_back(23, y, z);
  EXPECT_LT(variance_along(with_background), 0.1 * 0.1);
  EXPECT_GE(variance_along(with_background), 0);
}

TEST(ExpectOnTheWay, goes_at_constant_velocity_and_is_least_sure_where_nothing_ties_it) {
  const MotionPriorOptions options;
  const MotionToNext motion = two_metres_in(0.4);
  const Travel travel = having_seen(
      expect_travel({}, Stamp{}, Eigen::Matrix3d::Identity(), options), motion.step, motion.dt);
  const auto at = [&](double dt) { return expect_on_the_way(motion, travel, dt, options); };
  EXPECT_NEAR(at(0.1).T_mov.translation().x(), 0.5, 0.01);
  EXPECT_GT(at(0.2).position_covariance(0, 0), 4 * at(0.4).position_covariance(0, 0));
  EXPECT_GT(at(0.2).position_covariance(0, 0), 4 * at(0.02).position_covariance(0, 0));
}

TEST(ExpectOnTheWay, who_was_faster_before_is_past_the_middle_at_half_time) {
  const MotionPriorOptions options;
  const MotionToNext motion = two_metres_in(0.4);
  KnownMotion known;
  known.velocity_at_rest.x() = 6;
  known.velocity_covariance = 0.01 * Eigen::Matrix2d::Identity();
  const Travel travel = having_seen(
      expect_travel(known, Stamp{}, Eigen::Matrix3d::Identity(), options), motion.step, motion.dt);
  const Pose T_mov = expect_on_the_way(motion, travel, 0.2, options).T_mov;
  EXPECT_NEAR((T_mov * motion.centroid_k).x() - 10, 1.1, 0.02);
}

TEST(EvidenceOfMotion, is_significant_sooner_where_no_picture_speaks_for_parked) {
  const Travel travel =
      having_seen(expect_travel({}, Stamp{}, Eigen::Matrix3d::Identity(), MotionPriorOptions()),
                  {{0.27, 0}, 0.01 * Eigen::Matrix2d::Identity()}, kScanPeriod);
  constexpr double kSignificant = 16.8;  // of six degrees of freedom, as ObjectMotionOptions has it
  EXPECT_LT(evidence_of_motion(travel, kScanPeriod, false), kSignificant);
  EXPECT_GT(evidence_of_motion(travel, kScanPeriod, true), kSignificant);
}

}  // namespace
}  // namespace lidar_upsampling
