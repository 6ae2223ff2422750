// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/io/scan_classes.h"

#include <gtest/gtest.h>

#include <limits>
#include <opencv2/core/mat.hpp>

#include "depth_scene.h"
#include "lidar_upsampling/io/carriers.h"

namespace lidar_upsampling {
namespace {

using mrpt::obs::CObservation;

/// Through the bytes of a log.
CObservation3DRangeScan::Ptr stored_depth(const CObservation& observation) {
  std::vector<std::uint8_t> bytes;
  mrpt::serialization::ObjectToOctetVector(&observation, bytes);
  mrpt::serialization::CSerializable::Ptr object;
  mrpt::serialization::OctetVectorToObject(bytes, object);
  return std::dynamic_pointer_cast<CObservation3DRangeScan>(object);
}

LidarScan scan_of(CObservation3DRangeScan& camera) { return scan_from_observation(camera).value(); }

CObservation3DRangeScan::Ptr virtual_image(const LidarScan& scan,
                                           const CObservation3DRangeScan& like) {
  return stored_depth(*observation_from_scan(scan, Carrier::same, &like));
}

int num_returns(const CObservation3DRangeScan& image) {
  int count = 0;
  for (int row = 0; row < kHeight; ++row) {
    for (int column = 0; column < kWidth; ++column) count += image.rangeImage(row, column) != 0;
  }
  return count;
}

double depth_at(const CObservation3DRangeScan& image, int row, int column) {
  return static_cast<double>(image.rangeImage(row, column)) * static_cast<double>(image.rangeUnits);
}

TEST(DepthImage, of_an_unmoved_scan_is_the_real_one_pixel_by_pixel) {
  for (const bool range_is_depth : {true, false}) {
    for (const double distortion : {0., -0.15}) {
      CObservation3DRangeScan real = depth_camera();
      real.range_is_depth = range_is_depth;
      if (distortion != 0) {
        real.cameraParams.distortion = mrpt::img::DistortionModel::plumb_bob;
        real.cameraParams.dist[0] = distortion;
      }
      look_at(both(kSlantedWall, kBoard), real);
      real.rangeImage(20, 11) = 0;
      const auto image = virtual_image(scan_of(real), real);
      for (int row = 0; row < kHeight; ++row) {
        for (int column = 0; column < kWidth; ++column) {
          EXPECT_NEAR(image->rangeImage(row, column), real.rangeImage(row, column), 1)
              << row << ' ' << column << ' ' << range_is_depth << ' ' << distortion;
        }
      }
    }
  }
}

TEST(DepthImage, has_the_cameras_calibration_unit_and_place) {
  CObservation3DRangeScan real = looking_at(kWall);
  real.range_is_depth = false;
  LidarScan scan = scan_of(real);
  scan.label = "KINECT_VIRTUAL";
  scan.stamp = shifted(scan.stamp, 0.033);
  const auto image = virtual_image(scan, real);
  EXPECT_EQ(image->sensorLabel, "KINECT_VIRTUAL");
  EXPECT_EQ(image->timestamp, scan.stamp);
  EXPECT_TRUE(from_mrpt(image->sensorPose).isApprox(from_mrpt(real.sensorPose), 1e-12));
  EXPECT_EQ(image->cameraParams.intrinsicParams, real.cameraParams.intrinsicParams);
  EXPECT_EQ(image->cameraParams.ncols, kWidth);
  EXPECT_EQ(image->cameraParams.nrows, kHeight);
  EXPECT_EQ(image->rangeImage.rows(), kHeight);
  EXPECT_EQ(image->rangeImage.cols(), kWidth);
  EXPECT_EQ(image->rangeUnits, real.rangeUnits);
  EXPECT_EQ(image->maxRange, real.maxRange);
  EXPECT_EQ(image->stdError, real.stdError);
  EXPECT_FALSE(image->range_is_depth);
  EXPECT_FALSE(image->hasPoints3D);
  EXPECT_FALSE(image->hasIntensityImage);
}

TEST(DepthImage, of_a_moved_wall_has_its_depth_at_every_pixel_and_no_cracks) {
  CObservation3DRangeScan real = looking_at(kSlantedWall);
  LidarScan scan = scan_of(real);
  // Nearer by a third, and turned: neighbours are now up to two pixels apart.
  Pose T = Pose::Identity();
  T.translate(Eigen::Vector3d(-1.4, 0.05, 0.02));
  T.rotate(Eigen::AngleAxisd(0.02, Eigen::Vector3d(0.3, 0.2, 1).normalized()));
  for (Eigen::Vector3f& point : scan.points) point = (T * point.cast<double>()).cast<float>();
  const Eigen::Vector3d normal = T.linear() * kSlantedWall[0].normal;
  const std::vector<SceneWall> moved{
      {normal, kSlantedWall[0].distance + normal.dot(T.translation())}};
  const auto image = virtual_image(scan, real);
  for (int row = 0; row < kHeight; ++row) {
    for (int column = 0; column < kWidth; ++column) {
      const double truth = depth_of(moved, ray_of(*image, row, column)).value();
      ASSERT_NEAR(depth_at(*image, row, column), truth, 0.002) << row << ' ' << column;
    }
  }
}

TEST(DepthImage, the_nearest_surface_hides_the_others_and_leaves_no_return_where_it_was) {
  for (const double to_left : {1., -1.}) {
    CObservation3DRangeScan real = looking_at(both(kBoard, kWall));
    LidarScan scan = scan_of(real);
    for (Eigen::Vector3f& point : scan.points) {
      // The board, by more than half its width.
      if (point.x() < 3) point.y() += static_cast<float>(0.31 * to_left);
    }
    const auto image = virtual_image(scan, real);
    int on_board = 0, uncovered = 0;
    for (int row = 0; row < kHeight; ++row) {
      for (int column = 0; column < kWidth; ++column) {
        const double y_on_board = 2 * ray_of(*image, row, column).y() * to_left;
        const double depth = depth_at(*image, row, column);
        if (y_on_board > 0.04 && y_on_board < 0.58) {
          ASSERT_NEAR(depth, 2, 0.001) << row << ' ' << column;
          ++on_board;
        } else if (y_on_board < -0.04 && y_on_board > -0.26) {
          ASSERT_EQ(depth, 0) << row << ' ' << column;
          ++uncovered;
        } else if (y_on_board < -0.34 || y_on_board > 0.66) {
          ASSERT_NEAR(depth, 5, 0.001) << row << ' ' << column;
        }
      }
    }
    EXPECT_GT(on_board, 1000);
    EXPECT_GT(uncovered, 400);
  }
}

TEST(DepthImage, points_read_from_it_lie_where_the_moved_ones_do) {
  CObservation3DRangeScan real = looking_at(both(kBoard, kSlantedWall));
  LidarScan scan = scan_of(real);
  for (Eigen::Vector3f& point : scan.points) point += Eigen::Vector3f(-0.2F, 0.13F, -0.04F);
  auto image = virtual_image(scan, real);
  const LidarScan read = scan_of(*image);
  EXPECT_GT(read.size(), scan.size() * 9 / 10);
  EXPECT_EQ(read.num_rings, kHeight);
  EXPECT_EQ(read.num_columns, kWidth);
  for (const Eigen::Vector3f& point : read.points) {
    float nearest = std::numeric_limits<float>::max();
    for (const Eigen::Vector3f& moved : scan.points) {
      nearest = std::min(nearest, (moved - point).norm());
    }
    EXPECT_LT(nearest, 0.8F / 70 * point.x());  // half a pixel across, and along the slope
  }
}

TEST(DepthImage, an_intensity_picture_in_the_same_place_comes_along) {
  CObservation3DRangeScan real = looking_at(kWall);
  cv::Mat gray(kHeight, kWidth, CV_8UC1);
  for (int column = 0; column < kWidth; ++column) gray.col(column) = 2 * column + 20;
  real.hasIntensityImage = true;
  real.intensityImage = mrpt::img::CImage(gray, mrpt::img::DEEP_COPY);
  LidarScan scan = scan_of(real);
  const float shift_m = 5.F / 70;  // a pixel to the left
  for (Eigen::Vector3f& point : scan.points) point.y() += shift_m;
  const auto image = virtual_image(scan, real);
  ASSERT_TRUE(image->hasIntensityImage);
  ASSERT_EQ(image->intensityImage.getWidth(), kWidth);
  for (int column = 0; column + 2 < kWidth; ++column) {
    EXPECT_NEAR(*image->intensityImage.ptr<std::uint8_t>(column, 30), 2 * column + 22, 1);
  }
  real.relativePoseIntensityWRTDepth.x(0.05);
  EXPECT_FALSE(virtual_image(scan, real)->hasIntensityImage);
}

TEST(DepthImage, has_points_too_where_the_real_ones_have) {
  CObservation3DRangeScan real = looking_at(kWall);
  real.unprojectInto(real);
  ASSERT_TRUE(real.hasPoints3D);
  const auto image = virtual_image(scan_of(real), real);
  ASSERT_TRUE(image->hasPoints3D);
  ASSERT_EQ(image->points3D_x.size(), real.points3D_x.size());
  for (std::size_t i = 0; i < image->points3D_x.size(); ++i) {
    EXPECT_NEAR(image->points3D_x[i], 5, 0.001);
    EXPECT_NEAR(image->points3D_y[i], real.points3D_y[i], 0.001);
  }
}

TEST(DepthImage, ranges_that_its_unit_cannot_express_are_no_returns) {
  CObservation3DRangeScan real = looking_at(kWall);
  LidarScan scan = scan_of(real);
  EXPECT_EQ(num_returns(*virtual_image(scan, real)), kWidth * kHeight);
  for (Eigen::Vector3f& point : scan.points) point *= 7;  // 35 m in half millimetres
  EXPECT_EQ(num_returns(*virtual_image(scan, real)), 0);
}

TEST(DepthImage, a_scan_without_rings_is_drawn_point_by_point) {
  CObservation3DRangeScan real = looking_at(both(kBoard, kWall));
  LidarScan scan = scan_of(real);
  scan.ring.clear();
  scan.column.clear();
  scan.num_rings = scan.num_columns = 0;
  const auto image = virtual_image(scan, real);
  for (int row = 0; row < kHeight; ++row) {
    for (int column = 0; column < kWidth; ++column) {
      EXPECT_NEAR(image->rangeImage(row, column), real.rangeImage(row, column), 1);
    }
  }
}

TEST(DepthImage, has_points_for_maps_unless_it_is_to_be_the_same_as_the_real_one) {
  CObservation3DRangeScan real = looking_at(kWall);
  const LidarScan scan = scan_of(real);
  const auto made = [&](Carrier carrier) {
    const auto observation = observation_from_scan(scan, carrier, &real);
    const auto* const image = dynamic_cast<const CObservation3DRangeScan*>(observation.get());
    return std::make_pair(image != nullptr && image->hasRangeImage,
                          image != nullptr && image->hasPoints3D);
  };
  EXPECT_EQ(made(Carrier::same), std::make_pair(true, false));
  EXPECT_EQ(made(Carrier::automatic), std::make_pair(true, true));
  EXPECT_EQ(made(Carrier::range_scan_3d), std::make_pair(false, true));
  EXPECT_EQ(made(Carrier::point_cloud), std::make_pair(false, false));
}

TEST(DepthImage, needs_ranges_and_intrinsics) {
  CObservation3DRangeScan real = looking_at(kWall);
  const LidarScan scan = scan_of(real);
  EXPECT_TRUE(is_depth_image(real));
  real.cameraParams.setIntrinsicParamsFromValues(0, 0, 0, 0);
  EXPECT_FALSE(is_depth_image(real));
  EXPECT_FALSE(is_depth_image(*std::dynamic_pointer_cast<CObservation3DRangeScan>(
      observation_from_scan(scan, Carrier::range_scan_3d))));
}

}  // namespace
}  // namespace lidar_upsampling
