// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "label_score.h"

#include <gtest/gtest.h>

#include "evaluate/stamps.h"
#include "label_table.h"

namespace lidar_upsampling {
namespace {

constexpr double kHorizon_s = 0.1;

/// A car 20 m ahead, 4 m long, at an instant a tenth of a second after the key scan; nobody turns.
LabelledInstant car_at(double speed_mps, std::int64_t told_at = 7) {
  LabelledInstant instant;
  instant.told_at = told_at;
  instant.dt = kHorizon_s;
  LabelledBox car;
  car.id = "3";
  car.class_name = "car";
  car.T_box_lidar = Pose(Eigen::Translation3d(-20, 0, 0));
  car.size = {4, 2, 1.5};
  car.velocity = {speed_mps, 0, 0};
  car.speed_mps = speed_mps;
  instant.boxes.push_back(car);
  return instant;
}

/// What is told of an object whose points lie at a place of the key scan.
ReportedObject told(const Eigen::Vector3d& at_key, const Eigen::Vector3d& velocity,
                    bool moving = true) {
  ReportedObject row;
  row.stamp = 7;
  row.track = 1;
  row.points = 100;
  row.moving = moving;
  row.velocity = velocity;
  row.position = row.middle = at_key + kHorizon_s * velocity;
  return row;
}

LabelScore score_of(const LabelledInstant& instant, const std::vector<ReportedObject>& rows) {
  return score_labels({instant}, rows, {});
}

TEST(LabelScore, a_mover_is_off_by_the_wrong_velocity_times_the_horizon) {
  const LabelScore score = score_of(car_at(14), {told({20, 0, 0}, {12, 0.5, 3})});
  ASSERT_EQ(score.movers.size(), 1U);
  EXPECT_TRUE(score.movers[0].found);
  EXPECT_NEAR(score.movers[0].error_mps, std::hypot(2, 0.5), 1e-9);
  EXPECT_NEAR(score.movers[0].error_m, kHorizon_s * std::hypot(2, 0.5), 1e-9);
}

TEST(LabelScore, a_velocity_far_off_does_not_hide_the_row_from_its_label) {
  const LabelScore score = score_of(car_at(14), {told({20, 0, 0}, {-40, 0, 0})});
  ASSERT_EQ(score.movers.size(), 1U);
  EXPECT_TRUE(score.movers[0].found);
  EXPECT_NEAR(score.movers[0].error_m, 5.4, 1e-9);
  EXPECT_TRUE(score.false_shifts_m.empty());
}

TEST(LabelScore, the_rear_of_a_car_that_turns_swings_out) {
  LabelledInstant instant = car_at(6);
  instant.boxes[0].yaw_rate = 1;
  // Halfway it has turned by 0.05 rad.
  const Eigen::Vector3d swing(2 * std::sin(0.05), -2 * std::cos(0.05), 0);
  const LabelScore score = score_of(instant, {told({18, 0, 0}, Eigen::Vector3d(6, 0, 0) + swing)});
  ASSERT_EQ(score.movers.size(), 1U);
  EXPECT_NEAR(score.movers[0].error_mps, 0, 1e-9);
}

TEST(LabelScore, a_mover_that_no_row_tells_of_is_left_standing) {
  const LabelScore score = score_of(car_at(14), {});
  ASSERT_EQ(score.movers.size(), 1U);
  EXPECT_FALSE(score.movers[0].found);
  EXPECT_NEAR(score.movers[0].error_m, 1.4, 1e-9);
}

TEST(LabelScore, a_parked_car_counts_where_a_row_tells_of_it_and_shifts_where_it_is_told_to_move) {
  EXPECT_TRUE(score_of(car_at(0.1), {}).parked.empty());
  const LabelScore stands = score_of(car_at(0.1), {told({20, 0, 0}, {2, 0, 0}, false)});
  ASSERT_EQ(stands.parked.size(), 1U);
  EXPECT_FALSE(stands.parked[0].told_to_move);
  EXPECT_EQ(stands.parked[0].shift_m, 0);
  const LabelScore moves = score_of(car_at(0.1), {told({20, 0, 0}, {2, 0, 0})});
  ASSERT_EQ(moves.parked.size(), 1U);
  EXPECT_NEAR(moves.parked[0].shift_m, 0.2, 1e-9);
}

TEST(LabelScore, a_second_row_that_lets_a_parked_car_move_is_a_false_mover) {
  ReportedObject piece = told({19, 0, 0}, {3, 0, 0});
  piece.points = 5;
  const ReportedObject car = told({20, 0, 0}, {0, 0, 0}, false);
  EXPECT_EQ(score_of(car_at(0.1), {car, piece}).false_shifts_m.size(), 1U);
  EXPECT_TRUE(score_of(car_at(14), {car, piece}).false_shifts_m.empty());
}

/// A car 20 m ahead that brakes from 10 m/s by 4 m/s^2; the vehicle stands.
Truth braking(bool with_velocity) {
  Truth truth;
  truth.T_world_vehicle = Trajectory(InterpolationLimits{0.25, 0});
  TrueObject car;
  car.id = "3";
  car.size = {4, 2, 1.5};
  car.T_world_object = Trajectory(InterpolationLimits{0.25, 0});
  for (const double t : {0., 0.1, 0.2, 0.3}) {
    truth.T_world_vehicle.add({at(t), Pose::Identity()});
    car.T_world_object.add({at(t), Pose(Eigen::Translation3d(20 + 10 * t - 2 * t * t, 0, 0))});
    if (with_velocity) car.velocity[at(t)] = {10 - 4 * t, 0, 0};
  }
  truth.objects.push_back(car);
  return truth;
}

LabelledInstant instant_of(const Truth& truth, double t) {
  LidarScan key;
  key.stamp = at(0);
  key.points = {{20, 0, 0}};
  LabelledInstant instant = *labelled_instant(truth, key, at(t), {}, {});
  instant.told_at = 7;
  return instant;
}

TEST(LabelScore, of_what_brakes_the_way_that_it_has_gone_is_asked_for) {
  const double t = 0.2, way = 10 * t - 2 * t * t;
  ReportedObject row = told({20, 0, 0}, {way / t, 0, 0});
  row.position = row.middle = {20 + way, 0, 0};
  const LabelScore score = score_of(instant_of(braking(true), t), {row});
  ASSERT_EQ(score.movers.size(), 1U);
  EXPECT_NEAR(score.movers[0].error_m, 0, 1e-9);
}

TEST(LabelScore, a_label_of_unknown_velocity_takes_its_rows_and_does_not_count) {
  const LabelScore score =
      score_of(instant_of(braking(false), kHorizon_s), {told({20, 0, 0}, {9, 0, 0})});
  EXPECT_TRUE(score.movers.empty());
  EXPECT_TRUE(score.parked.empty());
  EXPECT_TRUE(score.false_shifts_m.empty());
}

TEST(LabelScore, what_creeps_is_neither_a_mover_nor_parked_but_no_false_mover) {
  const LabelScore score = score_of(car_at(0.6), {told({20, 0, 0}, {0.6, 0, 0})});
  EXPECT_TRUE(score.movers.empty());
  EXPECT_TRUE(score.parked.empty());
  EXPECT_TRUE(score.false_shifts_m.empty());
}

TEST(LabelScore, a_wall_told_to_move_is_a_false_mover) {
  const LabelScore score =
      score_of(car_at(14), {told({20, 0, 0}, {14, 0, 0}), told({20, 9, 0}, {3, 0, 0}),
                            told({30, 9, 0}, {0, 0, 0}, false)});
  ASSERT_EQ(score.false_shifts_m.size(), 1U);
  EXPECT_NEAR(score.false_shifts_m[0], 0.3, 1e-9);
  EXPECT_EQ(label_figures(score).false_per_image, 1);
}

TEST(LabelScore, an_area_that_nobody_labelled_excuses_what_is_told_to_move_there) {
  LabelledInstant instant = car_at(14);
  Camera camera;
  camera.model.fx = camera.model.fy = 500;
  camera.model.cx = 320;
  camera.model.cy = 240;
  camera.model.width = 640;
  camera.model.height = 480;
  camera.T_vehicle_camera.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  instant.ignored.emplace_back(camera, Box2d{180, 200, 220, 280});  // 5 m to the left of 20 m ahead
  EXPECT_TRUE(score_of(instant, {told({20, 5, 0}, {1, 0, 0})}).false_shifts_m.empty());
  EXPECT_EQ(score_of(instant, {told({20, -5, 0}, {1, 0, 0})}).false_shifts_m.size(), 1U);
}

TEST(LabelScore, of_several_rows_in_a_label_the_one_with_most_points_counts) {
  ReportedObject part = told({19, 0, 0}, {0, 0, 0}, false);
  part.points = 5;
  const LabelScore score = score_of(car_at(14), {part, told({20, 0, 0}, {14, 0, 0})});
  ASSERT_EQ(score.movers.size(), 1U);
  EXPECT_NEAR(score.movers[0].error_m, 0, 1e-9);
}

TEST(LabelScore, a_post_beside_a_label_does_not_tell_of_it_where_a_row_in_it_does) {
  ReportedObject walker = told({20, 0, 0}, {14, 0, 0}), post = told({20, 1.3, 0}, {0, 0, 0}, false);
  walker.points = 5;
  EXPECT_NEAR(score_of(car_at(14), {post, walker}).movers[0].error_m, 0, 1e-9);
  EXPECT_NEAR(score_of(car_at(14), {post}).movers[0].error_m, 1.4, 1e-9);
}

TEST(LabelScore, a_box_out_of_view_takes_its_rows_but_does_not_count) {
  LabelledInstant instant = car_at(14);
  instant.boxes[0].counts = false;
  const LabelScore score = score_of(instant, {told({20, 0, 0}, {5, 0, 0})});
  EXPECT_TRUE(score.movers.empty());
  EXPECT_TRUE(score.false_shifts_m.empty());
}

TEST(LabelScore, a_box_in_view_takes_a_row_whose_points_are_not) {
  ReportedObject row = told({20, 0, 0}, {14, 0, 0});
  row.in_view = false;
  const LabelScore score = score_of(car_at(14), {row});
  ASSERT_EQ(score.movers.size(), 1U);
  EXPECT_TRUE(score.movers[0].found);
  EXPECT_NEAR(score.movers[0].error_m, 0, 1e-9);
}

TEST(LabelScore, what_is_told_out_of_view_counts_there_as_labels_do) {
  ReportedObject wall = told({20, 9, 0}, {3, 0, 0});
  wall.in_view = false;
  EXPECT_TRUE(score_of(car_at(14), {wall}).false_shifts_m.empty());
  LabelScoreOptions all_around;
  all_around.all_around = true;
  EXPECT_EQ(score_labels({car_at(14)}, {wall}, all_around).false_shifts_m.size(), 1U);
}

TEST(LabelScore, another_track_on_the_same_object_is_a_switch) {
  ReportedObject later = told({20, 0, 0}, {14, 0, 0});
  later.stamp = 8;
  later.track = 2;
  const LabelScore score =
      score_labels({car_at(14, 7), car_at(14, 8)}, {told({20, 0, 0}, {14, 0, 0}), later}, {});
  EXPECT_EQ(score.num_followed, 1);
  EXPECT_EQ(score.num_switches, 1);
}

TEST(LabelTable, tells_all_movers_and_those_with_a_row_apart) {
  LabelScores scores;
  scores[Row::ego] = score_of(car_at(10), {});
  LabelScore ours = score_of(car_at(10), {told({20, 0, 0}, {10, 0, 0})});
  append(ours, score_of(car_at(10), {}));
  scores[Row::ours] = ours;
  const LabelFigures figures = label_figures(ours);
  EXPECT_EQ(figures.movers_m.count, 2);
  EXPECT_NEAR(figures.movers_m.mean, 0.5, 1e-9);
  EXPECT_EQ(figures.found_m.count, 1);
  EXPECT_NEAR(figures.found_m.mean, 0, 1e-9);
  EXPECT_NEAR(figures.velocity_rms_mps, std::sqrt(50), 1e-9);
  const std::string text = to_text(scores, 3);
  EXPECT_NE(text.find("labelled movers, error"), std::string::npos) << text;
  EXPECT_NE(text.find("labelled movers by class, mean m"), std::string::npos) << text;
  EXPECT_NE(text.find("3 more beyond the labels"), std::string::npos) << text;
}

}  // namespace
}  // namespace lidar_upsampling
