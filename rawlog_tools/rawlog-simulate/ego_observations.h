// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservation.h>

#include "simulator/world.h"

namespace lidar_upsampling::sim {

/// The vehicle's exact pose, as a CObservationRobotPose.
[[nodiscard]] mrpt::obs::CObservation::Ptr pose_observation(const World& world,
                                                            const std::string& label, Stamp stamp);

/// What the scenario's ego_poses say of the vehicle at an instant: a pose, the wheels' odometry
/// (2D, from where the log starts), or a GNSS fix (GGA); null for `none`. Late and off as the spec
/// says, by the seed.
[[nodiscard]] mrpt::obs::CObservation::Ptr ego_observation(const World& world,
                                                           const EgoPoseSpec& spec, Stamp stamp,
                                                           std::uint32_t seed);

/// The movement between two instants, as wheels measure it.
[[nodiscard]] mrpt::obs::CActionCollection movement(const World& world, Stamp from, Stamp to);

}  // namespace lidar_upsampling::sim
