// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include "lidar_upsampling/se3.h"
#include "lidar_upsampling/types.h"

/// What is known of one object's motion over ground: the only place with a motion model.
namespace lidar_upsampling {

/// How road users change their motion, and what is expected of a new one. An acceleration lasts a
/// while (Singer, IEEE Trans. AES 1970; Bar-Shalom et al., Estimation with Applications to Tracking
/// and Navigation, 8.2.3).
struct MotionNoise {
  double unknown_speed_sigma = 20;  ///< m/s per axis, of an object seen for the first time
  double slow_speed_sigma = 2;  ///< m/s, likewise, on foot; and across what it goes along, if so
  double unknown_yaw_rate_sigma = 0.3;  ///< rad/s, likewise
  double acceleration_sigma = 2;        ///< m/s^2 per axis
  double acceleration_time = 2;         ///< s, that it lasts
  double yaw_acceleration = 0.1;        ///< rad^2/s^3
};

/// @brief A step over ground: x and y of the object's centroid (m), and its heading (rad).
struct PlanarStep {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double degrees_of_freedom = 1e6;  ///< that tell the covariance's scale; few: it may be larger
};

/// @brief Density (1/m^2) of a Gaussian in the plane, so far from its mean.
[[nodiscard]] double gaussian_density(const Eigen::Vector2d& astray,
                                      const Eigen::Matrix2d& covariance);

/// @brief The same, of Student's t: the covariance's scale is known by so many degrees of freedom
/// (Lange, Little, Taylor, JASA 1989).
[[nodiscard]] double student_density(const Eigen::Vector2d& astray,
                                     const Eigen::Matrix2d& covariance, double degrees_of_freedom);

/// @brief A Gaussian over (x, y, heading, vx, vy, yaw rate, ax, ay): the step since the scan that
/// last showed the object, velocity, and acceleration but for the curve's own, in the level axes of
/// a frame at rest. m, rad, s.
struct TrackState {
  Stamp stamp;
  Eigen::Matrix<double, 8, 1> mean = Eigen::Matrix<double, 8, 1>::Zero();
  Eigen::Matrix<double, 8, 8> covariance = Eigen::Matrix<double, 8, 8>::Zero();

  [[nodiscard]] PlanarStep step() const {
    return {mean.head<3>(), covariance.topLeftCorner<3, 3>()};
  }
  [[nodiscard]] Eigen::Vector2d velocity() const { return mean.segment<2>(3); }
};

/// Nothing is known of how it moves.
[[nodiscard]] TrackState new_track_state(Stamp stamp, const MotionNoise& noise);

/// @brief The same, but it goes along a direction, either way.
/// @param heading rad.
[[nodiscard]] TrackState going_along(TrackState state, double heading, const MotionNoise& noise);

/// @brief At constant turn rate, with a fading acceleration, but for the noise; nothing changes
/// backwards in time.
[[nodiscard]] TrackState predicted(const TrackState& state, Stamp stamp, const MotionNoise& noise);

/// @brief The state given what has been found of its step.
/// @param before of the step, as it was expected: its covariance is that of the state and of
/// whatever else weighs in between the state and what is seen (the ego-motion's error).
/// @param after of the step, that knowledge included.
[[nodiscard]] TrackState updated(const TrackState& state, const PlanarStep& before,
                                 const PlanarStep& after);

/// @brief The state given a measurement of its step (Kalman). One that is far from what was
/// expected weighs less where its scale is little known, as Student's t has it.
[[nodiscard]] TrackState updated(const TrackState& state, const PlanarStep& measured);

/// @brief The state given what is known of a later one (Rauch, Tung, Striebel, AIAA Journal 1965).
/// @param later at its stamp, with all that is known; steps count from where `state`'s do.
[[nodiscard]] TrackState smoothed(const TrackState& state, const TrackState& later,
                                  const MotionNoise& noise);

/// @brief The state given what is known of its velocity and acceleration.
/// @param known at the same stamp; its step is not looked at.
[[nodiscard]] TrackState with_velocity(const TrackState& state, const TrackState& known);

/// @brief The object has been seen anew: steps count from here.
[[nodiscard]] TrackState from_here(TrackState state);

}  // namespace lidar_upsampling
