// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/io/scan_classes.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace lidar_upsampling {
namespace {

using mrpt::obs::CObservationRotatingScan;
using mrpt::obs::CObservationVelodyneScan;
using mrpt::obs::VelodyneCalibration;

// Lasers are numbered in the order of their wiring; rings count from the lowest beam.
std::vector<std::uint16_t> ring_of_laser(const VelodyneCalibration& calibration) {
  const auto& lasers = calibration.laser_corrections;
  std::vector<std::size_t> by_elevation(lasers.size());
  std::iota(by_elevation.begin(), by_elevation.end(), 0);
  std::stable_sort(by_elevation.begin(), by_elevation.end(), [&](std::size_t a, std::size_t b) {
    return lasers[a].sinVertCorrection < lasers[b].sinVertCorrection;
  });
  std::vector<std::uint16_t> ring(lasers.size());
  for (std::size_t i = 0; i < by_elevation.size(); ++i) {
    ring[by_elevation[i]] = static_cast<std::uint16_t>(i);
  }
  return ring;
}

const VelodyneCalibration& default_calibration(const std::string& model) {
  return VelodyneCalibration::LoadDefaultCalibration(model);
}

// With the points that its raw packets tell.
CObservationVelodyneScan unpacked(CObservationVelodyneScan observation) {
  if (observation.calibration.empty()) {
    const int model = observation.scan_packets.front().velodyne_model_ID;
    observation.calibration = default_calibration(model == 0x22 ? "VLP16" : "HDL32");
  }
  CObservationVelodyneScan::TGeneratePointCloudParameters options;
  options.generatePerPointTimestamp = true;
  observation.generatePointCloud(options);
  return observation;
}

void read_points(const CObservationVelodyneScan& observation, LidarScan& scan) {
  const auto& cloud = observation.point_cloud;
  const std::size_t n = cloud.x.size();
  if (cloud.y.size() != n || cloud.z.size() != n)
    throw std::runtime_error("it has " + std::to_string(n) + " x, " +
                             std::to_string(cloud.y.size()) + " y and " +
                             std::to_string(cloud.z.size()) + " z");
  const std::vector<std::uint16_t> ring = ring_of_laser(observation.calibration);
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector3f point(cloud.x[i], cloud.y[i], cloud.z[i]);
    if (!is_measured(point)) continue;
    scan.points.push_back(point);
    if (cloud.intensity.size() == n) {
      scan.intensity.push_back(static_cast<float>(cloud.intensity[i]) / 255.F);
    }
    if (cloud.timestamp.size() == n) {
      scan.time_s.push_back(static_cast<float>(seconds_between(scan.stamp, cloud.timestamp[i])));
    }
    if (cloud.laser_id.size() == n) {
      const auto laser = static_cast<std::uint16_t>(std::max<std::int16_t>(0, cloud.laser_id[i]));
      scan.ring.push_back(laser < ring.size() ? ring[laser] : laser);
    }
  }
  if (scan.ring.empty()) return;
  const int highest = *std::max_element(scan.ring.begin(), scan.ring.end());
  scan.num_rings = std::max(static_cast<int>(ring.size()), highest + 1);
}

// What the range picture's rows and columns mean.
struct RotatingGeometry {
  const VelodyneCalibration* calibration = nullptr;
  double azimuth_step = 0;  // counter-clockwise
  double azimuth_start = 0;
  int num_columns = 0;  // those in use
};

