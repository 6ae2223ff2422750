// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "stock_maps.h"

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationPointCloud.h>

#include <filesystem>

#include "lidar_upsampling/compat/mrpt.h"
#include "lidar_upsampling/io/carriers.h"
#include "lidar_upsampling/io/images.h"
#include "rawlog-map-compare/voxel_set.h"

namespace lidar_upsampling {
namespace {

bool carries_points(const mrpt::obs::CObservation& observation) {
  if (const auto* const scan =
          dynamic_cast<const mrpt::obs::CObservation3DRangeScan*>(&observation))
    return scan->hasPoints3D;
  return is_lidar_scan(observation);
}

MappedScan mapped_scan(mrpt::obs::CObservation& observation, const Pose& T_map_vehicle) {
  MappedScan mapped{observation.sensorLabel,
                    dynamic_cast<const mrpt::obs::CObservationPointCloud*>(&observation) != nullptr,
                    T_map_vehicle,
                    {}};
  if (!carries_points(observation)) return mapped;
  const LidarScan scan = scan_from_observation(observation).value();
  for (const Eigen::Vector3f& point : scan.points)
    mapped.points_in_vehicle.emplace_back(scan.T_vehicle_lidar * point.cast<double>());
  return mapped;
}

}  // namespace

bool maps_misplace_point_clouds() { return compat::kMapsMisplacePointClouds; }

std::vector<MappedScan> scans_in_simplemap(const std::string& path) {
  std::vector<MappedScan> scans;
  mrpt::maps::CSimpleMap map;
  if (!map.loadFromFile(path)) {
    ADD_FAILURE() << "no simplemap " << path;
    return scans;
  }
  for (std::size_t i = 0; i < map.size(); ++i) {
    const compat::Keyframe keyframe = compat::keyframe_of(map, i);
    const Pose T_map_vehicle = from_mrpt(keyframe.pose->getMeanVal());
    for (const auto& observation : *keyframe.frame)
      if (is_lidar_scan(*observation)) scans.push_back(mapped_scan(*observation, T_map_vehicle));
  }
  return scans;
}

std::vector<MappedScan> with_label(const std::vector<MappedScan>& scans, const std::string& label) {
  std::vector<MappedScan> found;
  std::copy_if(scans.begin(), scans.end(), std::back_inserter(found),
               [&](const MappedScan& scan) { return scan.label == label; });
  return found;
}

std::vector<Eigen::Vector3d> placed(const std::vector<MappedScan>& scans, Placing placing) {
  std::vector<Eigen::Vector3d> points;
  for (const MappedScan& scan : scans) {
    const bool at_origin =
        placing == Placing::at_origin || (placing == Placing::as_this_mrpt_does &&
                                          scan.is_point_cloud && maps_misplace_point_clouds());
    const Pose T_map_vehicle = at_origin ? Pose::Identity() : scan.T_map_vehicle;
    for (const auto& point : scan.points_in_vehicle) points.emplace_back(T_map_vehicle * point);
  }
  return points;
}

std::vector<Eigen::Vector3d> read_points(const std::string& path) {
  std::vector<Eigen::Vector3d> points;
  std::ifstream file(path);
  for (double x = 0, y = 0, z = 0; file >> x >> y >> z;) points.emplace_back(x, y, z);
  EXPECT_FALSE(points.empty()) << "no points in " << path;
  return points;
}

std::string file_ending_in(const std::string& folder, const std::string& ending) {
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    std::string path = entry.path().string();
    if (path.size() >= ending.size() &&
        path.compare(path.size() - ending.size(), ending.size(), ending) == 0)
      return path;
  }
  return {};
}

double share_found(const std::vector<Eigen::Vector3d>& points,
                   const std::vector<Eigen::Vector3d>& others, double tolerance_m) {
  VoxelSet occupied(tolerance_m);
  for (const auto& point : others) occupied.insert(point);
  const auto num_found = std::count_if(points.begin(), points.end(),
                                       [&](const auto& point) { return occupied.has_near(point); });
  return static_cast<double>(num_found) /
         static_cast<double>(std::max<std::size_t>(1, points.size()));
}

Eigen::AlignedBox3d extent(const std::vector<Eigen::Vector3d>& points) {
  Eigen::AlignedBox3d box;
  for (const auto& point : points) box.extend(point);
  return box;
}

double difference(const Eigen::AlignedBox3d& a, const Eigen::AlignedBox3d& b) {
  return std::max((a.min() - b.min()).cwiseAbs().maxCoeff(),
                  (a.max() - b.max()).cwiseAbs().maxCoeff());
}

}  // namespace lidar_upsampling
