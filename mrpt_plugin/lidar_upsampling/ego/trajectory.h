// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <cmath>
#include <iterator>
#include <map>
#include <optional>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// One known pose of the vehicle.
struct PoseSample {
  Stamp stamp;
  Pose T_world_vehicle = Pose::Identity();
};

struct InterpolationLimits {
  double max_gap_s = 1.0;             ///< samples further apart are not joined
  double max_extrapolation_s = 0.25;  ///< outside the samples, at the last (first) velocity
};

enum class Reach { none, inside, outside };

/// Whether a stamp lies between samples, or just outside.
template <typename T>
[[nodiscard]] Reach reach_of(const std::map<Stamp, T>& samples, Stamp stamp,
                             const InterpolationLimits& limits) {
  if (samples.empty()) return Reach::none;
  const auto next = samples.lower_bound(stamp);
  if (next != samples.end() && next->first == stamp) return Reach::inside;
  if (next == samples.end() || next == samples.begin()) {
    const Stamp edge = next == samples.end() ? samples.rbegin()->first : next->first;
    const double outside = std::abs(seconds_between(edge, stamp));
    const bool is_reachable = samples.size() > 1 && outside <= limits.max_extrapolation_s;
    return is_reachable ? Reach::outside : Reach::none;
  }
  const double gap = seconds_between(std::prev(next)->first, next->first);
  return gap <= limits.max_gap_s ? Reach::inside : Reach::none;
}

struct TrajectoryPose {
  Pose T_world_vehicle = Pose::Identity();
  bool extrapolated = false;
};

/// @brief Poses in time order, whatever order they come in.
class Trajectory {
 public:
  explicit Trajectory(const InterpolationLimits& limits = {}) : limits_(limits) {}

  /// A second sample with the same stamp replaces the first.
  /// @throw std::invalid_argument the pose is not is_possible().
  void add(const PoseSample& sample);

  /// @return linear in translation, slerp in rotation; constant body twist outside the samples,
  /// from the last (first) two that lie a tenth of a second apart. None where the limits forbid it.
  [[nodiscard]] std::optional<TrajectoryPose> at(Stamp stamp) const;

  /// Drops samples that no query from `stamp` on needs.
  void forget_before(Stamp stamp);

  [[nodiscard]] std::size_t size() const { return T_world_vehicle_.size(); }

 private:
  [[nodiscard]] std::optional<Pose> extrapolate(Stamp stamp) const;

  InterpolationLimits limits_;
  std::map<Stamp, Pose> T_world_vehicle_;
};

}  // namespace lidar_upsampling
