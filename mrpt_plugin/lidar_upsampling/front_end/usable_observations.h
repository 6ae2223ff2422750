// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/obs/CObservationImage.h>

#include <functional>
#include <map>
#include <optional>
#include <string>

#include "lidar_upsampling/io/rig_overrides.h"
#include "lidar_upsampling/scan/sweep.h"

namespace lidar_upsampling {

/// @brief What there is to say of observations that are not used, and of how many more of them.
/// All of one kind and sensor have one text, which tells of the first one.
using TellUnused = std::function<void(const std::string& text)>;

/// Such texts, and how many observations each is about.
using UnusedCounts = std::map<std::string, std::size_t>;

[[nodiscard]] inline TellUnused counted_in(UnusedCounts& counts) {
  return [&counts](const std::string& text) { ++counts[text]; };
}

/// "3x: text".
[[nodiscard]] std::string to_text(const UnusedCounts::value_type& count);

/// @brief What of a log's or of live sensors' observations can be used: the one rule for all that
/// the method is fed with. A bad observation is passed on as it came, is not used, and is counted
/// by its kind.
class UsableObservations {
 public:
  /// Of observations as they are in the log, at the instants of their stamps.
  explicit UsableObservations(TellUnused tell = nullptr);
  /// @param rig, sweep must outlive this. @param tell may be null.
  UsableObservations(const RigOverrides& rig, const SweepOptions& sweep, TellUnused tell = nullptr)
      : rig_(rig), sweep_(sweep), tell_(std::move(tell)) {}

  /// @brief Its points, at the pose in force, if it has a stamp, a finite pose and points. With
  /// ScanTime::points or as_told, without those that have no time of their own.
  [[nodiscard]] std::optional<LidarScan> scan(const mrpt::obs::CObservation& observation);

  /// @brief Its picture, with the calibration in force, if it has a stamp, a picture of the size of
  /// the camera's first one, and finite numbers for a calibration.
  [[nodiscard]] std::optional<CameraImage> image(const mrpt::obs::CObservationImage& observation);

  /// @return whether there is nothing wrong with what it tells of the vehicle's motion, if it does.
  bool ego(const mrpt::obs::CObservation& observation);

 private:
  std::nullopt_t refuse(const mrpt::obs::CObservation& observation, const std::string& kind,
                        const std::string& more = {});

  const RigOverrides& rig_;
  const SweepOptions& sweep_;
  TellUnused tell_;
  std::map<std::string, cv::Size> picture_size_;  ///< by label
  std::map<std::string, std::string> texts_;      ///< by label and kind
};

}  // namespace lidar_upsampling
