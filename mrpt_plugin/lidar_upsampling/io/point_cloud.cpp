// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <algorithm>
#include <utility>

#include "lidar_upsampling/compat/point_fields.h"
#include "lidar_upsampling/io/scan_classes.h"
#include "lidar_upsampling/io/turning_scans.h"

namespace lidar_upsampling {
namespace {

void scale_to_unit(std::vector<float>& intensity) {
  if (intensity.empty()) return;
  const float largest = *std::max_element(intensity.begin(), intensity.end());
  const float scale = largest <= 1.F ? 1.F : 1.F / std::max(255.F, largest);
  for (float& value : intensity) value = std::max(0.F, value * scale);
}

template <typename Value>
void append(const std::vector<Value>& field, std::size_t i, std::vector<Value>& to) {
  if (!field.empty()) to.push_back(field[i]);
}

int one_more_than_largest(const std::vector<std::uint16_t>& values) {
  return values.empty() ? 0 : 1 + *std::max_element(values.begin(), values.end());
}

}  // namespace

mrpt::obs::CObservationPointCloud::Ptr make_point_cloud(const LidarScan& scan) {
  auto observation = mrpt::obs::CObservationPointCloud::Create();
  const auto map =
      compat::make_points_map(scan.size(), {scan.intensity, scan.ring, scan.column, scan.time_s});
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const Eigen::Vector3f& p = scan.points[i];
    // The exact origin means "no return" in MRPT's other scan classes.
    map->setPointFast(i, p.isZero(0.F) ? 1e-6F : p.x(), p.y(), p.z());
  }
  observation->pointcloud = map;
  return observation;
}

void read_point_cloud(const mrpt::obs::CObservationPointCloud& observation, LidarScan& scan) {
  if (!observation.pointcloud) return;
  const mrpt::maps::CPointsMap& map = *observation.pointcloud;
  const auto& x = map.getPointsBufferRef_x();
  const auto& y = map.getPointsBufferRef_y();
  const auto& z = map.getPointsBufferRef_z();
  const compat::PointFields fields = compat::point_fields(map);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Eigen::Vector3f point(x[i], y[i], z[i]);
    if (!is_measured(point)) continue;
    scan.points.push_back(point);
    append(fields.intensity, i, scan.intensity);
    append(fields.ring, i, scan.ring);
    append(fields.column, i, scan.column);
    append(fields.time_s, i, scan.time_s);
  }
  scale_to_unit(scan.intensity);
  scan.num_rings = one_more_than_largest(scan.ring);
  scan.num_columns = one_more_than_largest(scan.column);
  number_rings_upwards(scan);
  if (scan.column.empty()) find_columns(scan);
}

}  // namespace lidar_upsampling
