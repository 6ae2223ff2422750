// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/covered_points.h"

#include <gtest/gtest.h>

#include "lidar_upsampling/vision/projection.h"
#include "street_scan.h"

namespace lidar_upsampling {
namespace {

/// A sign 30 m ahead whose left half a truck, owner 1, has driven in front of; the sign is owner 0.
class CoveredSign : public ::testing::Test {
 protected:
  CoveredSign() {
    for (int i = -10; i < 10; ++i) {
      const Eigen::Vector3d point(0.1 * i, 0, 30);
      pairs_.push_back({point, *project(camera_, point)});
    }
    for (double x = -3; x < -0.1; x += 0.05) map_.add(*project(camera_, {x / 3, 0, 10}), 10, 1);
  }

  [[nodiscard]] std::size_t num_kept(const std::vector<std::uint8_t>& companions) const {
    return without_covered(pairs_, map_, camera_, Pose::Identity(), companions).size();
  }

  CameraModel camera_ = testing::wide_camera().model;
  CoverMap map_{1242, 375, 8, 8};
  std::vector<Correspondence> pairs_;
};

TEST_F(CoveredSign, pairs_behind_a_nearer_mover_are_dropped_and_those_beside_it_kept) {
  const std::size_t kept = num_kept({1, 0});
  EXPECT_GE(kept, 6U);
  EXPECT_LE(kept, 10U);
  for (const auto& pair : without_covered(pairs_, map_, camera_, Pose::Identity(), {1, 0}))
    EXPECT_GT(pair.point_in_source.x(), -0.1);
}

TEST_F(CoveredSign, what_moves_along_covers_nothing) { EXPECT_EQ(num_kept({1, 1}), 20U); }

TEST_F(CoveredSign, a_patch_that_was_dragged_into_the_mover_is_dropped_too) {
  pairs_.back().pixel = pairs_.front().pixel;
  const auto kept = without_covered(pairs_, map_, camera_, Pose::Identity(), {1, 0});
  EXPECT_NE(kept.back().point_in_source, pairs_.back().point_in_source);
}

TEST_F(CoveredSign, points_outside_the_picture_cover_nothing_and_do_no_harm) {
  map_.add({-50, 10}, 1, 1);
  map_.add({5000, 10}, 1, 1);
  EXPECT_FALSE(map_.covers({5000, 10}, 30, {1, 0}, 1.5));
}

TEST_F(CoveredSign, a_mover_behind_it_covers_nothing) {
  CoverMap behind(1242, 375, 8, 8);
  for (const auto& pair : pairs_) behind.add(pair.pixel, 40, 1);
  EXPECT_EQ(without_covered(pairs_, behind, camera_, Pose::Identity(), {1, 0}).size(), 20U);
}

}  // namespace
}  // namespace lidar_upsampling
