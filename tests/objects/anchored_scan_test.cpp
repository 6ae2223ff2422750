// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/anchored_scan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "lidar_upsampling/objects/point_tracks.h"
#include "lidar_upsampling/vision/klt.h"
#include "street_scan.h"

namespace lidar_upsampling {
namespace {

constexpr double kPostDepth = 10, kWallDepth = 20;

/// An upright post, 0.3 m wide, before a wall, in the camera's frame: beams every 3 px.
class PostBeforeAWall : public ::testing::Test {
 protected:
  explicit PostBeforeAWall(bool with_wall_on_the_right = true) {
    const CameraModel camera = testing::wide_camera().model;
    const double half_px = camera.fx * 0.15 / kPostDepth;
    for (double v = 100; v < 200; v += 3)
      for (double u = camera.cx - 60; u < camera.cx + 60; u += 3) {
        const bool on_post = std::abs(u - camera.cx) < half_px;
        if (!on_post && u > camera.cx && !with_wall_on_the_right) continue;
        const double depth = on_post ? kPostDepth : kWallDepth;
        if (on_post) post_.push_back(static_cast<int>(scan_.points.size()));
        scan_.points.emplace_back(depth * (u - camera.cx) / camera.fx,
                                  depth * (v - camera.cy) / camera.fy, depth);
      }
    anchored_ = anchor_scan(scan_, camera, Pose::Identity());
    followed_ = followable_points(anchored_, post_, 1000);
    shifts_ = inward_shifts(anchored_, post_, followed_);
    middle_ = camera.cx;
  }

  LidarScan scan_;
  std::vector<int> post_;
  AnchoredScan anchored_;
  std::vector<ProjectedPoint> followed_;
  std::vector<cv::Point2f> shifts_;
  double middle_ = 0;
};

class PostAtTheEndOfAWall : public PostBeforeAWall {
 protected:
  PostAtTheEndOfAWall() : PostBeforeAWall(false) {}
};

TEST_F(PostBeforeAWall, patches_at_its_sides_move_towards_its_middle_by_a_few_pixels) {
  ASSERT_EQ(shifts_.size(), followed_.size());
  int left = 0, right = 0;
  for (std::size_t i = 0; i < shifts_.size(); ++i) {
    const double off = followed_[i].u - middle_;
    if (std::abs(off) < 8) continue;
    EXPECT_LT(shifts_[i].x * off, 0) << "at " << off;
    EXPECT_GT(std::abs(shifts_[i].x), 0.5) << "at " << off;
    EXPECT_LE(std::hypot(shifts_[i].x, shifts_[i].y), 4.001);
    EXPECT_LT(std::abs(off + shifts_[i].x), std::abs(off));
    (off < 0 ? left : right) += 1;
  }
  EXPECT_GT(left, 20);
  EXPECT_GT(right, 20);
}

TEST_F(PostAtTheEndOfAWall, patches_move_away_from_the_wall_alone) {
  float farthest = 0;
  for (const cv::Point2f& shift : shifts_) {
    EXPECT_GE(shift.x, 0);
    farthest = std::max(farthest, shift.x);
  }
  EXPECT_GT(farthest, 0.5);
}

TEST_F(PostBeforeAWall, points_off_depth_edges_stay) {
  const std::vector<std::uint8_t> on_edge = std::exchange(anchored_.on_edge, {});
  anchored_.on_edge.assign(on_edge.size(), 0);
  for (const cv::Point2f& shift : inward_shifts(anchored_, post_, followed_))
    EXPECT_EQ(shift, cv::Point2f());
}

TEST_F(PostBeforeAWall, what_is_followed_beside_a_point_is_another_place) {
  PointTracks tracks;
  const std::vector<Eigen::Vector3d> beside(followed_.size(), Eigen::Vector3d(0.05, 0, 0));
  add_points(tracks, followed_, {0, 3}, scan_, 0, beside);
  ASSERT_EQ(tracks.size(), 2U);
  const Eigen::Vector3d own = scan_.points[followed_[3].index].cast<double>();
  EXPECT_TRUE(tracks.point[1].isApprox(own + beside[3]));
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

TEST_F(PostBeforeAWall, moved_patches_follow_the_post_and_not_the_wall) {
  constexpr int kMoved_px = 3;
  const CameraModel camera = testing::wide_camera().model;
  const double half_px = camera.fx * 0.15 / kPostDepth;
  const ImagePyramid before(picture_of_post(camera, half_px, 0));
  const ImagePyramid after(picture_of_post(camera, half_px, kMoved_px));
  const auto num_lost = [&](const std::vector<cv::Point2f>& shifts) {
    std::vector<cv::Point2f> pixels;
    for (std::size_t i = 0; i < followed_.size(); ++i)
      pixels.emplace_back(followed_[i].u + shifts[i].x, followed_[i].v + shifts[i].y);
    const KltResult result = track_points(before, after, pixels);
    int count = 0;
    for (std::size_t i = 0; i < pixels.size(); ++i)
      count += result.tracked[i] == 0 ||
               cv::norm(result.points[i] - pixels[i] - cv::Point2f(kMoved_px, 0)) > 0.5;
    return count;
  };
  EXPECT_LT(num_lost(shifts_), 0.6 * num_lost(std::vector<cv::Point2f>(followed_.size())));
}

}  // namespace
}  // namespace lidar_upsampling
