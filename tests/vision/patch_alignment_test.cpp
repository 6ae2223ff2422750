// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/vision/patch_alignment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "lidar_upsampling/vision/observation.h"

namespace lidar_upsampling {
namespace {

const cv::Point2f kPoint(50, 50);

cv::Mat noise(int seed) {
  cv::Mat picture(100, 100, CV_8UC1);
  cv::theRNG().state = static_cast<std::uint64_t>(seed);
  cv::randu(picture, 0, 256);
  cv::GaussianBlur(picture, picture, cv::Size(), 1.5);
  picture.convertTo(picture, CV_32F);
  return picture;
}

/// Upright stripes, nothing changes from row to row.
cv::Mat stripes() {
  cv::Mat picture(100, 100, CV_32FC1);
  for (int u = 0; u < picture.cols; ++u) picture.col(u) = cv::Scalar(128 + 100 * std::sin(0.7 * u));
  return picture;
}

TEST(PatchAlignment, knows_along_which_way_a_patch_may_slide) {
  const cv::Mat picture = stripes(), textured = noise(3);
  const auto along = align_patch(picture, picture, kPoint, kPoint);
  const auto fixed = align_patch(textured, textured, kPoint, kPoint);
  ASSERT_TRUE(fixed);
  EXPECT_LT(fixed->covariance.trace(), 0.01F);
  // Upright stripes tell nothing of up and down.
  if (along) {
    EXPECT_LT(along->covariance(0, 0), 0.01F);
    EXPECT_GT(along->covariance(1, 1), 100 * along->covariance(0, 0));
  }
}

TEST(PatchAlignment, compares_what_is_its_own_alone) {
  const cv::Mat before = noise(3);
  cv::Mat after = noise(4);  // to the right something else has come
  before(cv::Rect(0, 0, 52, 100)).copyTo(after(cv::Rect(0, 0, 52, 100)));
  SurfaceMap surfaces{cv::Mat(before.size(), CV_16S, cv::Scalar(7))};
  surfaces.label(cv::Rect(0, 0, 50, 100)).setTo(2);
  const auto own = own_pixels(surfaces, 2, kPoint);
  ASSERT_FALSE(own.empty());
  const auto masked = align_patch(before, after, kPoint, kPoint + cv::Point2f(0.4F, 0), own);
  ASSERT_TRUE(masked);
  EXPECT_LT(cv::norm(masked->point - kPoint), 0.05);
  EXPECT_LT(masked->residual, 2);
  const auto all = align_patch(before, after, kPoint, kPoint + cv::Point2f(0.4F, 0));
  EXPECT_TRUE(!all || all->residual > 3 * masked->residual);
}

TEST(PatchAlignment, loses_a_patch_that_shows_hardly_anything_of_its_own) {
  const cv::Mat picture = noise(3);
  SurfaceMap surfaces{cv::Mat(picture.size(), CV_16S, cv::Scalar(7))};
  surfaces.label(cv::Rect(0, 0, 44, 100)).setTo(2);
  const auto own = own_pixels(surfaces, 2, kPoint);
  EXPECT_FALSE(align_patch(picture, picture, kPoint, kPoint, own));
}

TEST(PatchAlignment, takes_all_of_a_patch_where_no_surface_is_known) {
  EXPECT_TRUE(own_pixels({}, 2, kPoint).empty());
  const SurfaceMap unknown{cv::Mat(100, 100, CV_16S, cv::Scalar(SurfaceMap::kUnknown))};
  EXPECT_TRUE(own_pixels(unknown, 2, kPoint).empty());
  const SurfaceMap another{cv::Mat(100, 100, CV_16S, cv::Scalar(7))};
  EXPECT_TRUE(own_pixels(another, SurfaceMap::kUnknown, kPoint).empty());
}

TEST(WeighByTexture, counts_an_error_along_which_a_patch_slides_for_little) {
  std::vector<Correspondence> pairs(1);
  pairs[0].point_in_source = {0, 0, 10};
  pairs[0].covariance(1, 1) = 24 * 0.25;  // of 0.5 px per axis: five sigmas
  Observation observation;
  observation.point_in_source = pairs[0].point_in_source;
  observation.normalised = {0, 0};
  observation.pixel_by_normalised = 700 * Eigen::Matrix2d::Identity();
  observation.index = 0;
  std::vector<Observation> seen{observation};
  weigh_by_texture(seen, pairs, 0.5);
  EXPECT_NEAR(seen[0].pixel_by_normalised(0, 0), 700, 1e-9);
  EXPECT_NEAR(seen[0].pixel_by_normalised(1, 1), 140, 1e-9);
}

}  // namespace
}  // namespace lidar_upsampling
