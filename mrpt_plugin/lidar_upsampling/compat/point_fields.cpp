// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/compat/point_fields.h"

#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/version.h>

#include <string>

#if MRPT_VERSION >= 0x020f04
#include <mrpt/maps/CGenericPointsMap.h>
#else
#include <mrpt/maps/CPointsMapXYZI.h>
#if __has_include(<mrpt/maps/CPointsMapXYZIRT.h>)
#include <mrpt/maps/CPointsMapXYZIRT.h>
#define LIDAR_UPSAMPLING_HAS_XYZIRT
#endif
#endif

// Deprecated since 2.15.3, but to be met in older logs.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
#include <mrpt/maps/CColouredPointsMap.h>

namespace lidar_upsampling::compat {
namespace {

using mrpt::maps::CPointsMap;

template <typename Value, typename Read>
std::vector<Value> all_of(std::size_t size, const Read& read) {
  std::vector<Value> values(size);
  for (std::size_t i = 0; i < size; ++i) values[i] = read(i);
  return values;
}

// The gray of coloured points; empty of others.
std::vector<float> grays(const CPointsMap& map) {
  const auto* const coloured = dynamic_cast<const mrpt::maps::CColouredPointsMap*>(&map);
  if (coloured == nullptr) return {};
  return all_of<float>(map.size(), [coloured](std::size_t i) {
    float r = 0, g = 0, b = 0;
    coloured->getPointColor_fast(i, r, g, b);
    return (r + g + b) / 3.F;
  });
}

}  // namespace
#pragma GCC diagnostic pop

#if MRPT_VERSION >= 0x020f04

namespace {

// 2.15 asks for strings, 3.0 for views of them.
const std::string kIntensity = CPointsMap::POINT_FIELD_INTENSITY,
                  kRing = CPointsMap::POINT_FIELD_RING_ID,
                  kTime = CPointsMap::POINT_FIELD_TIMESTAMP, kColumn = "column";

// What maps call a field may be there and hold nothing.
template <typename Value, typename Buffer>
std::vector<Value> copied(const CPointsMap& map, const Buffer* buffer) {
  if (buffer == nullptr || buffer->size() != map.size()) return {};
  return {buffer->begin(), buffer->end()};
}

std::vector<float> floats(const CPointsMap& map, const std::string& name) {
  return copied<float>(map, map.getPointsBufferRef_float_field(name));
}

std::vector<std::uint16_t> numbers(const CPointsMap& map, const std::string& name) {
  return copied<std::uint16_t>(map, map.getPointsBufferRef_uint16_field(name));
}

void set(CPointsMap& map, const std::string& name, const std::vector<float>& values) {
  if (values.empty()) return;
  map.registerField_float(name);
  map.getPointsBufferRef_float_field(name)->assign(values.begin(), values.end());
}

void set(CPointsMap& map, const std::string& name, const std::vector<std::uint16_t>& values) {
  if (values.empty()) return;
  map.registerField_uint16(name);
  map.getPointsBufferRef_uint16_field(name)->assign(values.begin(), values.end());
}

}  // namespace

PointFields point_fields(const CPointsMap& map) {
  PointFields fields{floats(map, kIntensity), numbers(map, kRing), numbers(map, kColumn),
                     floats(map, kTime)};
  if (fields.intensity.empty()) fields.intensity = grays(map);
  return fields;
}

CPointsMap::Ptr make_points_map(std::size_t size, const PointFields& fields) {
  CPointsMap::Ptr map = mrpt::maps::CSimplePointsMap::Create();
  const bool is_bare = fields.intensity.empty() && fields.ring.empty() && fields.time_s.empty();
  if (!is_bare) map = mrpt::maps::CGenericPointsMap::Create();
  map->resize(size);
  if (is_bare) return map;
  set(*map, kIntensity, fields.intensity);
  set(*map, kRing, fields.ring);
  set(*map, kColumn, fields.column);
  set(*map, kTime, fields.time_s);
  return map;
}

const char* maps_with_rings_since() { return "2.15"; }

#else

namespace {

using mrpt::maps::CPointsMapXYZI;

CPointsMap::Ptr make_map_with_intensity(std::size_t size, const std::vector<float>& intensity) {
  const auto map = CPointsMapXYZI::Create();
  map->resize(size);
  for (std::size_t i = 0; i < size; ++i) map->setPointIntensity(i, intensity[i]);
  return map;
}

#ifdef LIDAR_UPSAMPLING_HAS_XYZIRT

using mrpt::maps::CPointsMapXYZIRT;

PointFields fields_of(const CPointsMapXYZIRT& map) {
  PointFields fields;
  const std::size_t size = map.size();
  if (map.hasIntensityField())
    fields.intensity = all_of<float>(size, [&](std::size_t i) { return map.getPointIntensity(i); });
  if (map.hasRingField())
    fields.ring = all_of<std::uint16_t>(size, [&](std::size_t i) { return map.getPointRing(i); });
  if (map.hasTimeField())
    fields.time_s = all_of<float>(size, [&](std::size_t i) { return map.getPointTime(i); });
  return fields;
}

CPointsMap::Ptr make_map_with_rings(std::size_t size, const PointFields& fields) {
  const auto map = CPointsMapXYZIRT::Create();
  map->resize_XYZIRT(size, !fields.intensity.empty(), !fields.ring.empty(), !fields.time_s.empty());
  for (std::size_t i = 0; i < size; ++i) {
    if (!fields.intensity.empty()) map->setPointIntensity(i, fields.intensity[i]);
    if (!fields.ring.empty()) map->setPointRing(i, fields.ring[i]);
    if (!fields.time_s.empty()) map->setPointTime(i, fields.time_s[i]);
  }
  return map;
}

#endif

}  // namespace

PointFields point_fields(const CPointsMap& map) {
#ifdef LIDAR_UPSAMPLING_HAS_XYZIRT
  if (const auto* const full = dynamic_cast<const CPointsMapXYZIRT*>(&map)) return fields_of(*full);
#endif
  PointFields fields;
  if (const auto* const xyzi = dynamic_cast<const CPointsMapXYZI*>(&map))
    fields.intensity = all_of<float>(
        map.size(), [xyzi](std::size_t i) { return xyzi->getPointIntensity_fast(i); });
  else
    fields.intensity = grays(map);
  return fields;
}

CPointsMap::Ptr make_points_map(std::size_t size, const PointFields& fields) {
#ifdef LIDAR_UPSAMPLING_HAS_XYZIRT
  if (!fields.ring.empty() || !fields.time_s.empty()) return make_map_with_rings(size, fields);
#endif
  if (!fields.intensity.empty()) return make_map_with_intensity(size, fields.intensity);
  const auto map = mrpt::maps::CSimplePointsMap::Create();
  map->resize(size);
  return map;
}

const char* maps_with_rings_since() {
#ifdef LIDAR_UPSAMPLING_HAS_XYZIRT
  return "2.11.4";
#else
  return nullptr;
#endif
}

#endif

}  // namespace lidar_upsampling::compat
