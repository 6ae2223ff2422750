// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/img/TCamera.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/poses/CPose3D.h>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

[[nodiscard]] Pose from_mrpt(const mrpt::poses::CPose3D& pose);
[[nodiscard]] mrpt::poses::CPose3D to_mrpt(const Pose& pose);
[[nodiscard]] CameraModel from_mrpt(const mrpt::img::TCamera& camera);
[[nodiscard]] mrpt::img::TCamera to_mrpt(const CameraModel& model);

/// @brief The intrinsics for pictures of another size, unchanged if the model has no size yet.
[[nodiscard]] CameraModel scaled(const CameraModel& model, int width, int height);

/// Whether intrinsics are there: positive focal lengths, and a principal point inside the picture.
[[nodiscard]] bool is_calibrated(const CameraModel& model);

/// @brief The camera that an image observation describes (label, intrinsics, T_vehicle_camera),
/// without loading any pixel.
[[nodiscard]] Camera camera_of(const mrpt::obs::CObservationImage& observation);

/// @brief The picture of an observation, loaded from external storage where it lies there (and
/// unloaded again, so that the observation is written back as it was). The intrinsics are scaled if
/// the picture's size differs from the calibration's.
/// @throw std::runtime_error naming label, stamp and file: missing, or no picture.
[[nodiscard]] CameraImage image_from_observation(const mrpt::obs::CObservationImage& observation);

/// @brief A gray or colour picture with its calibration, as a stock observation.
[[nodiscard]] mrpt::obs::CObservationImage::Ptr observation_from_image(const CameraImage& image);

}  // namespace lidar_upsampling
