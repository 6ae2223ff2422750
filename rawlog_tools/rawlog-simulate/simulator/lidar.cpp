// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "simulator/lidar.h"

#include <tbb/parallel_for.h>

#include <cmath>

#include "simulator/noise.h"
#include "simulator/scene.h"
#include "simulator/texture.h"

namespace lidar_upsampling::sim {

namespace {

struct Return {
  float range = 0;  ///< 0: none
  float intensity = 0;
  int object = -1;
};

constexpr int kBundle = 16;

struct ScanInstant {
  const World& world;
  const LidarSpec& lidar;
  Scene scene;
  Pose T_world_lidar;
  View view;
  std::uint32_t seed;
};

ScanInstant instant_at(const World& world, const LidarSpec& lidar, double t, std::uint32_t seed) {
  Scene scene = scene_at(world, t);
  const Pose T_world_lidar = world.T_world_vehicle(t) * lidar.T_vehicle_lidar;
  View view(scene, T_world_lidar.translation());
  return {world, lidar, std::move(scene), T_world_lidar, std::move(view), seed};
}

// Of a ball about the frame's origin that holds the whole object.
double reach_of(const Object& object) {
  double reach = 0;
  for (const Part& part : object.parts) {
    reach = std::max(reach, part.solid.center.norm() + part.solid.bounding_radius);
  }
  return reach;
}

// While a column is measured its beams lie in a half-plane, so that few objects matter: each column
// has its own scene, which would else take most of the time.
ScanInstant column_instant(const World& world, const LidarSpec& lidar, int column, double t,
                           std::uint32_t seed, const std::vector<double>& reaches) {
  const Pose T_world_lidar = world.T_world_vehicle(t) * lidar.T_vehicle_lidar;
  const Eigen::Vector3d up = T_world_lidar.linear().col(2);
  const Eigen::Vector3d beam = T_world_lidar.linear() * beam_direction(lidar, 0, column);
  const Eigen::Vector3d across = up.cross(beam).normalized(), ahead = across.cross(up);
  Scene scene = scene_at(world, t, [&](const Object& object, const Pose& T_world_object) {
    const Eigen::Vector3d to = T_world_object.translation() - T_world_lidar.translation();
    const double reach = reaches[object.id] + 0.01;
    return std::abs(to.dot(across)) <= reach && to.dot(ahead) >= -reach;
  });
  View view(scene, T_world_lidar.translation());
  return {world, lidar, std::move(scene), T_world_lidar, std::move(view), seed};
}

RayBundle bundle_of(const ScanInstant& now, int ring_from, int ring_to, int column_from,
                    int column_to) {
  const Eigen::Matrix3d R = now.T_world_lidar.linear();
  RayBundle bundle;
  bundle.axis =
      R * beam_direction(now.lidar, (ring_from + ring_to) / 2, (column_from + column_to) / 2);
  double lowest_cosine = 1;
  for (const int ring : {ring_from, ring_to}) {
    for (const int column : {column_from, column_to}) {
      const Eigen::Vector3d corner = R * beam_direction(now.lidar, ring, column);
      lowest_cosine = std::min(lowest_cosine, bundle.axis.dot(corner));
    }
  }
  bundle.half_angle = std::acos(lowest_cosine) + 0.01;
  // Columns are half-planes through the scanner's axis; a depth picture's are, too.
  const Eigen::Vector3d up = R.col(2);
  const Eigen::Vector3d first = R * beam_direction(now.lidar, ring_from, column_from);
  const Eigen::Vector3d last = R * beam_direction(now.lidar, ring_from, column_to);
  bundle.sides = {up.cross(first), last.cross(up)};
  return bundle;
}

Return measured(const ScanInstant& now, const RayHit& hit, const Eigen::Vector3d& direction,
                std::uint32_t beam) {
  const LidarSpec& lidar = now.lidar;
  if (!hit.any() || hit.range < lidar.min_range_m || hit.range > lidar.max_range_m) return {};
  const Object& object = now.world.objects[hit.object];
  const Pose& T_world_object = now.scene.T_world_object[hit.object];
  const double spot = 0.02 + 0.002 * hit.range;
  SurfacePoint point{T_world_object.inverse() *
                         Eigen::Vector3d(now.T_world_lidar.translation() + hit.range * direction),
                     T_world_object.linear().transpose() * hit.normal,
                     Eigen::Vector3d::Constant(spot), spot};
  const Surface surface = surface_at(now.world.street, object, object.parts[hit.part], point);
  const auto facing = static_cast<float>(std::max(0.05, -hit.normal.dot(direction)));
  const float dull = std::min(1.F, 0.08F + 0.9F * surface.albedo.mean());
  const float bright = (1 - surface.mirror) * dull + surface.mirror;
  // A surface of 2 % that faces the scanner is seen just to the maximal range; light falls with its
  // square.
  const double reach = lidar.max_range_m * std::sqrt(bright * facing / 0.02);
  const double chance = uniform(now.seed ^ 0x51ed27U, beam);
  if (hit.range > reach || chance < lidar.dropout + 0.6 * surface.glass) return {};
  const double sigma = lidar.noise_m + lidar.noise_per_m2 * hit.range * hit.range;
  const double range = hit.range + sigma * gaussian(now.seed, beam);
  return {static_cast<float>(range), bright * (0.35F + 0.65F * facing), hit.object};
}

void scan_columns(const ScanInstant& now, int column_from, int column_to,
                  std::vector<Return>& returns) {
  const int num_rings = now.lidar.num_rings();
  for (int ring_from = 0; ring_from < num_rings; ring_from += kBundle) {
    const int ring_to = std::min(ring_from + kBundle, num_rings) - 1;
    const auto candidates =
        now.view.candidates(bundle_of(now, ring_from, ring_to, column_from, column_to));
    for (int column = column_from; column <= column_to; ++column) {
      for (int ring = ring_from; ring <= ring_to; ++ring) {
        const Eigen::Vector3d direction =
            now.T_world_lidar.linear() * beam_direction(now.lidar, ring, column);
        const auto beam = static_cast<std::uint32_t>(column * num_rings + ring);
        returns[beam] = measured(now, now.view.cast(direction, candidates), direction, beam);
      }
    }
  }
}

SimulatedScan collected(const LidarSpec& lidar, const std::vector<Return>& returns) {
  SimulatedScan result;
  LidarScan& scan = result.scan;
  scan.label = lidar.label;
  scan.T_vehicle_lidar = lidar.T_vehicle_lidar;
  scan.num_rings = lidar.num_rings();
  scan.num_columns = lidar.columns;
  for (int column = 0; column < lidar.columns; ++column) {
    for (int ring = 0; ring < scan.num_rings; ++ring) {
      const Return& r = returns[static_cast<std::size_t>(column) * scan.num_rings + ring];
      if (r.range <= 0) continue;
      scan.points.emplace_back((r.range * beam_direction(lidar, ring, column)).cast<float>());
      scan.intensity.push_back(r.intensity);
      scan.ring.push_back(static_cast<std::uint16_t>(ring));
      scan.column.push_back(static_cast<std::uint16_t>(column));
      if (lidar.sweep) scan.time_s.push_back(static_cast<float>(sweep_time(lidar, column)));
      result.object.push_back(r.object);
    }
  }
  return result;
}

}  // namespace

Eigen::Vector3d beam_direction(const LidarSpec& lidar, int ring, int column) {
  if (lidar.depth_camera) {
    const CameraModel& m = *lidar.depth_camera;
    const int row = m.height - 1 - ring;
    return Eigen::Vector3d(1, (m.cx - column) / m.fx, (m.cy - row) / m.fy).normalized();
  }
  const double azimuth = M_PI - 2 * M_PI * (column + 0.5) / lidar.columns;
  const double elevation = lidar.elevations[ring];
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
          std::sin(elevation)};
}

