// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/io/scan_classes.h"

#include <mrpt/maps/CColouredPointsMap.h>
#include <mrpt/maps/CPointsMapXYZI.h>
#include <mrpt/maps/CSimplePointsMap.h>

#include <algorithm>
#include <functional>

namespace lidar_upsampling {
namespace {

using mrpt::maps::CPointsMap;
using mrpt::maps::CPointsMapXYZI;

void set_points(const LidarScan& scan, CPointsMap& map) {
  map.resize(scan.size());
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const Eigen::Vector3f& p = scan.points[i];
    // The exact origin means "no return" in MRPT's other scan classes.
    map.setPointFast(i, p.isZero(0.F) ? 1e-6F : p.x(), p.y(), p.z());
  }
}

// Intensity of the i-th point, as stored; null if the map has none.
std::function<float(std::size_t)> intensity_reader(const CPointsMap& map) {
  if (const auto* const xyzi = dynamic_cast<const CPointsMapXYZI*>(&map)) {
    return [xyzi](std::size_t i) { return xyzi->getPointIntensity_fast(i); };
  }
  if (const auto* const coloured = dynamic_cast<const mrpt::maps::CColouredPointsMap*>(&map)) {
    return [coloured](std::size_t i) {
      float x = 0, y = 0, z = 0, r = 0, g = 0, b = 0;
      coloured->getPointRGB(i, x, y, z, r, g, b);
      return (r + g + b) / 3.F;
    };
  }
  return nullptr;
}

void scale_to_unit(std::vector<float>& intensity) {
  if (intensity.empty()) return;
  const float largest = *std::max_element(intensity.begin(), intensity.end());
  const float scale = largest <= 1.F ? 1.F : 1.F / std::max(255.F, largest);
  for (float& value : intensity) value = std::max(0.F, value * scale);
}

}  // namespace

mrpt::obs::CObservationPointCloud::Ptr make_point_cloud(const LidarScan& scan) {
  auto observation = mrpt::obs::CObservationPointCloud::Create();
  if (scan.intensity.empty()) {
    const auto map = mrpt::maps::CSimplePointsMap::Create();
    set_points(scan, *map);
    observation->pointcloud = map;
    return observation;
  }
  const auto map = CPointsMapXYZI::Create();
  set_points(scan, *map);
  for (std::size_t i = 0; i < scan.size(); ++i) map->setPointIntensity(i, scan.intensity[i]);
  observation->pointcloud = map;
  return observation;
}

void read_point_cloud(const mrpt::obs::CObservationPointCloud& observation, LidarScan& scan) {
  if (!observation.pointcloud) return;
  const CPointsMap& map = *observation.pointcloud;
  const auto& x = map.getPointsBufferRef_x();
  const auto& y = map.getPointsBufferRef_y();
  const auto& z = map.getPointsBufferRef_z();
  const auto intensity_of = intensity_reader(map);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Eigen::Vector3f point(x[i], y[i], z[i]);
    if (!is_measured(point)) continue;
    scan.points.push_back(point);
    if (intensity_of) scan.intensity.push_back(intensity_of(i));
  }
  scale_to_unit(scan.intensity);
}

}  // namespace lidar_upsampling
