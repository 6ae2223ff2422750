// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/io/carriers.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationRotatingScan.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

#include <cmath>
#include <limits>
#include <random>

#include "lidar_upsampling/compat/mrpt.h"
#include "lidar_upsampling/compat/point_fields.h"

namespace lidar_upsampling {
namespace {

using mrpt::obs::CObservation;
using mrpt::obs::CObservation3DRangeScan;
using mrpt::obs::CObservationPointCloud;
using mrpt::obs::CObservationRotatingScan;
using mrpt::obs::CObservationVelodyneScan;

constexpr float kHalfStep = 0.5F / 255.F;  // of an 8-bit intensity

// 16 rings of 90 points, one of them in the very origin.
LidarScan full_scan() {
  LidarScan scan;
  scan.stamp = Stamp(mrpt::Clock::duration(132000000000000007LL));
  scan.label = "LIDAR";
  scan.T_vehicle_lidar.translate(Eigen::Vector3d(0.3, -0.1, 1.7));
  scan.T_vehicle_lidar.rotate(Eigen::AngleAxisd(0.2, Eigen::Vector3d(1, 2, 3).normalized()));
  scan.num_rings = 18;  // the lowest and the highest beam saw nothing
  scan.num_columns = 100;
  std::mt19937 random(3);
  std::uniform_real_distribution<float> unit(0.F, 1.F);
  for (std::uint16_t ring = 1; ring < 17; ++ring) {
    for (std::uint16_t column = 0; column < 90; ++column) {
      const float range = 2.F + 60.F * unit(random);
      const float azimuth = 0.0628F * static_cast<float>(column);
      scan.points.emplace_back(range * std::cos(azimuth), range * std::sin(azimuth),
                               0.02F * range * static_cast<float>(ring - 8));
      scan.ring.push_back(ring);
      scan.column.push_back(column);
      scan.intensity.push_back(unit(random));
      scan.time_s.push_back(0.001F * static_cast<float>(column));
    }
  }
  scan.points[500].setZero();
  return scan;
}

// Through the bytes of a log, as only what is serialised counts.
CObservation::Ptr stored(const CObservation& observation) {
  std::vector<std::uint8_t> bytes;
  mrpt::serialization::ObjectToOctetVector(&observation, bytes);
  mrpt::serialization::CSerializable::Ptr object;
  mrpt::serialization::OctetVectorToObject(bytes, object);
  return std::dynamic_pointer_cast<CObservation>(object);
}

LidarScan round_trip(const LidarScan& scan, Carrier carrier, const CObservation* like = nullptr) {
  const auto observation = stored(*observation_from_scan(scan, carrier, like));
  return scan_from_observation(*observation).value();
}

void expect_same_points(const LidarScan& read, const LidarScan& scan) {
  ASSERT_EQ(read.size(), scan.size());
  EXPECT_EQ(read.stamp, scan.stamp);
  EXPECT_EQ(read.label, scan.label);
  EXPECT_TRUE(read.T_vehicle_lidar.isApprox(scan.T_vehicle_lidar, 1e-12));
  for (std::size_t i = 0; i < scan.size(); ++i) {
    EXPECT_LE((read.points[i] - scan.points[i]).norm(), scan.points[i].isZero() ? 2e-6F : 0.F);
    EXPECT_FALSE(read.points[i].isZero(0.F));
  }
}

void expect_same_intensity(const LidarScan& read, const LidarScan& scan, float tolerance) {
  ASSERT_EQ(read.intensity.size(), scan.intensity.size());
  for (std::size_t i = 0; i < scan.size(); ++i) {
    EXPECT_NEAR(read.intensity[i], scan.intensity[i], tolerance + 1e-6F);
  }
}

TEST(Carriers, names_are_those_of_the_settings) {
  EXPECT_EQ(carrier_from_string("auto"), Carrier::automatic);
  EXPECT_EQ(carrier_from_string("3drangescan"), Carrier::range_scan_3d);
  EXPECT_EQ(carrier_from_string("pointcloud"), Carrier::point_cloud);
  EXPECT_EQ(carrier_from_string("same"), Carrier::same);
  EXPECT_THROW(static_cast<void>(carrier_from_string("velodyne")), std::invalid_argument);
}

TEST(Carriers, a_3d_range_scan_keeps_points_intensity_ring_and_column) {
  const LidarScan scan = full_scan();
  const LidarScan read = round_trip(scan, Carrier::range_scan_3d);
  expect_same_points(read, scan);
  expect_same_intensity(read, scan, kHalfStep);
  EXPECT_EQ(read.ring, scan.ring);
  EXPECT_EQ(read.column, scan.column);
  EXPECT_EQ(read.num_rings, scan.num_rings);
  EXPECT_EQ(read.num_columns, scan.num_columns);
  EXPECT_TRUE(read.time_s.empty());
}

TEST(Carriers, a_3d_range_scan_keeps_ring_and_column_without_intensity) {
  LidarScan scan = full_scan();
  scan.intensity.clear();
  const LidarScan read = round_trip(scan, Carrier::range_scan_3d);
  expect_same_points(read, scan);
  EXPECT_TRUE(read.intensity.empty());
  EXPECT_EQ(read.ring, scan.ring);
  EXPECT_EQ(read.column, scan.column);
  EXPECT_EQ(read.num_rings, scan.num_rings);
  EXPECT_EQ(read.num_columns, scan.num_columns);
}

TEST(Carriers, a_3d_range_scan_keeps_ring_and_intensity_without_column) {
  LidarScan scan = full_scan();
  scan.column.clear();
  scan.num_columns = 0;
  const LidarScan read = round_trip(scan, Carrier::range_scan_3d);
  expect_same_points(read, scan);
  expect_same_intensity(read, scan, kHalfStep);
  EXPECT_EQ(read.ring, scan.ring);
  EXPECT_EQ(read.num_rings, scan.num_rings);
  EXPECT_TRUE(read.column.empty());
}

TEST(Carriers, a_3d_range_scan_keeps_intensity_without_ring) {
  LidarScan scan = full_scan();
  scan.ring.clear();
  scan.column.clear();
  scan.num_rings = scan.num_columns = 0;
  const LidarScan read = round_trip(scan, Carrier::range_scan_3d);
  expect_same_points(read, scan);
  expect_same_intensity(read, scan, kHalfStep);
  EXPECT_TRUE(read.ring.empty());
  EXPECT_TRUE(read.column.empty());
}

TEST(Carriers, bare_points_go_through_every_class) {
  LidarScan scan = full_scan();
  scan.ring.clear();
  scan.column.clear();
  scan.intensity.clear();
  scan.time_s.clear();
  for (const Carrier carrier : {Carrier::range_scan_3d, Carrier::point_cloud}) {
    const LidarScan read = round_trip(scan, carrier);
    expect_same_points(read, scan);
    EXPECT_TRUE(read.intensity.empty());
    EXPECT_TRUE(read.ring.empty());
  }
}

TEST(Carriers, an_empty_scan_goes_through_every_class) {
  LidarScan scan;
  scan.label = "LIDAR";
  for (const Carrier carrier : {Carrier::range_scan_3d, Carrier::point_cloud}) {
    EXPECT_EQ(round_trip(scan, carrier).size(), 0U);
  }
}

TEST(Carriers, a_point_cloud_keeps_points_and_exact_intensity) {
  const LidarScan scan = full_scan();
  const LidarScan read = round_trip(scan, Carrier::point_cloud);
  expect_same_points(read, scan);
  expect_same_intensity(read, scan, 0.F);
}

TEST(Carriers, a_point_cloud_keeps_rings_times_and_columns_where_this_mrpt_has_them) {
  const LidarScan scan = full_scan();
  const LidarScan read = round_trip(scan, Carrier::point_cloud);
  if (compat::maps_with_rings_since() == nullptr) {
    EXPECT_TRUE(read.ring.empty());
    return;
  }
  EXPECT_EQ(read.ring, scan.ring);
  EXPECT_EQ(read.time_s, scan.time_s);
  EXPECT_EQ(read.num_rings, 17) << "as far as they have points";
  ASSERT_EQ(read.column.size(), scan.size());
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (scan.points[i].isZero()) continue;
    EXPECT_EQ(read.column[i], scan.column[i]);
  }
}

TEST(Carriers, same_follows_the_real_scans) {
  const LidarScan scan = full_scan();
  const CObservationPointCloud cloud;
  const CObservation3DRangeScan depth;
  const auto is_cloud = [&](Carrier carrier, const CObservation* like) {
    return IS_CLASS(*observation_from_scan(scan, carrier, like), CObservationPointCloud);
  };
  EXPECT_TRUE(is_cloud(Carrier::same, &cloud));
  EXPECT_FALSE(is_cloud(Carrier::same, &depth));
  EXPECT_FALSE(is_cloud(Carrier::same, nullptr));
  const CObservationVelodyneScan velodyne;
  EXPECT_EQ(
      IS_CLASS(*observation_from_scan(scan, Carrier::same, &velodyne), CObservationVelodyneScan),
      !compat::kVelodyneLosesPoints);
}

TEST(Carriers, auto_keeps_ring_and_column_whatever_the_real_scans_are) {
  const LidarScan scan = full_scan();
  const CObservationPointCloud cloud;
  const CObservation3DRangeScan depth;
  const CObservationVelodyneScan velodyne;
  const auto rotating = CObservationRotatingScan::Create();
  for (const CObservation* const like : std::initializer_list<const CObservation*>{
           nullptr, &cloud, &depth, &velodyne, rotating.get()}) {
    const LidarScan read = round_trip(scan, Carrier::automatic, like);
    expect_same_points(read, scan);
    expect_same_intensity(read, scan, kHalfStep);
    EXPECT_EQ(read.ring, scan.ring);
    EXPECT_EQ(read.column, scan.column);
    EXPECT_EQ(read.num_rings, scan.num_rings);
    EXPECT_EQ(read.num_columns, scan.num_columns);
  }
}

TEST(Carriers, a_velodyne_scan_keeps_ring_and_time_too) {
  const LidarScan scan = full_scan();
  const LidarScan read = round_trip(scan, Carrier::velodyne);
  expect_same_points(read, scan);
  expect_same_intensity(read, scan, kHalfStep);
  EXPECT_EQ(read.ring, scan.ring);
  ASSERT_EQ(read.time_s.size(), scan.time_s.size());
  for (std::size_t i = 0; i < scan.size(); ++i) EXPECT_NEAR(read.time_s[i], scan.time_s[i], 1e-7F);
}

TEST(Carriers, a_point_that_is_not_finite_is_refused) {
  LidarScan scan = full_scan();
  scan.points[3].x() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(static_cast<void>(observation_from_scan(scan, Carrier::automatic)),
               std::invalid_argument);
}

}  // namespace
}  // namespace lidar_upsampling