double sweep_time(const LidarSpec& lidar, int column) {
  return lidar.sweep ? ((column + 0.5) / lidar.columns - 0.5) / lidar.rate_hz : 0;
}

SimulatedScan scan_at(const World& world, const LidarSpec& lidar, Stamp stamp, std::uint32_t seed) {
  const double t = time_of(stamp);
  const auto ticks = static_cast<std::uint32_t>((stamp - start_stamp()).count());
  const std::uint32_t own = hash(seed, ticks);
  std::vector<Return> returns(static_cast<std::size_t>(lidar.num_rings()) * lidar.columns);
  if (lidar.sweep) {
    std::vector<double> reaches;
    for (const Object& object : world.objects) reaches.push_back(reach_of(object));
    tbb::parallel_for(0, lidar.columns, [&](int column) {
      const double at = t + sweep_time(lidar, column);
      const ScanInstant now = column_instant(world, lidar, column, at, own, reaches);
      scan_columns(now, column, column, returns);
    });
  } else {
    const ScanInstant now = instant_at(world, lidar, t, own);
    const int num_bundles = (lidar.columns + kBundle - 1) / kBundle;
    tbb::parallel_for(0, num_bundles, [&](int i) {
      scan_columns(now, i * kBundle, std::min((i + 1) * kBundle, lidar.columns) - 1, returns);
    });
  }
  SimulatedScan result = collected(lidar, returns);
  result.scan.stamp = stamp;
  return result;
}

}  // namespace lidar_upsampling::sim
