// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <gtest/gtest.h>
#include <mrpt/io/lazy_load_path.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationPointCloud.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "lidar_upsampling/compat/mrpt.h"
#include "lidar_upsampling/compat/point_fields.h"
#include "lidar_upsampling/io/carriers.h"
#include "lidar_upsampling/io/packer.h"
#include "lidar_upsampling/io/unpacker.h"
#include "test_folder.h"

namespace lidar_upsampling {
namespace {

using mrpt::obs::CObservation3DRangeScan;
using mrpt::obs::CObservationPointCloud;

TEST(ForeignScans, other_observations_are_no_scans) {
  mrpt::obs::CObservationOdometry odometry;
  EXPECT_FALSE(is_lidar_scan(odometry));
  EXPECT_FALSE(scan_from_observation(odometry));
}

TEST(ForeignScans, invalid_points_of_foreign_scans_are_left_out) {
  CObservation3DRangeScan depth;
  depth.hasPoints3D = true;
  depth.resizePoints3DVectors(4);
  depth.points3D_x = {0.F, 1.F, std::numeric_limits<float>::quiet_NaN(), 1e30F};
  depth.points3D_y = {0.F, 2.F, 0.F, 0.F};
  depth.points3D_z = {0.F, 3.F, 0.F, 0.F};
  depth.points3D_idxs_x.assign(4, 0);
  depth.points3D_idxs_y.assign(4, 0);
  const LidarScan scan = scan_from_observation(depth).value();
  ASSERT_EQ(scan.size(), 1U);
  EXPECT_EQ(scan.points[0], Eigen::Vector3f(1, 2, 3));
  EXPECT_TRUE(scan.ring.empty());
}

TEST(ForeignScans, eight_bit_intensities_of_foreign_point_clouds_are_scaled) {
  const auto map = compat::make_points_map(2, {{51.F, 255.F}, {}, {}, {}});
  map->setPointFast(0, 1, 0, 0);
  map->setPointFast(1, 2, 0, 0);
  CObservationPointCloud cloud;
  cloud.pointcloud = map;
  const LidarScan scan = scan_from_observation(cloud).value();
  EXPECT_FLOAT_EQ(scan.intensity.at(0), 0.2F);
  EXPECT_FLOAT_EQ(scan.intensity.at(1), 1.F);
}

// A wall 4 m ahead, seen by a depth camera of 8 x 6 pixels.
CObservation3DRangeScan wall(bool range_is_depth) {
  CObservation3DRangeScan depth;
  depth.sensorLabel = "KINECT";
  depth.cameraParams.ncols = 8;
  depth.cameraParams.nrows = 6;
  depth.cameraParams.setIntrinsicParamsFromValues(10, 10, 3.5, 2.5);
  depth.hasRangeImage = true;
  depth.range_is_depth = range_is_depth;
  depth.rangeUnits = 0.001F;
  depth.rangeImage_setSize(6, 8);
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 8; ++column) {
      const double ray = std::hypot(1., (column - 3.5) / 10, (row - 2.5) / 10);
      depth.rangeImage(row, column) =
          static_cast<std::uint16_t>(std::lround(4000 * (range_is_depth ? 1. : ray)));
    }
  }
  depth.rangeImage(2, 5) = 0;  // no return
  return depth;
}

TEST(ForeignScans, a_depth_camera_is_a_lidar_too) {
  for (const bool range_is_depth : {true, false}) {
    CObservation3DRangeScan depth = wall(range_is_depth);
    const LidarScan scan = scan_from_observation(depth).value();
    ASSERT_EQ(scan.size(), 47U);
    EXPECT_EQ(scan.num_rings, 6);
    EXPECT_EQ(scan.num_columns, 8);
    for (std::size_t i = 0; i < scan.size(); ++i) {
      const int row = 5 - scan.ring[i];
      const Eigen::Vector3f expected(4.F, -0.4F * (static_cast<float>(scan.column[i]) - 3.5F),
                                     -0.4F * (static_cast<float>(row) - 2.5F));
      EXPECT_LT((scan.points[i] - expected).norm(), 2e-3F);
    }
  }
}

