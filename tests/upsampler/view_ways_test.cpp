// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/view_ways.h"

#include <gtest/gtest.h>

#include <memory>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

namespace lidar_upsampling {
namespace {

constexpr int kWidth = 320, kHeight = 200, kPeriod_px = 16;
constexpr double kFocal_px = 300, kDepth_m = 10;

/// A fence, alike every 16 columns, that lies so far to the right.
std::shared_ptr<const Picture> fence(double right_px) {
  constexpr int kRepeats = kWidth / kPeriod_px + 4;
  cv::Mat panel(kHeight, kPeriod_px, CV_8UC1), wide, gray;
  cv::RNG(1).fill(panel, cv::RNG::UNIFORM, 0, 256);
  cv::repeat(panel, 1, kRepeats, wide);
  cv::GaussianBlur(wide, wide, {}, 2);
  cv::normalize(wide, wide, 0, 255, cv::NORM_MINMAX);
  const cv::Matx23d shift(1, 0, right_px - 2 * kPeriod_px, 0, 1, 0);
  cv::warpAffine(wide, gray, shift, cv::Size(kWidth, kHeight), cv::INTER_LINEAR);
  CameraImage image;
  image.gray = gray;
  ImagePyramid pyramid(gray);
  return std::make_shared<const Picture>(Picture{std::move(image), Stamp(), std::move(pyramid)});
}

/// The fence, followed by points from where it was shown.
CameraView view_of_fence() {
  Camera camera;
  camera.model = {kWidth, kHeight, kFocal_px, kFocal_px, kWidth / 2., kHeight / 2.};
  CameraView view(camera);
  view.anchor = fence(0);
  LidarScan scan;
  std::vector<ProjectedPoint> projected;
  std::vector<int> chosen;
  for (float u = 100; u < 220; u += 24) {
    for (float v = 50; v < 150; v += 20) {
      chosen.push_back(static_cast<int>(scan.points.size()));
      projected.push_back({chosen.back(), u, v, kDepth_m});
      scan.points.emplace_back(kDepth_m * (u - kWidth / 2.) / kFocal_px,
                               kDepth_m * (v - kHeight / 2.) / kFocal_px, kDepth_m);
    }
  }
  add_points(view.points, projected, chosen, scan, 0);
  return view;
}

/// Columns by which the found points lie off where they were on the first picture, on average; NaN
/// where none is found.
double off_px(const PointTracks& points) {
  double sum = 0, found = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points.found[i] == 0) continue;
    sum += points.last_px[i].x - points.anchor_px[i].x;
    ++found;
  }
  return sum / found;
}

TEST(ViewWays, look_for_points_where_they_are_expected_not_where_something_was_taken_for_them) {
  CameraView view = view_of_fence();
  const auto follow_to = [&](double right_px) {
    follow_ways(view, *fence(right_px), Pose::Identity(), {{{Pose::Identity()}, {}}}, {});
  };
  follow_to(6.5);
  ASSERT_NEAR(off_px(view.points), 6.5, 0.5);
  follow_to(-1.7);
  EXPECT_NEAR(off_px(view.points), -1.7, 0.5);
}

}  // namespace
}  // namespace lidar_upsampling
