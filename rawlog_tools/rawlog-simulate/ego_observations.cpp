// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "ego_observations.h"

#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include <GeographicLib/LocalCartesian.hpp>
#include <algorithm>

#include "lidar_upsampling/io/images.h"
#include "simulator/sensor_errors.h"

namespace lidar_upsampling::sim {

namespace {

// Wheels know nothing of the body's sway.
mrpt::poses::CPose2D wheels_at(const World& world, Stamp stamp) {
  const MotionState state = state_at(world.ego.motion, time_of(stamp));
  return {state.x, state.y, state.yaw};
}

// `instant` is what the wheels tell of, the log's start being where they count from.
mrpt::obs::CObservation::Ptr odometry_observation(const World& world, Stamp instant) {
  auto observation = mrpt::obs::CObservationOdometry::Create();
  const MotionState state = state_at(world.ego.motion, time_of(instant));
  observation->odometry = wheels_at(world, instant) - wheels_at(world, start_stamp());
  observation->hasVelocities = true;
  observation->velocityLocal = {state.speed, 0, state.yaw_rate};
  return observation;
}

mrpt::obs::CObservation::Ptr gnss_observation(const Pose& T_world_vehicle, const EgoPoseSpec& spec,
                                              Stamp stamp) {
  constexpr double kHeight = 100, kUndulation = 44;
  const Eigen::Vector3d antenna(0, 0, 1.6);
  const Eigen::Vector3d p = T_world_vehicle * antenna;
  const GeographicLib::LocalCartesian earth(spec.latitude_deg, spec.longitude_deg, kHeight);
  mrpt::obs::gnss::Message_NMEA_GGA gga;
  double height = 0;
  earth.Reverse(p.x(), p.y(), p.z(), gga.fields.latitude_degrees, gga.fields.longitude_degrees,
                height);
  gga.fields.altitude_meters = height - kUndulation;
  gga.fields.geoidal_distance = kUndulation;
  gga.fields.orthometric_altitude = height;
  gga.fields.corrected_orthometric_altitude = height;
  gga.fields.fix_quality = 4;
  gga.fields.satellitesUsed = 14;
  gga.fields.thereis_HDOP = true;
  gga.fields.HDOP = 0.8F;
  gga.fields.UTCTime.hour = 0;
  const double seconds = time_of(stamp);
  gga.fields.UTCTime.minute = static_cast<std::uint8_t>(seconds / 60);
  gga.fields.UTCTime.sec = seconds - 60. * gga.fields.UTCTime.minute;
  auto observation = mrpt::obs::CObservationGPS::Create();
  observation->setMsg(gga);
  observation->originalReceivedTimestamp = stamp;
  observation->has_satellite_timestamp = true;
  observation->sensorPose = mrpt::poses::CPose3D(antenna.x(), antenna.y(), antenna.z());
  return observation;
}

mrpt::obs::CObservation::Ptr told_pose_observation(const Pose& T_world_vehicle,
                                                   const EgoPoseSpec& spec) {
  auto observation = mrpt::obs::CObservationRobotPose::Create();
  observation->pose.mean = to_mrpt(T_world_vehicle);
  observation->pose.cov.setDiagonal(1e-6);
  for (int i = 0; i < 6; ++i) {
    const double sigma = i < 3 ? spec.noise_m : spec.noise_rad;
    observation->pose.cov(i, i) = std::max(1e-6, sigma * sigma);
  }
  return observation;
}

}  // namespace

mrpt::obs::CObservation::Ptr pose_observation(const World& world, const std::string& label,
                                              Stamp stamp) {
  auto observation = mrpt::obs::CObservationRobotPose::Create();
  observation->pose.mean = to_mrpt(world.T_world_vehicle(time_of(stamp)));
  observation->pose.cov.setDiagonal(1e-6);
  observation->sensorLabel = label;
  observation->timestamp = stamp;
  return observation;
}

mrpt::obs::CObservation::Ptr ego_observation(const World& world, const EgoPoseSpec& spec,
                                             Stamp stamp, std::uint32_t seed) {
  mrpt::obs::CObservation::Ptr observation;
  switch (spec.kind) {
    case EgoPoseKind::none:
      return nullptr;
    case EgoPoseKind::pose:
      observation = told_pose_observation(told_ego_pose(world, spec, stamp, seed), spec);
      break;
    case EgoPoseKind::odometry:
      observation = odometry_observation(world, shifted(stamp, -spec.lag_s));
      break;
    case EgoPoseKind::gnss:
      observation = gnss_observation(told_ego_pose(world, spec, stamp, seed), spec, stamp);
      break;
  }
  observation->sensorLabel = spec.label;
  observation->timestamp = stamp;
  return observation;
}

mrpt::obs::CActionCollection movement(const World& world, Stamp from, Stamp to) {
  mrpt::obs::CActionRobotMovement2D action;
  mrpt::obs::CActionRobotMovement2D::TMotionModelOptions model;
  action.timestamp = to;
  action.computeFromOdometry(wheels_at(world, to) - wheels_at(world, from), model);
  mrpt::obs::CActionCollection actions;
  actions.insert(action);
  return actions;
}

}  // namespace lidar_upsampling::sim