// MRPT makes these pictures itself out of Velodyne packets
// (CObservationRotatingScan::fromVelodyne), and there, unlike documented, azimuths run clockwise,
// and only every rows-th part of the columns is used.
RotatingGeometry geometry_of(const CObservationRotatingScan& observation) {
  RotatingGeometry geometry;
  const std::string& model = observation.lidarModel;
  geometry.calibration = &default_calibration(model == "VLP-16"    ? "VLP16"
                                              : model == "HDL-32E" ? "HDL32"
                                                                   : model);
  if (geometry.calibration->laser_corrections.size() !=
      static_cast<std::size_t>(observation.rangeImage.rows())) {
    throw std::runtime_error("no elevation angles are known of LiDAR model '" + model + "' with " +
                             std::to_string(observation.rangeImage.rows()) +
                             " rings: convert the log to CObservationPointCloud");
  }
  const bool by_mrpt = model == "VLP-16" || model == "HDL-32E";
  const int columns = static_cast<int>(observation.rangeImage.cols());
  geometry.num_columns =
      by_mrpt ? columns / std::max(1, static_cast<int>(observation.rangeImage.rows())) : columns;
  const double sign = by_mrpt ? -1. : 1.;
  geometry.azimuth_start = sign * observation.startAzimuth;
  geometry.azimuth_step = sign * observation.azimuthSpan / std::max(1, geometry.num_columns);
  return geometry;
}

}  // namespace

CObservationVelodyneScan::Ptr make_velodyne_scan(const LidarScan& scan) {
  auto observation = CObservationVelodyneScan::Create();
  auto& cloud = observation->point_cloud;
  observation->minRange = 0;
  observation->originalReceivedTimestamp = scan.stamp;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const Eigen::Vector3f& p = scan.points[i];
    cloud.x.push_back(p.isZero(0.F) ? 1e-6F : p.x());
    cloud.y.push_back(p.y());
    cloud.z.push_back(p.z());
    const float intensity = scan.intensity.empty() ? 0.F : std::clamp(scan.intensity[i], 0.F, 1.F);
    cloud.intensity.push_back(static_cast<std::uint8_t>(std::lround(255.F * intensity)));
    if (!scan.ring.empty()) cloud.laser_id.push_back(static_cast<std::int16_t>(scan.ring[i]));
    if (!scan.time_s.empty()) cloud.timestamp.push_back(shifted(scan.stamp, scan.time_s[i]));
  }
  return observation;
}

void read_velodyne_scan(const CObservationVelodyneScan& observation, LidarScan& scan) {
  const bool is_packed = observation.point_cloud.size() == 0 && !observation.scan_packets.empty();
  read_points(is_packed ? unpacked(observation) : observation, scan);
}

void read_rotating_scan(const CObservationRotatingScan& observation, LidarScan& scan) {
  const RotatingGeometry geometry = geometry_of(observation);
  const std::vector<std::uint16_t> ring = ring_of_laser(*geometry.calibration);
  const bool with_intensity = observation.intensityImage.rows() == observation.rangeImage.rows() &&
                              observation.intensityImage.cols() == observation.rangeImage.cols();
  for (int laser = 0; laser < static_cast<int>(ring.size()); ++laser) {
    const auto& beam = geometry.calibration->laser_corrections[static_cast<std::size_t>(laser)];
    for (int column = 0; column < geometry.num_columns; ++column) {
      const double range = observation.rangeImage(laser, column) * observation.rangeResolution;
      if (range <= 0 || range < observation.minRange || range > observation.maxRange) continue;
      const double azimuth = geometry.azimuth_start + column * geometry.azimuth_step;
      const double level = range * beam.cosVertCorrection;
      const Eigen::Vector3f point =
          Eigen::Vector3d(level * std::cos(azimuth), level * std::sin(azimuth),
                          range * beam.sinVertCorrection)
              .cast<float>();
      if (!is_measured(point)) continue;
      scan.points.push_back(point);
      scan.ring.push_back(ring[static_cast<std::size_t>(laser)]);
      scan.column.push_back(static_cast<std::uint16_t>(column));
      if (with_intensity) {
        scan.intensity.push_back(static_cast<float>(observation.intensityImage(laser, column)) /
                                 255.F);
      }
    }
  }
  scan.num_rings = static_cast<int>(ring.size());
  scan.num_columns = geometry.num_columns;
}

}  // namespace lidar_upsampling
