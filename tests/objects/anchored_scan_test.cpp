// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/anchored_scan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "lidar_upsampling/objects/point_tracks.h"
#include "lidar_upsampling/vision/klt.h"
#include "street_scan.h"

namespace lidar_upsampling {
namespace {

constexpr double kPostDepth = 10, kWallDepth = 20;

/// An upright post, 0.3 m wide, before a wall, in the camera's frame: beams every 3 px.
class PostBeforeAWall : public ::testing::Test {
 protected:
  PostBeforeAWall() {
    const CameraModel camera = testing::wide_camera().model;
    const double half_px = camera.fx * 0.15 / kPostDepth;
    for (double v = 100; v < 200; v += 3)
      for (double u = camera.cx - 60; u < camera.cx + 60; u += 3) {
        const bool on_post = std::abs(u - camera.cx) < half_px;
        const double depth = on_post ? kPostDepth : kWallDepth;
        if (on_post) post_.push_back(static_cast<int>(scan_.points.size()));
        scan_.points.emplace_back(depth * (u - camera.cx) / camera.fx,
                                  depth * (v - camera.cy) / camera.fy, depth);
      }
    anchored_ = anchor_scan(scan_, camera, Pose::Identity());
    followed_ = followable_points(anchored_, post_, 1000);
    surfaces_ = surfaces_on(anchored_, {followed_}, {camera.width, camera.height});
    middle_ = camera.cx;
  }

  LidarScan scan_;
  std::vector<int> post_;
  AnchoredScan anchored_;
  std::vector<ProjectedPoint> followed_;
  SurfaceMap surfaces_;
  double middle_ = 0;
};

TEST_F(PostBeforeAWall, is_itself_where_it_is_and_the_wall_is_none_of_it) {
  const auto label_at = [&](double off) {
    return surfaces_.label.at<std::int16_t>(150, cvRound(middle_ + off));
  };
  EXPECT_EQ(label_at(0), 0);
  for (const double side : {-1., 1.}) {
    EXPECT_NE(label_at(16 * side), 0);
    EXPECT_NE(label_at(16 * side), SurfaceMap::kUnknown);
  }
  EXPECT_EQ(surfaces_.label.at<std::int16_t>(20, cvRound(middle_)), SurfaceMap::kUnknown);
}

TEST_F(PostBeforeAWall, leaves_untold_what_no_patch_about_it_shows) {
  EXPECT_EQ(surfaces_.label.at<std::int16_t>(150, cvRound(middle_ + 50)), SurfaceMap::kUnknown);
}

TEST_F(PostBeforeAWall, hides_what_is_behind_it_as_far_as_its_edge_may_reach) {
  std::vector<ProjectedPoint> wall;  // as an object, too
  for (std::size_t i = 0; i < anchored_.points.size(); ++i)
    if (anchored_.points[i].depth > 15) wall.push_back(anchored_.points[i]);
  const SurfaceMap both = surfaces_on(anchored_, {followed_, wall}, surfaces_.label.size());
  float right = 0;  // of its last point
  for (const ProjectedPoint& point : followed_) right = std::max(right, point.u);
  EXPECT_EQ(both.label.at<std::int16_t>(150, cvRound(right + 1)), 0);
  EXPECT_EQ(both.label.at<std::int16_t>(150, cvRound(right + 10)), 1);
}

/// A picture of the post, which has gone some pixels to the right, before the wall, which has not.
cv::Mat picture_of_post(const CameraModel& camera, double half_px, int moved_px) {
  const auto texture = [&](int seed) {
    cv::Mat noise(camera.height, camera.width, CV_8UC1);
    cv::theRNG().state = static_cast<std::uint64_t>(seed);
    cv::randu(noise, 0, 256);
    cv::GaussianBlur(noise, noise, cv::Size(), 1.5);
    return noise;
  };
  cv::Mat picture = texture(5);
  const cv::Rect on_post(cvRound(camera.cx - half_px), 0, cvRound(2 * half_px), camera.height);
  texture(6)(on_post).copyTo(picture(on_post + cv::Point(moved_px, 0)));
  return picture;
}

TEST_F(PostBeforeAWall, patches_that_show_both_follow_the_post_and_not_the_wall) {
  constexpr int kMoved_px = 3;
  const CameraModel camera = testing::wide_camera().model;
  const double half_px = camera.fx * 0.15 / kPostDepth;
  const ImagePyramid before(picture_of_post(camera, half_px, 0));
  const ImagePyramid after(picture_of_post(camera, half_px, kMoved_px));
  std::vector<cv::Point2f> pixels, guesses;
  for (const ProjectedPoint& point : followed_) {
    pixels.emplace_back(point.u, point.v);
    guesses.emplace_back(point.u + kMoved_px - 1, point.v);
  }
  const PointLabels labels{surfaces_, std::vector<std::int16_t>(pixels.size(), 0)};
  const auto num_lost = [&](const PointLabels* of_surface) {
    const KltResult result = track_points(before, after, pixels, guesses, {}, of_surface);
    int count = 0;
    for (std::size_t i = 0; i < pixels.size(); ++i)
      count += result.tracked[i] == 0 ||
               cv::norm(result.points[i] - pixels[i] - cv::Point2f(kMoved_px, 0)) > 0.5;
    return count;
  };
  EXPECT_GT(num_lost(nullptr), 20);
  EXPECT_LT(num_lost(&labels), 0.3 * num_lost(nullptr));
}

}  // namespace
}  // namespace lidar_upsampling
