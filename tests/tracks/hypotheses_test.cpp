// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/tracks/hypotheses.h"

#include <gtest/gtest.h>

#include <random>

#include "tracks/car_on_pictures.h"

namespace lidar_upsampling {
namespace {

using testing::kStart;

using testing::ahead;
using testing::car;
using testing::kCentroid;
using testing::seen_on;

ObjectTrack new_track() {
  ObjectTrack track;
  track.stamp = kStart;
  track.state = track.latest = new_track_state(kStart, {});
  track.log_odds = -1;
  return track;
}

ObjectTrack known_track(double vx, double log_odds) {
  ObjectTrack track = new_track();
  track.state.mean[3] = vx;
  track.state.covariance(3, 3) = track.state.covariance(4, 4) = 0.04;
  track.log_odds = log_odds;
  return track;
}

MotionQuestion question_after(double dt, int num_followed = 60) {
  MotionQuestion question;
  question.instant = shifted(kStart, dt);
  question.centroid = kCentroid;
  question.num_followed = num_followed;
  return question;
}

Twist to_the_side(double y) {
  Twist motion = Twist::Zero();
  motion[4] = y;
  return motion;
}

ImageFactor picture_of(const Twist& motion, unsigned seed = 1,
                       const Eigen::Vector3d& car_at = Eigen::Vector3d::Zero(),
                       double noise_px = 0.3) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  auto points = car();
  for (Eigen::Vector3d& point : points) point += car_at;
  auto seen = seen_on(ahead(), points, motion);
  for (Observation& observation : seen)
    observation.normalised += noise_px * Eigen::Vector2d(normal(random), normal(random)) / 700;
  ImageFactor image;
  image.add({ahead(), 1, Eigen::Vector3d::Zero()}, seen);
  return image;
}

TEST(Hypotheses, a_new_object_that_the_picture_shows_to_move_moves) {
  const Twist truth = to_the_side(0.5);
  const MotionAnswer answer =
      estimate_motion(new_track(), picture_of(truth), question_after(0.1), {truth}, {});
  EXPECT_TRUE(answer.moves);
  EXPECT_NEAR(answer.moving.mean[4], 0.5, 0.02);
  EXPECT_NEAR(answer.state.velocity().y(), 5, 0.3);
}

ObjectTrack track_that_may_go_anywhere() {
  ObjectTrack track = new_track();
  track.beginnings = {{track.state, 1}};
  return track;
}

// A noisy picture taken soon tells little of how far something straight ahead has gone.
TEST(Hypotheses, a_new_object_goes_as_fast_as_the_traffic_if_the_picture_does_not_say_otherwise) {
  Twist truth = Twist::Zero();
  truth[3] = 0.6;
  double alone_m = 0, in_traffic_m = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    MotionQuestion question = question_after(0.03);
    const auto error = [&] {
      const ImageFactor image = picture_of(truth, seed, Eigen::Vector3d::Zero(), 0.6);
      return std::abs(estimate_motion(track_that_may_go_anywhere(), image, question, {truth}, {})
                          .moving.mean[3] -
                      truth[3]);
    };
    alone_m += error();
    question.ego_velocity = {20, 0};
    in_traffic_m += error();
  }
  EXPECT_LT(in_traffic_m, 0.7 * alone_m);
}

TEST(Hypotheses, traffic_is_no_reason_to_see_a_parked_car_move) {
  for (unsigned seed = 0; seed < 50; ++seed)
    for (const double speed : {2., 10., 20.}) {
      MotionQuestion question = question_after(0.1);
      question.ego_velocity = {speed, 0};
      EXPECT_FALSE(estimate_motion(track_that_may_go_anywhere(), picture_of(Twist::Zero(), seed),
                                   question, {}, {})
                       .moves);
    }
}

TEST(Hypotheses, a_parked_car_stays_parked_on_every_noisy_picture) {
  for (unsigned seed = 0; seed < 50; ++seed)
    EXPECT_FALSE(
        estimate_motion(new_track(), picture_of(Twist::Zero(), seed), question_after(0.1), {}, {})
            .moves);
}

TEST(Hypotheses, what_the_ego_motion_may_be_wrong_by_is_no_motion) {
  const Twist by_5_cm = to_the_side(0.05);
  MotionQuestion question = question_after(0.1);
  EXPECT_TRUE(estimate_motion(new_track(), picture_of(by_5_cm), question, {by_5_cm}, {}).log_odds >
              -1)
      << "with exact ego-motion it is one";
  question.ego_covariance(4, 4) = 0.05 * 0.05;
  EXPECT_FALSE(estimate_motion(new_track(), picture_of(by_5_cm), question, {by_5_cm}, {}).moves);
}

TEST(Hypotheses, however_many_points_agree_a_picture_tells_no_more_than_its_common_error) {
  Twist truth = Twist::Zero();
  truth[3] = 1;
  const MotionAnswer answer =
      estimate_motion(known_track(10, 5), picture_of(truth), question_after(0.1), {truth}, {});
  const double shift_m = TrackOptions().common_error_px / 700 * kCentroid.norm();
  EXPECT_GT(answer.moving.covariance(4, 4), shift_m * shift_m);
  EXPECT_GT(answer.moving.covariance(3, 3), 4 * answer.moving.covariance(4, 4))
      << "coming nearer is seen by how an object grows, which is less sure than where it is";
}

