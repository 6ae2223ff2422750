// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include "simulator/world.h"

namespace lidar_upsampling::sim {

/// @brief Where the log says that a camera is mounted: off its true place by the spec's angle and
/// distance, about an axis and in a direction that seed and label draw. T_vehicle_camera.
[[nodiscard]] Pose told_mounting(const CameraSpec& spec, std::uint32_t seed);

/// @brief The stamp that a picture gets in the log: its own, off by what the camera's clock jitters
/// (Gaussian, cut at three sigma), and within the log's time.
/// @param stamp the regular one, which tells when it was taken.
[[nodiscard]] Stamp told_stamp(const CameraSpec& spec, Stamp stamp, double duration_s,
                               std::uint32_t seed);

/// @brief What a receiver for RTK with an IMU says at `stamp` of the vehicle's pose: the true one
/// of `lag_s` ago, off by `noise_m` along each axis of the world and by `noise_rad` about each axis
/// of the vehicle (sigmas). Nine tenths of the noise's variance drift within a second or two, the
/// rest is new in each pose.
[[nodiscard]] Pose told_ego_pose(const World& world, const EgoPoseSpec& spec, Stamp stamp,
                                 std::uint32_t seed);

}  // namespace lidar_upsampling::sim
