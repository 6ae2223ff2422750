// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/ego/trajectory.h"

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

void Trajectory::add(const PoseSample& sample) {
  if (!is_possible(sample.T_world_vehicle))
    throw std::invalid_argument(
        "a vehicle pose has a number that is not finite, or beyond 1e8 m, at stamp " +
        std::to_string(sample.stamp.time_since_epoch().count()) +
        " (ticks): check the source of the poses");
  T_world_vehicle_[sample.stamp] = sample.T_world_vehicle;
}

std::optional<TrajectoryPose> Trajectory::at(Stamp stamp) const {
  const Reach reach = reach_of(T_world_vehicle_, stamp, limits_);
  if (reach == Reach::none) return std::nullopt;
  if (reach == Reach::outside) {
    const auto pose = extrapolate(stamp);
    return pose ? std::make_optional(TrajectoryPose{*pose, true}) : std::nullopt;
  }
  const auto next = T_world_vehicle_.lower_bound(stamp);
  if (next->first == stamp) return TrajectoryPose{next->second, false};
  const auto before = std::prev(next);
  const double share =
      seconds_between(before->first, stamp) / seconds_between(before->first, next->first);
  return TrajectoryPose{interpolate(before->second, next->second, share), false};
}

std::optional<Pose> Trajectory::extrapolate(Stamp stamp) const {
  const auto first = T_world_vehicle_.begin(), last = std::prev(T_world_vehicle_.end());
  const bool forward = stamp > last->first;
  const auto edge = forward ? last : first;
  const auto inwards = [&](auto it) { return forward ? std::prev(it) : std::next(it); };
  const auto span = [&](auto it) { return std::abs(seconds_between(edge->first, it->first)); };
  auto other = inwards(edge);
  if (span(other) > limits_.max_gap_s) return std::nullopt;
  while (span(other) < kTwistBaseline && other != (forward ? first : last) &&
         span(inwards(other)) <= limits_.max_gap_s)
    other = inwards(other);
  const Pose T_other_edge = other->second.inverse() * edge->second;
  const Twist rate = log_se3(T_other_edge) / seconds_between(other->first, edge->first);
  return edge->second * exp_se3(rate * seconds_between(edge->first, stamp));
}

void Trajectory::forget_before(Stamp stamp) {
  const Stamp oldest = shifted(stamp, -limits_.max_gap_s);
  while (T_world_vehicle_.size() > 2 && T_world_vehicle_.begin()->first < oldest)
    T_world_vehicle_.erase(T_world_vehicle_.begin());  // extrapolation needs two
}

}  // namespace lidar_upsampling
