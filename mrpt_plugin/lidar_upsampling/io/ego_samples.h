// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lidar_upsampling/ego/ego_motion.h"

namespace lidar_upsampling {

/// @brief The position of an observation's GGA message, none without a fix. Its stamp is the
/// satellite time if that agrees with the computer's within a second, else the computer's, as other
/// sensors' are.
[[nodiscard]] std::optional<GnssSample> gnss_sample(const mrpt::obs::CObservationGPS& observation);

/// @brief What is wrong with what an observation tells of the vehicle's motion; none: nothing, or
/// it tells nothing.
[[nodiscard]] std::optional<std::string> ego_defect_of(const mrpt::obs::CObservation& observation);

/// Why an observation's stamp is of no use; none: it is. Differences of useful ones can be told.
[[nodiscard]] std::optional<std::string> stamp_defect_of(
    const mrpt::obs::CObservation& observation);

/// @brief Sums up the vehicle's movements that precede a log's frames.
class ActionOdometry {
 public:
  /// Adds the increment of the best movement estimation; none that leads to no is_possible() pose.
  void add(const mrpt::obs::CActionCollection& actions);
  /// In a world where the first movement began; none before that.
  [[nodiscard]] const std::optional<Pose>& T_world_vehicle() const { return T_world_vehicle_; }

 private:
  std::optional<Pose> T_world_vehicle_;
};

/// Samples of one stream per kind.
struct EgoNews {
  std::vector<PoseSample> poses, odometry;
  std::vector<GnssSample> gnss;
};

/// @brief Gathers what a log tells of the vehicle's motion. Streams of different labels may use
/// different worlds, so they are kept apart, and the one with the most samples is given out. What
/// has an ego_defect_of() is passed over.
class EgoSamples {
 public:
  void add_observation(const mrpt::obs::CObservation& observation);
  /// Adds the increment of the best movement estimation to the pose of the next frame.
  void add_actions(const mrpt::obs::CActionCollection& actions);
  /// Stamps the pose reached so far with the first observation's time.
  void add_frame(const mrpt::obs::CSensoryFrame& frame);

  [[nodiscard]] std::vector<PoseSample> poses() const;
  [[nodiscard]] std::vector<PoseSample> odometry() const;
  [[nodiscard]] std::vector<GnssSample> gnss() const;

  /// What has come since the last call, for a log that is used while it is read: of each kind the
  /// stream that had the most samples at the first call that found any stays the one.
  [[nodiscard]] EgoNews take();

 private:
  std::map<std::string, std::vector<PoseSample>> poses_;
  std::map<std::string, std::vector<PoseSample>> odometry_;
  std::map<std::string, std::vector<GnssSample>> gnss_;
  std::vector<PoseSample> from_actions_;
  ActionOdometry actions_;
  std::optional<std::string> taken_poses_, taken_odometry_, taken_gnss_;  // labels
  bool takes_actions_ = false;
};

}  // namespace lidar_upsampling
