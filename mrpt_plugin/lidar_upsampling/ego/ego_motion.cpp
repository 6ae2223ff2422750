// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/ego/ego_motion.h"

#include <array>

namespace lidar_upsampling {

namespace {

InterpolationLimits limits_of(const EgoMotionOptions& options) {
  return {options.max_interpolation_gap_s, options.max_extrapolation_s};
}

EgoStep step_between(const TrajectoryPose& from, const TrajectoryPose& to) {
  return {to.T_world_vehicle.inverse() * from.T_world_vehicle,
          from.extrapolated || to.extrapolated};
}

std::optional<EgoStep> step_on(const Trajectory& trajectory, Stamp from, Stamp to) {
  const auto pose_from = trajectory.at(from);
  const auto pose_to = trajectory.at(to);
  if (!pose_from || !pose_to) return std::nullopt;
  return step_between(*pose_from, *pose_to);
}

}  // namespace

const char* to_string(EgoSource source) {
  constexpr std::array<const char*, 6> kNames{"auto", "poses",  "odometry",
                                              "gnss", "camera", "none"};
  return kNames.at(static_cast<std::size_t>(source));
}

EgoMotion::EgoMotion(const EgoMotionOptions& options)
    : options_(options),
      poses_(limits_of(options)),
      odometry_(limits_of(options)),
      gnss_(limits_of(options), options.gnss_min_step_m) {}

EgoSource EgoMotion::source() const {
  if (options_.source != EgoSource::automatic) return options_.source;
  if (poses_.size() >= 2) return EgoSource::poses;
  if (odometry_.size() >= 2) return EgoSource::odometry;
  return gnss_.size() >= 2 ? EgoSource::gnss : EgoSource::camera;
}

std::optional<EgoStep> EgoMotion::step(Stamp from, Stamp to) const {
  const EgoSource used = source();
  if (used == EgoSource::none) return EgoStep{};
  if (used == EgoSource::poses) return step_on(poses_, from, to);
  if (used == EgoSource::odometry) return step_on(odometry_, from, to);
  if (used != EgoSource::gnss) return std::nullopt;
  const auto poses = gnss_.at(from, to);
  return poses ? std::make_optional(step_between(poses->first, poses->second)) : std::nullopt;
}

void EgoMotion::forget_before(Stamp stamp) {
  poses_.forget_before(stamp);
  odometry_.forget_before(stamp);
  gnss_.forget_before(stamp);
}

}  // namespace lidar_upsampling
