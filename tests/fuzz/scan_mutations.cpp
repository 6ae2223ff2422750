// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationRotatingScan.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

#include <string>
#include <type_traits>
#include <vector>

#include "fuzz/field_mutations.h"
#include "lidar_upsampling/compat/point_fields.h"

namespace lidar_upsampling::fuzz {
namespace {

template <typename Number>
void spoil(std::vector<Number>& values, Random& random, Sizes sizes) {
  if (sizes == Sizes::changed && random.one_in(6)) {
    values.resize(random.one_in(2) ? random.below(values.size() + 2) : values.size() + 3);
    return;
  }
  if (values.empty()) return;
  const std::size_t times = random.one_in(4) ? values.size() : 1 + random.below(4);
  const double value = random.odd_number();
  for (std::size_t i = 0; i < times; ++i) {
    Number& one = values[random.below(values.size())];
    if constexpr (std::is_floating_point_v<Number>)
      one = static_cast<Number>(value);
    else
      one = static_cast<Number>(random.odd_count());
  }
}

void spoil(std::vector<Stamp>& stamps, Random& random, Sizes sizes) {
  if (sizes == Sizes::changed && random.one_in(6)) stamps.resize(random.below(stamps.size() + 3));
  if (stamps.empty()) return;
  Stamp& one = stamps[random.below(stamps.size())];
  one = odd_stamp(one, random);
}

template <typename Vector>
void spoil_aligned(Vector& values, Random& random, Sizes sizes) {
  std::vector<float> copy(values.begin(), values.end());
  spoil(copy, random, sizes);
  values.assign(copy.begin(), copy.end());
}

void spoil_own(mrpt::obs::CObservation3DRangeScan& scan, Random& random, Sizes sizes) {
  switch (random.below(11)) {
    case 0:
      return spoil_aligned(scan.points3D_x, random, sizes);
    case 1:
      return spoil_aligned(scan.points3D_y, random, sizes);
    case 2:
      return spoil_aligned(scan.points3D_z, random, sizes);
    case 3:
      return spoil(scan.points3D_idxs_x, random, sizes);
    case 4:
      return spoil(scan.points3D_idxs_y, random, sizes);
    case 5:
      scan.rangeUnits = static_cast<float>(random.odd_number());
      return;
    case 6:
      scan.maxRange = static_cast<float>(random.odd_number());
      return;
    case 7:
      return spoil(random.one_in(2) ? scan.cameraParams : scan.cameraParamsIntensity, random);
    case 8:
      scan.hasIntensityImage = true;
      scan.intensityImage = odd_picture(random);
      return;
    case 9:
      scan.hasRangeImage = !scan.hasRangeImage;
      if (scan.hasRangeImage)
        scan.rangeImage_setSize(static_cast<int>(random.below(40)),
                                static_cast<int>(random.below(40)));
      return;
    default:
      scan.hasPoints3D = !scan.hasPoints3D;
      scan.relativePoseIntensityWRTDepth = odd_pose(scan.relativePoseIntensityWRTDepth, random);
  }
}

void spoil_own(mrpt::obs::CObservationVelodyneScan& scan, Random& random, Sizes sizes) {
  auto& cloud = scan.point_cloud;
  switch (random.below(9)) {
    case 0:
      return spoil(cloud.x, random, sizes);
    case 1:
      return spoil(cloud.y, random, sizes);
    case 2:
      return spoil(cloud.z, random, sizes);
    case 3:
      return spoil(cloud.timestamp, random, sizes);
    case 4:
      return spoil(cloud.laser_id, random, sizes);
    case 5:
      return spoil(cloud.intensity, random, sizes);
    case 6:
      (random.one_in(2) ? scan.minRange : scan.maxRange) = random.odd_number();
      return;
    case 7:
      scan.calibration.laser_corrections.resize(random.below(70));
      return;
    default:
      if (scan.scan_packets.empty()) return;
      auto& packet = scan.scan_packets[random.below(scan.scan_packets.size())];
      auto* const bytes = reinterpret_cast<std::uint8_t*>(&packet);
      for (std::size_t i = 0; i < 1 + random.below(20); ++i)
        bytes[random.below(sizeof packet)] = static_cast<std::uint8_t>(random.bits());
  }
}

void spoil_own(mrpt::obs::CObservationRotatingScan& scan, Random& random, Sizes sizes) {
  switch (random.below(6)) {
    case 0:
      scan.rangeResolution = random.odd_number();
      return;
    case 1:
      scan.startAzimuth = random.odd_number();
      return;
    case 2:
      scan.azimuthSpan = random.odd_number();
      return;
    case 3:
      (random.one_in(2) ? scan.minRange : scan.maxRange) = random.odd_number();
      return;
    case 4:
      scan.lidarModel =
          random.pick(std::vector<std::string>{"VLP-16", "HDL-32E", "HDL32", "", "?"});
      return;
    default:
      if (sizes == Sizes::kept) return;
      auto& picture = scan.rangeImage;
      picture.resize(static_cast<int>(random.below(40)), static_cast<int>(random.below(80)));
      if (random.one_in(2)) return;
      scan.rowCount = static_cast<std::uint16_t>(picture.rows());
      scan.columnCount = static_cast<std::uint16_t>(random.odd_count());
  }
}

void spoil_intensity(mrpt::obs::CObservationPointCloud& scan, const mrpt::maps::CPointsMap& map,
                     Random& random) {
  compat::PointFields fields = compat::point_fields(map);
  if (fields.intensity.empty()) return;
  fields.intensity[random.below(map.size())] = static_cast<float>(random.odd_number());
  const auto spoilt = compat::make_points_map(map.size(), fields);
  for (std::size_t i = 0; i < map.size(); ++i) {
    float x = 0, y = 0, z = 0;
    map.getPointFast(i, x, y, z);
    spoilt->setPointFast(i, x, y, z);
  }
  scan.pointcloud = spoilt;
}

void spoil_own(mrpt::obs::CObservationPointCloud& scan, Random& random, Sizes) {
  auto* const map = dynamic_cast<mrpt::maps::CPointsMap*>(scan.pointcloud.get());
  if (map == nullptr || random.one_in(6)) {
    scan.pointcloud = random.one_in(2) ? nullptr : mrpt::maps::CSimplePointsMap::Create();
    return;
  }
  for (std::size_t i = 0; i < 1 + random.below(5) && map->size() > 0; ++i)
    map->setPointFast(random.below(map->size()), static_cast<float>(random.odd_number()),
                      static_cast<float>(random.odd_number()), 1.F);
  spoil_intensity(scan, *map, random);
}

template <typename Class>
bool spoilt_as(mrpt::obs::CObservation& observation, Random& random, Sizes sizes) {
  auto* const own = dynamic_cast<Class*>(&observation);
  if (own != nullptr) spoil_own(*own, random, sizes);
  return own != nullptr;
}

}  // namespace

bool spoil_scan(mrpt::obs::CObservation& observation, Random& random, Sizes sizes) {
  return spoilt_as<mrpt::obs::CObservation3DRangeScan>(observation, random, sizes) ||
         spoilt_as<mrpt::obs::CObservationVelodyneScan>(observation, random, sizes) ||
         spoilt_as<mrpt::obs::CObservationRotatingScan>(observation, random, sizes) ||
         spoilt_as<mrpt::obs::CObservationPointCloud>(observation, random, sizes);
}

}  // namespace lidar_upsampling::fuzz
