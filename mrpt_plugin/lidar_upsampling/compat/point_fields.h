// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/maps/CPointsMap.h>

#include <cstdint>
#include <vector>

/// What MRPT's points maps know of a point besides its place has changed three times: 2.5 has an
/// intensity (CPointsMapXYZI), 2.11 a ring and a time (CPointsMapXYZIRT), 2.15.4 fields of any name
/// (CGenericPointsMap).
namespace lidar_upsampling::compat {

/// Each as many as there are points, or none.
struct PointFields {
  std::vector<float> intensity;  ///< as it is stored: in [0, 1] or of 8 bits
  std::vector<std::uint16_t> ring, column;
  std::vector<float> time_s;  ///< from the observation's stamp
};

/// Of a map of any class.
[[nodiscard]] PointFields point_fields(const mrpt::maps::CPointsMap& map);

/// @brief A map of so many points, whose places are still to be set, with those of the fields that
/// this MRPT can store: of the class that the oldest MRPT reads, where there is a choice.
[[nodiscard]] mrpt::maps::CPointsMap::Ptr make_points_map(std::size_t size,
                                                          const PointFields& fields);

/// The first release that reads the class in which make_points_map() stores rings and times; null:
/// it stores none.
[[nodiscard]] const char* maps_with_rings_since();

}  // namespace lidar_upsampling::compat
