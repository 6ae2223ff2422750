// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/img/CImage.h>
#include <mrpt/img/TCamera.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/poses/CPose3D.h>

#include "fuzz/observation_mutations.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling::fuzz {

[[nodiscard]] Stamp odd_stamp(Stamp stamp, Random& random);
[[nodiscard]] mrpt::poses::CPose3D odd_pose(mrpt::poses::CPose3D pose, Random& random);
[[nodiscard]] mrpt::img::CImage odd_picture(Random& random);
void spoil(mrpt::img::TCamera& camera, Random& random);

/// What only its class has. @return whether it is a scan.
[[nodiscard]] bool spoil_scan(mrpt::obs::CObservation& observation, Random& random, Sizes sizes);

}  // namespace lidar_upsampling::fuzz
