// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/ego/trajectory.h"

#include <algorithm>
#include <stdexcept>

#include "lidar_upsampling/se3.h"

namespace lidar_upsampling {

namespace {

// Long enough to average the jitter of 100 Hz poses, short enough to be the velocity of now.
constexpr double kTwistBaseline = 0.1;

Pose interpolate(const Pose& a, const Pose& b, double share) {
  Pose pose = Pose::Identity();
  pose.translation() = (1 - share) * a.translation() + share * b.translation();
  const Eigen::Quaterniond qa(a.linear()), qb(b.linear());
  pose.linear() = qa.slerp(share, qb).toRotationMatrix();
  return pose;
}

}  // namespace

Reach reach_of(const std::vector<Stamp>& stamps, Stamp stamp, const InterpolationLimits& limits) {
  if (stamps.empty()) {
    return Reach::none;
  }
  const auto next = std::lower_bound(stamps.begin(), stamps.end(), stamp);
  if (next != stamps.end() && *next == stamp) {
    return Reach::inside;
  }
  if (next == stamps.end() || next == stamps.begin()) {
    const double outside = next == stamps.end() ? seconds_between(stamps.back(), stamp)
                                                : seconds_between(stamp, stamps.front());
    const bool reachable = stamps.size() > 1 && outside <= limits.max_extrapolation_s;
    return reachable ? Reach::outside : Reach::none;
  }
  return seconds_between(*std::prev(next), *next) <= limits.max_gap_s ? Reach::inside : Reach::none;
}

Trajectory::Trajectory(const InterpolationLimits& limits) : limits_(limits) {}

void Trajectory::add(const PoseSample& sample) {
  if (!sample.T_world_vehicle.matrix().allFinite()) {
    throw std::invalid_argument("a vehicle pose has a number that is not finite, at stamp " +
                                std::to_string(sample.stamp.time_since_epoch().count()) +
                                " (ticks): check the source of the poses");
  }
  const auto place = std::lower_bound(stamps_.begin(), stamps_.end(), sample.stamp);
  const auto index = place - stamps_.begin();
  if (place != stamps_.end() && *place == sample.stamp) {
    T_world_vehicle_[index] = sample.T_world_vehicle;
    return;
  }
  stamps_.insert(place, sample.stamp);
  T_world_vehicle_.insert(T_world_vehicle_.begin() + index, sample.T_world_vehicle);
}

std::optional<TrajectoryPose> Trajectory::at(Stamp stamp) const {
  const Reach reach = reach_of(stamps_, stamp, limits_);
  if (reach == Reach::none) {
    return std::nullopt;
  }
  if (reach == Reach::outside) {
    const auto pose = extrapolate(stamp);
    return pose ? std::make_optional(TrajectoryPose{*pose, true}) : std::nullopt;
  }
  const auto next = std::lower_bound(stamps_.begin(), stamps_.end(), stamp) - stamps_.begin();
  if (stamps_[next] == stamp) {
    return TrajectoryPose{T_world_vehicle_[next], false};
  }
  const double share =
      seconds_between(stamps_[next - 1], stamp) / seconds_between(stamps_[next - 1], stamps_[next]);
  return TrajectoryPose{interpolate(T_world_vehicle_[next - 1], T_world_vehicle_[next], share),
                        false};
}

std::optional<Pose> Trajectory::extrapolate(Stamp stamp) const {
  const bool forward = stamp > stamps_.back();
  const int step = forward ? -1 : 1;
  const int size = static_cast<int>(stamps_.size());
  const int edge = forward ? size - 1 : 0;
  int other = edge + step;
  const auto span = [&](int i) { return std::abs(seconds_between(stamps_[edge], stamps_[i])); };
  if (span(other) > limits_.max_gap_s) {
    return std::nullopt;
  }
  while (span(other) < kTwistBaseline && other + step >= 0 && other + step < size &&
         span(other + step) <= limits_.max_gap_s) {
    other += step;
  }
  const Pose T_other_edge = T_world_vehicle_[other].inverse() * T_world_vehicle_[edge];
  const Twist rate = log_se3(T_other_edge) / seconds_between(stamps_[other], stamps_[edge]);
  return T_world_vehicle_[edge] * exp_se3(rate * seconds_between(stamps_[edge], stamp));
}

void Trajectory::forget_before(Stamp stamp) {
  const Stamp oldest = shifted(stamp, -limits_.max_gap_s);
  auto keep = std::lower_bound(stamps_.begin(), stamps_.end(), oldest) - stamps_.begin();
  // The last two always stay: extrapolation needs them.
  keep = std::min<std::ptrdiff_t>(
      keep, std::max<std::ptrdiff_t>(0, static_cast<std::ptrdiff_t>(stamps_.size()) - 2));
  stamps_.erase(stamps_.begin(), stamps_.begin() + keep);
  T_world_vehicle_.erase(T_world_vehicle_.begin(), T_world_vehicle_.begin() + keep);
}

}  // namespace lidar_upsampling
