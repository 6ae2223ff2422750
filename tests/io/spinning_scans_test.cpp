// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/io/scan_classes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "lidar_upsampling/io/carriers.h"
#include "velodyne_packets.h"

namespace lidar_upsampling {
namespace {

using mrpt::obs::CObservationRotatingScan;
using mrpt::obs::CObservationVelodyneScan;

constexpr double kRadius = 8;

// A VLP-16 in the middle of a sphere.
CObservationVelodyneScan sphere() {
  return velodyne_packets(Stamp(mrpt::Clock::duration(132000000000000000LL)),
                          [](double) { return kRadius; });
}

double elevation_deg(const Eigen::Vector3f& point) {
  return std::atan2(static_cast<double>(point.z()),
                    std::hypot(static_cast<double>(point.x()), static_cast<double>(point.y()))) *
         180 / M_PI;
}

TEST(VelodyneScan, packets_become_points_with_ring_intensity_and_time) {
  CObservationVelodyneScan observation = sphere();
  const LidarScan scan = scan_from_observation(observation).value();
  ASSERT_GT(scan.size(), 7000U);
  EXPECT_TRUE(observation.point_cloud.x.empty());
  EXPECT_EQ(scan.num_rings, 16);
  ASSERT_EQ(scan.ring.size(), scan.size());
  ASSERT_EQ(scan.intensity.size(), scan.size());
  ASSERT_EQ(scan.time_s.size(), scan.size());
  float latest = 0;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    EXPECT_NEAR(scan.points[i].norm(), kRadius, 0.1);
    EXPECT_NEAR(elevation_deg(scan.points[i]), -15 + 2 * scan.ring[i], 0.3);
    EXPECT_FLOAT_EQ(scan.intensity[i], 0.2F);
    EXPECT_GE(scan.time_s[i], -1e-6F);
    latest = std::max(latest, scan.time_s[i]);
  }
  EXPECT_NEAR(latest, 0.1, 0.005);
}

TEST(VelodyneScan, packets_without_calibration_are_read_by_their_model) {
  CObservationVelodyneScan observation = sphere();
  const LidarScan with = scan_from_observation(observation).value();
  observation.calibration.clear();
  const LidarScan without = scan_from_observation(observation).value();
  EXPECT_TRUE(observation.calibration.empty());
  ASSERT_EQ(without.size(), with.size());
  EXPECT_EQ(without.points, with.points);
}

TEST(VelodyneScan, an_embedded_point_cloud_is_preferred) {
  CObservationVelodyneScan observation = sphere();
  CObservationVelodyneScan::TGeneratePointCloudParameters parameters;
  parameters.generatePerPointTimestamp = true;
  observation.generatePointCloud(parameters);
  const LidarScan embedded = scan_from_observation(observation).value();
  observation.point_cloud.clear();
  const LidarScan packets = scan_from_observation(observation).value();
  EXPECT_EQ(embedded.points, packets.points);
  EXPECT_EQ(embedded.ring, packets.ring);
  EXPECT_EQ(embedded.time_s, packets.time_s);
}

TEST(VelodyneScan, whose_points_lack_a_coordinate_is_none) {
  CObservationVelodyneScan whole = sphere();
  whole.generatePointCloud();
  for (auto* const coordinate : {&whole.point_cloud.y, &whole.point_cloud.z}) {
    const auto before = *coordinate;
    coordinate->resize(before.size() / 2);
    EXPECT_THROW((void)scan_from_observation(whole), std::runtime_error);
    *coordinate = before;
  }
}

TEST(RotatingScan, points_that_are_not_finite_are_left_out) {
  CObservationVelodyneScan packets = sphere();
  CObservationRotatingScan whole;
  whole.fromVelodyne(packets);
  ASSERT_GT(scan_from_observation(whole)->size(), 1000U);
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  CObservationRotatingScan resolution = whole, span = whole, start = whole;
  resolution.rangeResolution = kNone;
  span.azimuthSpan = kNone;
  start.startAzimuth = kNone;
  for (const auto& observation : {resolution, span, start})
    EXPECT_TRUE(scan_from_observation(observation)->points.empty());
}

TEST(RotatingScan, made_by_mrpt_shows_what_the_packets_show) {
  CObservationVelodyneScan packets = sphere();
  CObservationRotatingScan observation;
  observation.fromVelodyne(packets);
  const LidarScan rotating = scan_from_observation(observation).value();
  const LidarScan expected = scan_from_observation(packets).value();
  EXPECT_EQ(rotating.num_rings, 16);
  ASSERT_GT(rotating.size(), 7000U);
  for (std::size_t i = 0; i < rotating.size(); ++i) {
    EXPECT_NEAR(rotating.points[i].norm(), kRadius, 0.1);
    EXPECT_NEAR(elevation_deg(rotating.points[i]), -15 + 2 * rotating.ring[i], 0.3);
    EXPECT_FLOAT_EQ(rotating.intensity[i], 0.2F);
    EXPECT_LT(rotating.column[i], rotating.num_columns);
  }
}

TEST(RotatingScan, azimuths_agree_with_those_of_the_packets) {
  CObservationVelodyneScan packets = sphere();
  // A wall of another distance in the first eighth of the turn.
  for (std::size_t packet = 0; packet < kNumPackets / 8; ++packet) {
    auto* const bytes = reinterpret_cast<std::uint8_t*>(&packets.scan_packets[packet]);
    for (int block = 0; block < 12; ++block) {
      for (int beam = 0; beam < 32; ++beam) put_number(bytes + block * 100 + 4 + 3 * beam, 2000, 2);
    }
  }
  CObservationRotatingScan observation;
  observation.fromVelodyne(packets);
  const auto near_centroid = [](const LidarScan& scan) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    int count = 0;
    for (const Eigen::Vector3f& point : scan.points) {
      if (point.norm() > 6) continue;
      sum += point.cast<double>();
      ++count;
    }
    return Eigen::Vector3d(sum / count);
  };
  const Eigen::Vector3d expected = near_centroid(scan_from_observation(packets).value());
  EXPECT_LT((near_centroid(scan_from_observation(observation).value()) - expected).norm(), 0.1);
}

TEST(RotatingScan, an_unknown_model_is_an_error) {
  CObservationRotatingScan observation;
  observation.sensorLabel = "SPIN";
  observation.lidarModel = "XYZ-7";
  observation.rangeImage.setZero(4, 10);
  try {
    static_cast<void>(scan_from_observation(observation));
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("XYZ-7"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace lidar_upsampling
