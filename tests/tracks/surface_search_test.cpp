// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/tracks/surface_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "lidar_upsampling/vision/projection.h"

namespace lidar_upsampling {
namespace {

/// A board of 2 x 1.2 m that stands across the view, 10 m ahead, before a wall.
class Board : public ::testing::Test {
 protected:
  Board() {
    camera_.width = 480;
    camera_.height = 200;
    camera_.fx = camera_.fy = 300;
    camera_.cx = 240;
    camera_.cy = 100;
    T_camera_lidar_.linear() << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  }

  [[nodiscard]] static Pose moved(double x, double y, double turn) {
    const Eigen::Vector3d middle(10, 0, 0);
    return Eigen::Translation3d(middle + Eigen::Vector3d(x, y, 0)) *
           Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()) * Eigen::Translation3d(-middle);
  }

  /// Both are painted all over with waves of half a metre and more.
  [[nodiscard]] cv::Mat picture(const Pose& T_mov) const {
    cv::Mat gray(camera_.height, camera_.width, CV_8UC1);
    const Pose T = T_mov.inverse();
    for (int v = 0; v < gray.rows; ++v) {
      for (int u = 0; u < gray.cols; ++u) {
        const Eigen::Vector3d ray(1, (camera_.cx - u) / camera_.fx, (camera_.cy - v) / camera_.fy);
        const Eigen::Vector3d from = T.translation(), to = T.linear() * ray;
        const Eigen::Vector3d at = from + (10 - from.x()) / to.x() * to;
        const bool is_board = std::abs(at.y()) < 1 && std::abs(at.z()) < 0.6;
        const Eigen::Vector3d shown = is_board ? at : Eigen::Vector3d(30 * ray);
        gray.at<std::uint8_t>(v, u) = cv::saturate_cast<std::uint8_t>(paint(shown));
      }
    }
    return gray;
  }

  [[nodiscard]] std::optional<Pose> search(const Pose& T_mov, double sigma_m) const {
    const ImagePyramid from(picture(Pose::Identity())), to(picture(T_mov));
    LostSurface lost{from, to, camera_, T_camera_lidar_, {}, {}};
    for (double y = -0.9; y <= 0.9; y += 0.3) {
      for (double z = -0.5; z <= 0.5; z += 0.25) {
        lost.points.emplace_back(10, y, z);
        lost.from_px.push_back(pixel_of(Pose::Identity(), lost.points.back()));
      }
    }
    PlanarStep expected;
    expected.covariance.diagonal() << sigma_m * sigma_m, sigma_m * sigma_m, 0.01;
    return search_surface(lost, expected, {});
  }

  [[nodiscard]] cv::Point2f pixel_of(const Pose& T_mov, const Eigen::Vector3d& point) const {
    const auto pixel = project(camera_, T_camera_lidar_ * T_mov * point);
    return {static_cast<float>(pixel->x()), static_cast<float>(pixel->y())};
  }

  /// Of a corner, that the search puts it from where it is.
  [[nodiscard]] double error_px(const Pose& found, const Pose& truth) const {
    const Eigen::Vector3d corner(10, 0.9, 0.5);
    const cv::Point2f astray = pixel_of(found, corner) - pixel_of(truth, corner);
    return std::hypot(astray.x, astray.y);
  }

 private:
  static double paint(const Eigen::Vector3d& at) {
    double sum = 0;
    for (int i = 0; i < 12; ++i) {
      const double angle = 2.4 * i, length = 0.5 + 0.12 * i;
      sum += std::sin(2 * M_PI / length * (std::cos(angle) * at.y() + std::sin(angle) * at.z()) +
                      i * i);
    }
    return 128 + 20 * sum;
  }

  CameraModel camera_;
  Pose T_camera_lidar_ = Pose::Identity();
};

TEST_F(Board, that_has_gone_aside_by_its_width_and_come_nearer_is_found_as_near_as_patches_align) {
  const Pose truth = moved(-1.2, 1.9, 0.1);
  const auto found = search(truth, 2);
  ASSERT_TRUE(found);
  EXPECT_LT(error_px(*found, truth), 2);
}

TEST_F(Board, that_stands_is_found_where_it_stands) {
  const auto found = search(Pose::Identity(), 2);
  ASSERT_TRUE(found);
  EXPECT_LT(error_px(*found, Pose::Identity()), 1);
}

TEST_F(Board, whose_place_is_known_to_some_pixels_is_not_searched_for) {
  EXPECT_FALSE(search(moved(0, 0.1, 0), 0.05));
}

TEST_F(Board, that_may_be_anywhere_is_looked_for_at_no_more_places_than_there_is_time_for) {
  const auto found = search(moved(0, 0.8, 0), 1e6);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->matrix().allFinite());
}

TEST_F(Board, that_went_farther_than_expected_is_found_nowhere) {
  EXPECT_FALSE(search(moved(0, 3, 0), 0.8));
}

}  // namespace
}  // namespace lidar_upsampling