CObservation3DRangeScan two_points() {
  CObservation3DRangeScan depth;
  depth.hasPoints3D = true;
  depth.resizePoints3DVectors(2);
  depth.points3D_x = {1.F, 4.F};
  depth.points3D_y = {2.F, 5.F};
  depth.points3D_z = {3.F, 6.F};
  depth.points3D_idxs_x.assign(2, 0);
  depth.points3D_idxs_y.assign(2, 0);
  return depth;
}

/// A file, packed or not.
void pack_by_zstd(const std::string& path) {
  std::vector<std::uint8_t> bytes(1U << 16U);
  bytes.resize(Unpacker(path).unpack(bytes));
  const auto packer = make_packer({Compression::Format::zstd, 3});
  std::vector<std::uint8_t> packed = packer->pack(bytes);
  const std::vector<std::uint8_t>& end = packer->finish();
  packed.insert(packed.end(), end.begin(), end.end());
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(packed.data()),
             static_cast<std::streamsize>(packed.size()));
}

TEST(ForeignScans, external_points_are_loaded_and_unloaded) {
  const TestFolder folder;
  mrpt::io::setLazyLoadPathBase(folder.path().string());
  CObservation3DRangeScan depth = two_points();
  depth.points3D_convertToExternalStorage("points.bin", folder.path().string());
  ASSERT_TRUE(depth.points3D_x.empty());
  const LidarScan scan = scan_from_observation(depth).value();
  ASSERT_EQ(scan.size(), 2U);
  EXPECT_EQ(scan.points[1], Eigen::Vector3f(4, 5, 6));
  EXPECT_TRUE(depth.points3D_x.empty());
}

TEST(ForeignScans, external_point_clouds_are_loaded_and_unloaded) {
  const TestFolder folder;
  mrpt::io::setLazyLoadPathBase(folder.path().string());
  const std::vector<float> points = {1, 2, 3, 0.5F, 4, 5, 6, 0.25F};
  std::ofstream(folder / "points.bin", std::ios::binary)
      .write(reinterpret_cast<const char*>(points.data()), 32);
  CObservationPointCloud cloud;
  cloud.setAsExternalStorage("points.bin",
                             CObservationPointCloud::ExternalStorageFormat::KittiBinFile);
  const LidarScan scan = scan_from_observation(cloud).value();
  ASSERT_EQ(scan.size(), 2U);
  EXPECT_EQ(scan.points[1], Eigen::Vector3f(4, 5, 6));
  EXPECT_FLOAT_EQ(scan.intensity[1], 0.25F);
  EXPECT_FALSE(cloud.pointcloud);
}

TEST(ForeignScans, a_missing_external_file_is_named) {
  const TestFolder folder;
  mrpt::io::setLazyLoadPathBase(folder.path().string());
  CObservationPointCloud cloud;
  cloud.sensorLabel = "LIDAR";
  cloud.setAsExternalStorage("none.bin",
                             CObservationPointCloud::ExternalStorageFormat::KittiBinFile);
  try {
    static_cast<void>(scan_from_observation(cloud));
    FAIL();
  } catch (const std::runtime_error& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("none.bin"), std::string::npos) << text;
    EXPECT_NE(text.find("LIDAR"), std::string::npos) << text;
  }
}

// MRPT from 2.15.7 on packs external files as it packs logs.
TEST(ForeignScans, external_points_packed_by_zstd_are_read_or_told_to_be) {
  const TestFolder folder;
  mrpt::io::setLazyLoadPathBase(folder.path().string());
  CObservation3DRangeScan depth = two_points();
  depth.points3D_convertToExternalStorage("points.bin", folder.path().string());
  pack_by_zstd(folder / "points.bin");
  try {
    EXPECT_EQ(scan_from_observation(depth).value().points.back(), Eigen::Vector3f(4, 5, 6));
    EXPECT_TRUE(compat::kReadsZstd);
  } catch (const std::runtime_error& error) {
    EXPECT_FALSE(compat::kReadsZstd);
    const std::string text = error.what();
    EXPECT_NE(text.find("points.bin is packed by zstd"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace lidar_upsampling
