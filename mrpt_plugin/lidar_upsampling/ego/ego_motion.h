// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <optional>

#include "lidar_upsampling/ego/gnss_track.h"
#include "lidar_upsampling/ego/trajectory.h"
#include "lidar_upsampling/se3.h"

namespace lidar_upsampling {

/// Where the ego-motion comes from. `automatic` takes the first of poses, odometry, gnss that the
/// log offers, else the camera; `none` holds the vehicle still.
enum class EgoSource { automatic, poses, odometry, gnss, camera, none };

/// "auto", "poses", "odometry", "gnss", "camera", "none".
[[nodiscard]] const char* to_string(EgoSource source);

struct EgoMotionOptions {
  EgoSource source = EgoSource::automatic;
  bool fuse = true;  ///< with `automatic`, given poses are measurements among others
  double max_interpolation_gap_s = 1.0;  ///< samples further apart are not joined
  double max_extrapolation_s = 0.25;     ///< outside the samples, at the last velocity; 0: never
  double gnss_min_step_m = 0.3;          ///< heading comes from displacements longer than this
};

/// What the vehicle did between two instants.
struct EgoStep {
  Pose T_to_from = Pose::Identity();  ///< vehicle frame at `from` to vehicle frame at `to`
  bool extrapolated = false;          ///< one of the instants lies outside the samples
  /// Of a left increment (w, t), rad and m, in the frame at `to`; zero: taken for exact.
  Matrix6d covariance = Matrix6d::Zero();
};

/// @brief The vehicle's trajectory, from any number of samples of any kind. Late samples are sorted
/// in; of two with the same stamp the later one counts.
class EgoMotion {
 public:
  explicit EgoMotion(const EgoMotionOptions& options = {});

  /// @throw std::invalid_argument, here and below: a number that is not finite, or a fix off the
  /// globe.
  void add_pose(const PoseSample& sample) { poses_.add(sample); }
  void add_odometry(const PoseSample& sample) { odometry_.add(sample); }
  void add_gnss(const GnssSample& sample) { gnss_.add(sample); }

  /// The source in use: the option's, or the best that has enough samples so far (two); `camera`
  /// when there is none.
  [[nodiscard]] EgoSource source() const;

  /// @return the motion from one instant to another, none where the samples do not reach: a gap
  /// longer than `max_interpolation_gap_s`, or further outside than `max_extrapolation_s`; and
  /// always none for `EgoSource::camera`. The identity for `EgoSource::none`.
  [[nodiscard]] std::optional<EgoStep> step(Stamp from, Stamp to) const;

  /// Whether given steps are to be joined with what scans and images tell, rather than taken at
  /// their word.
  [[nodiscard]] bool fuses() const {
    return options_.source == EgoSource::automatic && options_.fuse;
  }

  /// Drops samples that no step from `stamp` on needs.
  void forget_before(Stamp stamp);

 private:
  EgoMotionOptions options_;
  Trajectory poses_, odometry_;
  GnssTrack gnss_;
};

}  // namespace lidar_upsampling
