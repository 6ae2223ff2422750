// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "import/object_tracks.h"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace lidar_upsampling::importing {
namespace {

constexpr double kSlowestMoving = 0.5;  // m/s
constexpr double kMovingWindow = 0.5;   // s, to either side
constexpr InterpolationLimits kLabelLimits{0.35, 0.06};

double yaw_of(const Pose& T) { return std::atan2(T.linear()(1, 0), T.linear()(0, 0)); }

bool moves_about(const ObjectTrack& track, std::size_t index) {
  const auto& poses = track.poses;
  std::size_t from = index, to = index;
  const auto near = [&](std::size_t i) {
    // Half a tick of room for stamps that are exactly the window away.
    return std::abs(seconds_between(poses[index].stamp, poses[i].stamp)) < kMovingWindow + 5e-8;
  };
  while (from > 0 && near(from - 1)) --from;
  while (to + 1 < poses.size() && near(to + 1)) ++to;
  const double dt = seconds_between(poses[from].stamp, poses[to].stamp);
  const Eigen::Vector3d step =
      poses[to].T_world_object.translation() - poses[from].T_world_object.translation();
  return step.norm() > kSlowestMoving * dt;
}

}  // namespace

ObjectVelocity velocity_at(const ObjectTrack& track, std::size_t index) {
  const auto& poses = track.poses;
  const ObjectPose& a = poses[index == 0 ? 0 : index - 1];
  const ObjectPose& b = poses[std::min(index + 1, poses.size() - 1)];
  const double dt = seconds_between(a.stamp, b.stamp);
  if (dt <= 0) return {};
  ObjectVelocity velocity;
  velocity.linear = (b.T_world_object.translation() - a.T_world_object.translation()) / dt;
  velocity.yaw_rate =
      std::remainder(yaw_of(b.T_world_object) - yaw_of(a.T_world_object), 2 * M_PI) / dt;
  velocity.moves = moves_about(track, index);
  return velocity;
}

TrackInterpolator::TrackInterpolator(const ObjectTrack& track)
    : track_(track), trajectory_(kLabelLimits) {
  for (const ObjectPose& pose : track.poses) trajectory_.add({pose.stamp, pose.T_world_object});
}

std::optional<Pose> TrackInterpolator::T_world_object(Stamp stamp) const {
  const auto pose = trajectory_.at(stamp);
  if (!pose || hidden_at(stamp)) return std::nullopt;
  return pose->T_world_vehicle;
}

bool TrackInterpolator::hidden_at(Stamp stamp) const {
  const auto nearest = std::min_element(track_.poses.begin(), track_.poses.end(),
                                        [&](const ObjectPose& a, const ObjectPose& b) {
                                          return std::abs(seconds_between(a.stamp, stamp)) <
                                                 std::abs(seconds_between(b.stamp, stamp));
                                        });
  return nearest->hidden;
}

std::string class_name_from(const std::string& label) {
  std::string name;
  for (const char c : label) {
    name += c == ',' ? ' ' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return name;
}

}  // namespace lidar_upsampling::importing
