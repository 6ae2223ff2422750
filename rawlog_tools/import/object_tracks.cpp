// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "import/object_tracks.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

namespace lidar_upsampling::importing {
namespace {

constexpr double kSlowestMoving = 0.5;  // m/s
constexpr double kMovingWindow = 0.5;   // s, to either side
constexpr InterpolationLimits kLabelLimits{0.35, 0.06};

double yaw_of(const Pose& T) { return std::atan2(T.linear()(1, 0), T.linear()(0, 0)); }

// The labels about one of them, as far as `reach` goes.
std::vector<ObjectPose> labels_about(const ObjectTrack& track, std::size_t index, double reach_s) {
  constexpr double kRoom = 1e-3;  // s; the fit is the one to say who lies on the edge
  const auto& poses = track.poses;
  const Stamp stamp = poses[index].stamp;
  const auto earlier = [](const ObjectPose& pose, Stamp limit) { return pose.stamp < limit; };
  const auto first =
      std::lower_bound(poses.begin(), poses.end(), shifted(stamp, -reach_s - kRoom), earlier);
  return {first, std::lower_bound(first, poses.end(), shifted(stamp, reach_s + kRoom), earlier)};
}

std::vector<LabelledPosition> positions_of(const std::vector<ObjectPose>& poses) {
  std::vector<LabelledPosition> positions;
  for (const ObjectPose& pose : poses) {
    positions.push_back({pose.stamp, pose.T_world_object.translation()});
  }
  return positions;
}

// The yaw as a first coordinate, without its jump from pi to -pi.
std::vector<LabelledPosition> yaws_of(const std::vector<ObjectPose>& poses) {
  std::vector<LabelledPosition> yaws;
  double yaw = poses.empty() ? 0 : yaw_of(poses.front().T_world_object);
  for (const ObjectPose& pose : poses) {
    yaw += std::remainder(yaw_of(pose.T_world_object) - yaw, 2 * M_PI);
    yaws.push_back({pose.stamp, {yaw, 0, 0}});
  }
  return yaws;
}

}  // namespace

LabelWindow label_window_of(const std::vector<ObjectTrack>& tracks) {
  std::vector<Stamp> stamps;
  for (const ObjectTrack& track : tracks) {
    for (const ObjectPose& pose : track.poses) stamps.push_back(pose.stamp);
  }
  return label_window(std::move(stamps));
}

std::optional<ObjectVelocity> velocity_at(const ObjectTrack& track, std::size_t index,
                                          const LabelWindow& window) {
  const Stamp stamp = track.poses[index].stamp;
  const std::vector<ObjectPose> near = labels_about(track, index, window.half_width_s);
  const auto linear = fit_velocity(positions_of(near), stamp, window);
  const auto turn = fit_velocity(yaws_of(near), stamp, window);
  if (!linear || !turn) return std::nullopt;
  return ObjectVelocity{linear->velocity, turn->velocity.x()};
}

bool moves_at(const ObjectTrack& track, std::size_t index, const LabelWindow& window) {
  LabelWindow wide = window;
  wide.half_width_s = std::max(wide.half_width_s, kMovingWindow);
  const auto labels = positions_of(labels_about(track, index, wide.half_width_s));
  const auto mean = fit_velocity(labels, track.poses[index].stamp, wide);
  return mean && mean->velocity.norm() > kSlowestMoving;
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
