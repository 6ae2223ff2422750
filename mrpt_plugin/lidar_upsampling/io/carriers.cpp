// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/io/carriers.h"

#include <mrpt/io/lazy_load_path.h>
#include <mrpt/system/datetime.h>

#include <filesystem>
#include <numeric>
#include <stdexcept>

#include "lidar_upsampling/compat/mrpt.h"
#include "lidar_upsampling/io/images.h"
#include "lidar_upsampling/io/reading_guard.h"
#include "lidar_upsampling/io/scan_classes.h"
#include "lidar_upsampling/io/silence.h"
#include "lidar_upsampling/io/unpacker.h"
#include "lidar_upsampling/text.h"

namespace lidar_upsampling {
namespace {

using mrpt::obs::CObservation3DRangeScan;
using mrpt::obs::CObservationPointCloud;
using mrpt::obs::CObservationRotatingScan;
using mrpt::obs::CObservationVelodyneScan;

// External files that the observation refers to.
std::vector<std::string> external_files(const mrpt::obs::CObservation& observation) {
  std::vector<std::string> files;
  if (const auto* const cloud = dynamic_cast<const CObservationPointCloud*>(&observation)) {
    if (cloud->isExternallyStored()) {
      files.push_back(mrpt::io::lazy_load_absolute_path(cloud->getExternalStorageFile()));
    }
  } else if (const auto* const scan = dynamic_cast<const CObservation3DRangeScan*>(&observation)) {
    if (scan->points3D_isExternallyStored()) {
      files.push_back(scan->points3D_getExternalStorageFileAbsolutePath());
    }
    if (scan->rangeImage_isExternallyStored()) {
      files.push_back(scan->rangeImage_getExternalStorageFileAbsolutePath(""));
    }
    if (scan->hasIntensityImage && scan->intensityImage.isExternallyStored()) {
      files.push_back(scan->intensityImage.getExternalStorageFileAbsolutePath());
    }
  }
  return files;
}

std::uint64_t unpacked_size_of_all(const std::vector<std::string>& files) {
  return std::accumulate(
      files.begin(), files.end(), std::uint64_t{0},
      [](std::uint64_t sum, const std::string& file) { return sum + unpacked_size_of(file); });
}

// Some classes load nothing from a missing file, without a word, and anything from a packed one.
void check_readable(const std::string& file) {
  if (!std::filesystem::exists(file)) throw std::runtime_error("there is no file " + file);
  if (!compat::kReadsZstd && Unpacker(file).is_zstd())
    throw std::runtime_error("its file " + file +
                             " is packed by zstd, as MRPT does from 2.15.7 on, and which this one "
                             "cannot read; put in its place what zstd -dc makes of it");
}

void read_points(const mrpt::obs::CObservation& observation, LidarScan& scan) {
  const Silence silence;
  const std::vector<std::string> files = external_files(observation);
  for (const std::string& file : files) check_readable(file);
  // Not without need: unload() of later MRPTs erases a Velodyne's embedded points.
  if (!files.empty()) {
    const ReadingGuard guard([&] { return unpacked_size_of_all(files); });
    observation.load();
  }
  if (const auto* const cloud = dynamic_cast<const CObservationPointCloud*>(&observation))
    read_point_cloud(*cloud, scan);
  else if (const auto* const depth = dynamic_cast<const CObservation3DRangeScan*>(&observation))
    read_range_scan_3d(*depth, scan);
  else if (const auto* const velodyne = dynamic_cast<const CObservationVelodyneScan*>(&observation))
    read_velodyne_scan(*velodyne, scan);
  else
    read_rotating_scan(dynamic_cast<const CObservationRotatingScan&>(observation), scan);
  if (!files.empty()) observation.unload();
}

Carrier resolve(Carrier carrier, const mrpt::obs::CObservation* like) {
  if (carrier == Carrier::same && like != nullptr) {
    if (dynamic_cast<const CObservationPointCloud*>(like) != nullptr) return Carrier::point_cloud;
    if (dynamic_cast<const CObservationVelodyneScan*>(like) != nullptr &&
        !compat::kVelodyneLosesPoints)
      return Carrier::velodyne;
  }
  return carrier == Carrier::point_cloud || carrier == Carrier::velodyne ? carrier
                                                                         : Carrier::range_scan_3d;
}

// The depth camera whose kind of picture the scan is to be; null if there is none.
const CObservation3DRangeScan* depth_camera(Carrier carrier, const mrpt::obs::CObservation* like) {
  if (carrier != Carrier::automatic && carrier != Carrier::same) return nullptr;
  const auto* const depth = dynamic_cast<const CObservation3DRangeScan*>(like);
  return depth != nullptr && is_depth_image(*depth) ? depth : nullptr;
}

mrpt::obs::CObservation::Ptr make_observation(const LidarScan& scan, Carrier carrier,
                                              const mrpt::obs::CObservation* like) {
  if (const auto* const depth = depth_camera(carrier, like)) {
    // MRPT's SLAM and mapping programs take no notice of ranges without points.
    return make_depth_image(scan, *depth, carrier == Carrier::automatic || depth->hasPoints3D);
  }
  const Carrier resolved = resolve(carrier, like);
  if (resolved == Carrier::point_cloud) return make_point_cloud(scan);
  if (resolved == Carrier::velodyne) return make_velodyne_scan(scan);
  return make_range_scan_3d(scan);
}

void check(const LidarScan& scan) {
  for (const Eigen::Vector3f& point : scan.points)
    if (!point.allFinite())
      throw std::invalid_argument("scan '" + scan.label + "' has a point that is not finite");
}

}  // namespace

Carrier carrier_from_string(const std::string& name) {
  if (name == "auto") return Carrier::automatic;
  if (name == "3drangescan") return Carrier::range_scan_3d;
  if (name == "pointcloud") return Carrier::point_cloud;
  if (name == "same") return Carrier::same;
  throw std::invalid_argument("carrier = '" + name +
                              "' is unknown; choose auto, 3drangescan, pointcloud or same");
}

bool is_lidar_scan(const mrpt::obs::CObservation& observation) {
  return dynamic_cast<const CObservationPointCloud*>(&observation) != nullptr ||
         dynamic_cast<const CObservation3DRangeScan*>(&observation) != nullptr ||
         dynamic_cast<const CObservationVelodyneScan*>(&observation) != nullptr ||
         dynamic_cast<const CObservationRotatingScan*>(&observation) != nullptr;
}

std::optional<LidarScan> scan_from_observation(const mrpt::obs::CObservation& observation) {
  if (!is_lidar_scan(observation)) return std::nullopt;
  LidarScan scan;
  scan.stamp = observation.timestamp;
  scan.label = observation.sensorLabel;
  scan.T_vehicle_lidar = from_mrpt(mrpt::poses::CPose3D(observation.sensorPose()));
  try {
    read_points(observation, scan);
  } catch (const std::exception& error) {
    throw std::runtime_error("no points in scan '" + scan.label + "' of " +
                             mrpt::system::dateTimeToString(scan.stamp) + ": " + one_line(error));
  }
  return scan;
}

mrpt::obs::CObservation::Ptr observation_from_scan(const LidarScan& scan, Carrier carrier,
                                                   const mrpt::obs::CObservation* like) {
  check(scan);
  mrpt::obs::CObservation::Ptr observation = make_observation(scan, carrier, like);
  observation->timestamp = scan.stamp;
  observation->sensorLabel = scan.label;
  observation->setSensorPose(to_mrpt(scan.T_vehicle_lidar));
  return observation;
}

}  // namespace lidar_upsampling