TEST(Hypotheses, how_an_object_grows_tells_the_less_the_more_its_points_scatter) {
  Twist truth = Twist::Zero();
  truth[3] = 0.6;
  ObjectTrack track = known_track(6, 5);
  track.state.covariance(3, 3) = 9;
  const auto sigma_m = [&](double noise_px) {
    const ImageFactor image = picture_of(truth, 1, Eigen::Vector3d::Zero(), noise_px);
    return std::sqrt(
        estimate_motion(track, image, question_after(0.1), {truth}, {}).moving.covariance(3, 3));
  };
  EXPECT_GT(sigma_m(0.4), 1.6 * sigma_m(0.15));
}

TEST(Hypotheses, that_few_points_are_found_again_is_a_sign_of_a_wrong_place) {
  const Twist by_half_a_metre = to_the_side(0.5);
  const auto answer = [&](int num_followed) {
    ImageFactor image = picture_of(by_half_a_metre);
    image.observations.resize(8);
    return estimate_motion(new_track(), image, question_after(0.1, num_followed), {by_half_a_metre},
                           {});
  };
  EXPECT_TRUE(answer(8).is_seen);
  EXPECT_FALSE(answer(200).is_seen);
  EXPECT_LT(answer(40).log_odds, answer(8).log_odds - 1);
}

TEST(Hypotheses, a_picture_that_may_be_wrong_leaves_what_was_known_possible) {
  const ObjectTrack track = known_track(10, 5);
  ImageFactor image = picture_of(to_the_side(0.5));  // it cannot have turned so hard
  image.observations.resize(8);
  const MotionAnswer answer =
      estimate_motion(track, image, question_after(0.1, 40), {to_the_side(0.5)}, {});
  EXPECT_FALSE(answer.is_seen);
  EXPECT_TRUE(answer.moves);
  EXPECT_NEAR(answer.moving.mean[3], 1, 0.1);
}

TEST(Hypotheses, a_mover_goes_on_where_no_camera_sees_it_ever_less_certainly) {
  const ObjectTrack track = known_track(10, 5);
  const MotionAnswer soon = estimate_motion(track, {}, question_after(0.1), {}, {});
  const MotionAnswer later = estimate_motion(track, {}, question_after(0.3), {}, {});
  EXPECT_TRUE(soon.moves);
  EXPECT_FALSE(soon.is_seen);
  EXPECT_NEAR(soon.moving.mean[3], 1, 1e-6);
  EXPECT_NEAR(later.moving.mean[3], 3, 1e-6);
  EXPECT_GT(later.moving.covariance(3, 3), 4 * soon.moving.covariance(3, 3));
}

TEST(Hypotheses, what_one_picture_tells_goes_on_where_the_next_one_says_nothing) {
  ObjectTrack track = new_track();
  const Twist step = to_the_side(0.3);
  note_answer(track, estimate_motion(track, picture_of(step), question_after(0.05), {step}, {}),
              {});
  const MotionAnswer answer = estimate_motion(track, {}, question_after(0.1), {}, {});
  EXPECT_FALSE(answer.is_seen);
  EXPECT_TRUE(answer.moves);
  EXPECT_NEAR(answer.moving.mean[4], 0.6, 0.1);
}

TEST(Hypotheses, a_picture_of_few_points_is_read_by_what_the_one_before_told) {
  const auto error = [](const ObjectTrack& track) {
    const Twist later = to_the_side(1);
    ImageFactor image = picture_of(later, 2);
    image.observations.resize(6);
    for (std::size_t i = 0; i < 3; ++i) image.observations[i].normalised.x() += 0.02;  // astray
    const MotionAnswer answer = estimate_motion(track, image, question_after(0.2, 60), {later}, {});
    EXPECT_TRUE(answer.moves);
    return (answer.moving.mean - later).norm();
  };
  ObjectTrack track = new_track();
  track.log_odds = 3;
  const double alone = error(track);
  const Twist step = to_the_side(0.5);
  note_answer(track, estimate_motion(track, picture_of(step), question_after(0.1), {step}, {}), {});
  EXPECT_LT(error(track), 0.1);
  EXPECT_GT(alone, 0.2);
}

TEST(Hypotheses, of_the_pictures_since_the_last_sight_the_one_that_tells_most_is_kept) {
  ObjectTrack track = new_track();
  const auto see = [&](double dt, std::size_t num_points) {
    const Twist motion = to_the_side(3 * dt);
    ImageFactor image = picture_of(motion);
    image.observations.resize(num_points);
    note_answer(track, estimate_motion(track, image, question_after(dt, 60), {motion}, {}), {});
  };
  see(0.1, 60);
  const TrackState many = track.latest;
  see(0.15, 12);
  EXPECT_EQ(track.latest.stamp, many.stamp) << "twelve points tell less";
  see(0.2, 60);
  EXPECT_EQ(track.latest.stamp, shifted(kStart, 0.2)) << "a longer way tells more";
  const TrackState foretold = predicted(many, track.latest.stamp, {});
  EXPECT_LT(track.latest.covariance(4, 4), foretold.covariance(4, 4));
}

