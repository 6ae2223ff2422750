// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// Where the ego-motion comes from. `automatic` takes the first of poses, odometry, gnss that the log
/// offers, else the camera; `none` holds the vehicle still.
enum class EgoSource { automatic, poses, odometry, gnss, camera, none };

[[nodiscard]] EgoSource ego_source_from_string(const std::string& name);
[[nodiscard]] const char* to_string(EgoSource source);

struct EgoMotionOptions {
  EgoSource source = EgoSource::automatic;
  double max_interpolation_gap_s = 1.0;   ///< samples further apart are not joined
  double max_extrapolation_s = 0.25;      ///< past the last sample, at its last velocity; 0: never
  double gnss_min_step_m = 0.3;           ///< heading comes from displacements longer than this
};

/// One known pose of the vehicle.
struct PoseSample {
  Stamp stamp;
  Pose T_world_vehicle = Pose::Identity();
};

/// One position fix: WGS84 degrees, ellipsoidal height in metres, and where the antenna sits.
struct GnssSample {
  Stamp stamp;
  double latitude_deg = 0;
  double longitude_deg = 0;
  double height_m = 0;
  Eigen::Vector3d antenna_in_vehicle = Eigen::Vector3d::Zero();
};

/// What the vehicle did between two instants.
struct EgoStep {
  Pose T_to_from = Pose::Identity();  ///< vehicle frame at `from` to vehicle frame at `to`
  bool extrapolated = false;          ///< one of the instants lies outside the samples
};

/// @brief The vehicle's trajectory, from any number of samples of any kind, added in time order.
class EgoMotion {
 public:
  explicit EgoMotion(const EgoMotionOptions& options = {});

  void add_pose(const PoseSample& sample);
  void add_odometry(const PoseSample& sample);
  void add_gnss(const GnssSample& sample);

  /// The source in use: the option's, or the best that has enough samples so far (two); `camera` when
  /// there is none.
  [[nodiscard]] EgoSource source() const;

  /// @return the motion from one instant to another, none where the samples do not reach: a gap longer
  /// than `max_interpolation_gap_s`, or further outside than `max_extrapolation_s`; and always none
  /// for `EgoSource::camera`.
  [[nodiscard]] std::optional<EgoStep> step(Stamp from, Stamp to) const;

  /// Drops samples that no step from `stamp` on needs.
  void forget_before(Stamp stamp);

 private:
  struct Trajectory;
  EgoMotionOptions options_;
  std::vector<PoseSample> poses_, odometry_, gnss_;
};

}  // namespace lidar_upsampling
