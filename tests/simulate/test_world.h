// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <algorithm>
#include <limits>

#include "simulator/camera.h"
#include "simulator/lidar.h"

namespace lidar_upsampling::sim {

/// An empty plain with an ego at rest at the origin.
inline World empty_world() {
  World world;
  world.street.crossing_x = std::numeric_limits<double>::quiet_NaN();
  Object ground;
  ground.parts.push_back({intersection({{Eigen::Vector3d::UnitZ(), 0}}), Material::asphalt,
                          Eigen::Vector3f::Constant(0.16F)});
  world.objects.push_back(ground);
  return world;
}

inline int add_vehicle(World& world, const std::string& type, const MotionProfile& motion) {
  Object vehicle = make_vehicle(type, 31, Eigen::Vector3f(0.4F, 0.1F, 0.1F));
  vehicle.motion = motion;
  vehicle.id = static_cast<int>(world.objects.size());
  world.objects.push_back(vehicle);
  return vehicle.id;
}

inline LidarSpec test_lidar(double noise_m = 0) {
  LidarSpec lidar;
  lidar.elevations = hdl64_elevations();
  lidar.noise_m = noise_m;
  lidar.dropout = 0;
  lidar.T_vehicle_lidar.translation().z() = 1.73;
  return lidar;
}

inline CameraSpec test_camera() {
  CameraSpec spec;
  spec.camera.label = "CAM0";
  CameraModel& model = spec.camera.model;
  model.width = 800;
  model.height = 300;
  model.fx = model.fy = 700;
  model.cx = 399.5;
  model.cy = 140;
  spec.camera.T_vehicle_camera.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  spec.camera.T_vehicle_camera.translation() << 0.27, 0.06, 1.65;
  return spec;
}

/// Lowest distance of a world point to any part of an object.
inline double distance_to(const World& world, int object, double t, const Eigen::Vector3d& point) {
  const Eigen::Vector3d in_object = world.T_world_object(object, t).inverse() * point;
  double distance = std::numeric_limits<double>::infinity();
  for (const Part& part : world.objects[object].parts) {
    distance = std::min(distance, signed_distance(part.solid, in_object));
  }
  return distance;
}

inline int num_points_of(const SimulatedScan& scan, int object) {
  return static_cast<int>(std::count(scan.object.begin(), scan.object.end(), object));
}

}  // namespace lidar_upsampling::sim