TEST(Hypotheses, what_a_picture_tells_is_kept_and_what_scans_to_come_tell_is_not) {
  ObjectTrack track = known_track(2, 1);
  track.state.covariance(3, 3) = 4;
  track.ahead = Ahead{track.state, predicted(track.state, shifted(kStart, 0.1), {}), 3};
  const MotionAnswer answer =
      estimate_motion(track, picture_of(Twist::Zero()), question_after(0.1), {}, {});
  ASSERT_TRUE(answer.is_seen);
  EXPECT_LT(answer.log_ratio, -0.5);
  EXPECT_NEAR(answer.log_odds, std::max(-kMostLogOdds, 3 + answer.log_ratio), 1e-9);
  note_answer(track, answer, {});
  EXPECT_NEAR(track.latest_log_odds, std::max(-kMostLogOdds, 1 + answer.log_ratio), 1e-9);
}

TEST(Hypotheses, what_scans_and_picture_hold_for_parked_is_settled_until_its_next_sight) {
  const auto is_settled = [](double log_odds, double moved_m, std::size_t num_points) {
    ObjectTrack track = known_track(0, log_odds);
    const Twist motion = to_the_side(moved_m);
    ImageFactor image = picture_of(motion);
    image.observations.resize(num_points);
    note_answer(track, estimate_motion(track, image, question_after(0.1, 8), {motion}, {}), {});
    return track.settled != nullptr;
  };
  EXPECT_TRUE(is_settled(-kMostLogOdds, 0, 8));
  EXPECT_FALSE(is_settled(-2, 0, 8)) << "it may yet be another";
  EXPECT_FALSE(is_settled(-kMostLogOdds, 0.5, 60)) << "the picture says otherwise";
}

TEST(Hypotheses, what_may_as_well_be_parked_stays_where_no_camera_sees_it) {
  EXPECT_FALSE(estimate_motion(known_track(10, 0), {}, question_after(0.1), {}, {}).moves);
}

TEST(Hypotheses, few_points_do_not_move_what_scans_have_shown_to_stand) {
  ObjectTrack track = new_track();
  const Twist wrong_way = to_the_side(0.5);
  ImageFactor image = picture_of(wrong_way);
  image.observations.resize(12);
  const auto odds = [&] {
    return estimate_motion(track, image, question_after(0.1, 12), {wrong_way}, {});
  };
  EXPECT_TRUE(odds().moves);
  track.log_odds = -4;
  EXPECT_FALSE(odds().moves);
}

TEST(Hypotheses,
     points_so_few_that_a_motion_can_be_made_to_agree_with_them_do_not_move_what_is_new) {
  const Twist any_way = to_the_side(0.5);
  ImageFactor image = picture_of(any_way);
  image.observations.resize(8);
  EXPECT_FALSE(estimate_motion(new_track(), image, question_after(0.1, 8), {any_way}, {}).moves);
}

TEST(Hypotheses, what_may_go_our_road_is_not_held_for_parked_where_the_picture_cannot_tell) {
  const Eigen::Vector3d far(60, 0, 0);  // where little is seen of a motion along the road
  const ImageFactor image = picture_of(Twist::Zero(), 1, far);
  MotionQuestion question = question_after(0.03);
  question.centroid += far;
  ObjectTrack track = new_track();
  track.log_odds = 4;
  const double anywhere = estimate_motion(track, image, question, {}, {}).log_odds;
  track.beginnings = {{track.state, 0.5}, {going_along(track.state, 0, {}), 0.5}};
  EXPECT_GT(estimate_motion(track, image, question, {}, {}).log_odds, anywhere + 0.5);
}

TEST(Hypotheses, points_that_agree_on_nothing_tell_nothing) {
  ImageFactor image = picture_of(Twist::Zero());
  std::mt19937 random(2);
  std::uniform_real_distribution<double> anywhere(-0.1, 0.1);
  for (Observation& observation : image.observations)
    observation.normalised += Eigen::Vector2d(anywhere(random), anywhere(random));
  const ObjectTrack track = known_track(10, 5);
  const MotionAnswer blind = estimate_motion(track, {}, question_after(0.1), {}, {});
  const MotionAnswer answer = estimate_motion(track, image, question_after(0.1), {}, {});
  EXPECT_NEAR(answer.moving.mean[3], blind.moving.mean[3], 0.05);
  EXPECT_GT(answer.moving.covariance(3, 3), 0.8 * blind.moving.covariance(3, 3));
  EXPECT_NEAR(answer.log_odds, track.log_odds, 2);
}

TEST(Hypotheses, without_the_test_all_that_is_seen_moves_as_it_was_fitted) {
  TrackOptions options;
  options.static_test = false;
  EXPECT_TRUE(
      estimate_motion(new_track(), picture_of(Twist::Zero()), question_after(0.1), {}, options)
          .moves);
}

}  // namespace
}  // namespace lidar_upsampling
