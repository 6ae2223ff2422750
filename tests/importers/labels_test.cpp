// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <gtest/gtest.h>

#include <sstream>

#include "import/box_projection.h"
#include "import/object_tracks.h"
#include "import/truth_tables.h"
#include "simulator/scenario.h"

namespace lidar_upsampling::importing {
namespace {

CameraModel picture_of_200_by_100() {
  CameraModel model;
  model.width = 200;
  model.height = 100;
  model.fx = model.fy = 100;
  model.cx = 100;
  model.cy = 50;
  return model;
}

std::optional<Box2d> projected(double x, double y, double z, const Eigen::Vector3d& size) {
  return project_box(picture_of_200_by_100(), Pose(Eigen::Translation3d(x, y, z)), size);
}

TEST(BoxProjection, is_as_wide_as_its_nearest_face) {
  // Two metres deep: its near face at 9 m, its far one at 11 m.
  const auto box = projected(1, 0.5, 10, {4, 1, 2});
  ASSERT_TRUE(box);
  EXPECT_NEAR(box->left, 100 + 100 * -1. / 9, 1e-9);
  EXPECT_NEAR(box->right, 100 + 100 * 3. / 9, 1e-9);
  EXPECT_NEAR(box->top, 50, 1e-9);
  EXPECT_NEAR(box->bottom, 50 + 100 * 1. / 9, 1e-9);
}

TEST(BoxProjection, ends_at_the_pictures_border) {
  const auto box = projected(10, 0, 10, {4, 40, 0.001});
  ASSERT_TRUE(box);
  EXPECT_NEAR(box->left, 180, 0.01);
  EXPECT_NEAR(box->right, 200, 1e-9);
  EXPECT_NEAR(box->top, 0, 1e-9);
  EXPECT_NEAR(box->bottom, 100, 1e-9);
}

TEST(BoxProjection, is_no_higher_than_what_the_picture_shows) {
  // Like a car beside the camera: its near end, which would be the highest, is out of the picture.
  const auto box = projected(3, 0, 5, {0.001, 1, 9.8});
  ASSERT_TRUE(box);
  EXPECT_NEAR(box->left, 100 + 100 * 3 / 9.9, 0.1);
  EXPECT_NEAR(box->right, 200, 1e-9);  // seen from 3 m on
  EXPECT_NEAR(box->top, 50 - 100 * 0.5 / 3, 0.1);
  EXPECT_NEAR(box->bottom, 50 + 100 * 0.5 / 3, 0.1);
}

TEST(BoxProjection, what_is_outside_or_behind_has_none) {
  EXPECT_FALSE(projected(15, 0, 10, {4, 1, 1}));
  EXPECT_FALSE(projected(0, -8, 10, {4, 1, 1}));
  EXPECT_FALSE(projected(0, 0, -10, {4, 1, 2}));
  EXPECT_FALSE(projected(0, 0, 900, {4, 1.5, 2}));  // less than a pixel
}

TEST(BoxProjection, the_part_behind_the_camera_is_cut_off) {
  // Beside the camera, from 3 m behind to 5 m ahead, its inner side 2 m to the right.
  const auto box = projected(3, 0, 1, {2, 1, 8});
  ASSERT_TRUE(box);
  EXPECT_NEAR(box->left, 100 + 100 * 2. / 5, 1e-9);
  EXPECT_NEAR(box->right, 200, 1e-9);
}

TEST(BoxProjection, a_model_with_distortion_is_refused) {
  CameraModel model = picture_of_200_by_100();
  model.distortion_model = DistortionModel::plumb_bob;
  EXPECT_THROW(static_cast<void>(project_box(model, Pose::Identity(), Eigen::Vector3d::Ones())),
               std::invalid_argument);
}

// Labelled every 0.1 s, at 3 m/s along y and turning at 0.5 rad/s.
ObjectTrack drive_by(int num_labels) {
  ObjectTrack track;
  track.size = {4, 2, 1.5};
  for (int i = 0; i < num_labels; ++i) {
    Pose T = Pose::Identity();
    T.translation().y() = 0.3 * i;
    T.rotate(Eigen::AngleAxisd(3.1 + 0.05 * i, Eigen::Vector3d::UnitZ()));
    track.poses.push_back({sim::stamp_of(i, 10, 0), T});
  }
  return track;
}

TEST(ObjectTracks, have_the_velocity_of_their_labels) {
  const ObjectTrack track = drive_by(5);
  const LabelWindow window = label_window_of({track});
  for (std::size_t i = 0; i < 5; ++i) {
    const auto v = velocity_at(track, i, window);
    ASSERT_TRUE(v) << i;
    EXPECT_LT((v->linear - Eigen::Vector3d(0, 3, 0)).norm(), 1e-9) << i;
    EXPECT_NEAR(v->yaw_rate, 0.5, 1e-9) << i;  // over the jump from pi to -pi, too
    EXPECT_TRUE(moves_at(track, i, window)) << i;
  }
}

TEST(ObjectTracks, too_short_for_a_velocity_have_empty_cells_in_the_table) {
  const ObjectTrack longer = drive_by(9);
  ObjectTrack shorter = drive_by(2);
  shorter.id = 1;
  const LabelWindow window = label_window_of({longer, shorter});
  EXPECT_EQ(window.min_labels, 5);
  EXPECT_FALSE(velocity_at(shorter, 0, window));
  EXPECT_FALSE(moves_at(shorter, 0, window));
  // At its end there are four labels within a third of a second, but six within half a one.
  EXPECT_FALSE(velocity_at(longer, 0, window));
  EXPECT_TRUE(moves_at(longer, 0, window));
  std::ostringstream table;
  write_objects_table(table, {longer, shorter});
  EXPECT_NE(table.str().find(",1.500000,,,,,1\n"), std::string::npos) << table.str();
  EXPECT_NE(table.str().find(",1.500000,,,,,0\n"), std::string::npos) << table.str();
  EXPECT_NE(table.str().find(",1.500000,0.000000,3.000000,"), std::string::npos) << table.str();
}

TEST(ObjectTracks, a_parked_car_whose_labels_jump_does_not_move) {
  ObjectTrack track = drive_by(11);
  for (std::size_t i = 0; i < track.poses.size(); ++i) {
    track.poses[i].T_world_object = Eigen::Translation3d(i % 2 == 0 ? 0.06 : -0.06, 0, 0);
  }
  for (std::size_t i = 0; i < track.poses.size(); ++i) {
    EXPECT_FALSE(moves_at(track, i, label_window_of({track}))) << i;
  }
}

TEST(ObjectTracks, are_followed_between_labels_and_a_little_beyond) {
  ObjectTrack track = drive_by(4);
  track.poses[1].hidden = true;
  const TrackInterpolator positions(track);
  const auto y_at = [&](double t) -> std::optional<double> {
    const auto T = positions.T_world_object(shifted(sim::start_stamp(), t));
    return T ? std::make_optional(T->translation().y()) : std::nullopt;
  };
  EXPECT_NEAR(y_at(0.27).value(), 0.81, 1e-6);
  EXPECT_NEAR(y_at(0.31).value(), 0.93, 2e-3);
  EXPECT_FALSE(y_at(0.4));
  EXPECT_FALSE(y_at(-0.1));
  EXPECT_FALSE(y_at(0.11));  // next to the label that says it is hidden
  EXPECT_TRUE(y_at(0.04));
}

}  // namespace
}  // namespace lidar_upsampling::importing
