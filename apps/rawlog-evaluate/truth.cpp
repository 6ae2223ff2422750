// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "truth.h"

#include <algorithm>
#include <cmath>

namespace lidar_upsampling {

namespace {

constexpr double kLongestGap_s = 0.6;  // labels come at 2 Hz or more; further apart, one is missing
constexpr double kBeyondLabels_s = 0.06;  // a picture lies this far from its labelled scan at most

std::optional<Pose> lidar_in_world(const Truth& truth, const LidarScan& scan, Stamp stamp) {
  const auto vehicle = truth.T_world_vehicle.at(stamp);
  if (!vehicle) return std::nullopt;
  return vehicle->T_world_vehicle * scan.T_vehicle_lidar;
}

/// Of the point nearest to a place, seconds from the scan's stamp.
double time_of_nearest(const LidarScan& scan, const Eigen::Vector3d& place) {
  const auto sq_distance = [&](const Eigen::Vector3f& point) {
    return (point - place.cast<float>()).squaredNorm();
  };
  const auto nearest = std::min_element(
      scan.points.begin(), scan.points.end(),
      [&](const auto& a, const auto& b) { return sq_distance(a) < sq_distance(b); });
  return nearest == scan.points.end() ? 0 : scan.time_s[nearest - scan.points.begin()];
}

// T_object_lidar of an object at an instant, of the lidar at the scan's stamp.
std::optional<Pose> box_at(const Truth& truth, const TrueObject& object, const LidarScan& scan,
                           Stamp instant) {
  const auto box = object.T_world_object.at(instant);
  const auto lidar = lidar_in_world(truth, scan, scan.stamp);
  if (!box || !lidar) return std::nullopt;
  return box->T_world_vehicle.inverse() * *lidar;
}

/// T_lidar_t_lidar_k of an object. @param T_object_lidar when the scan saw it.
std::optional<Pose> motion_since(const Pose& T_object_lidar, const Truth& truth,
                                 const TrueObject& object, const LidarScan& scan, Stamp stamp) {
  const auto at_t = object.T_world_object.at(stamp);
  const auto lidar_t = lidar_in_world(truth, scan, stamp);
  if (!at_t || !lidar_t) return std::nullopt;
  return lidar_t->inverse() * at_t->T_world_vehicle * T_object_lidar;
}

template <typename Value>
Value nearest(const std::map<Stamp, Value>& told, Stamp stamp, Value if_none) {
  if (told.empty()) return if_none;
  const auto next = told.lower_bound(stamp);
  if (next == told.begin()) return next->second;
  const auto before = std::prev(next);
  if (next == told.end()) return before->second;
  return next->first - stamp < stamp - before->first ? next->second : before->second;
}

}  // namespace

bool TrueObject::moves_at(Stamp stamp) const { return nearest(moving, stamp, false); }

double TrueObject::yaw_rate_at(Stamp stamp) const { return nearest(yaw_rate, stamp, 0.); }

std::optional<Eigen::Vector3d> TrueObject::velocity_at(Stamp stamp) const {
  const auto next = velocity.lower_bound(stamp);
  const auto apart = [stamp](const auto& label) {
    return std::abs(seconds_between(label->first, stamp));
  };
  if (next != velocity.end() && next != velocity.begin()) {
    const auto before = std::prev(next);
    const double gap = seconds_between(before->first, next->first);
    if (gap <= kLongestGap_s)
      return before->second + apart(before) / gap * (next->second - before->second);
  }
  if (next != velocity.end() && apart(next) <= kBeyondLabels_s) return next->second;
  if (next != velocity.begin() && apart(std::prev(next)) <= kBeyondLabels_s)
    return std::prev(next)->second;
  return std::nullopt;
}

std::optional<Pose> true_ego_motion(const Truth& truth, const LidarScan& key, Stamp stamp) {
  const auto k = lidar_in_world(truth, key, key.stamp), t = lidar_in_world(truth, key, stamp);
  if (!k || !t) return std::nullopt;
  return t->inverse() * *k;
}

std::optional<Pose> true_object_motion(const Truth& truth, const TrueObject& object,
                                       const LidarScan& key, Stamp stamp) {
  const auto T_box_lidar = box_as_seen(truth, object, key);
  if (!T_box_lidar) return std::nullopt;
  return motion_since(*T_box_lidar, truth, object, key, stamp);
}

LidarScan brought_to(const Truth& truth, const LidarScan& scan, Stamp stamp) {
  LidarScan moved = scan;
  const auto T_ego = true_ego_motion(truth, scan, stamp);
  if (!T_ego || (stamp == scan.stamp && scan.time_s.empty())) return moved;
  moved.stamp = stamp;
  for (auto& point : moved.points) point = (*T_ego * point.cast<double>()).cast<float>();
  for (const TrueObject& object : truth.objects) {
    const auto T_box_lidar = box_as_seen(truth, object, scan);
    if (!T_box_lidar) continue;
    const auto T_object = motion_since(*T_box_lidar, truth, object, scan, stamp);
    if (!T_object) continue;
    for (std::size_t i = 0; i < scan.size(); ++i) {
      const Eigen::Vector3d point = scan.points[i].cast<double>();
      if (((*T_box_lidar * point).array().abs() < 0.5 * object.size.array()).all())
        moved.points[i] = (*T_object * point).cast<float>();
    }
  }
  return moved;
}

std::optional<Pose> box_in_scan(const Truth& truth, const TrueObject& object,
                                const LidarScan& key) {
  return box_at(truth, object, key, key.stamp);
}

std::optional<Pose> box_as_seen(const Truth& truth, const TrueObject& object,
                                const LidarScan& key) {
  const auto at_stamp = box_in_scan(truth, object, key);
  if (!at_stamp || key.time_s.empty()) return at_stamp;
  const double time = time_of_nearest(key, at_stamp->inverse().translation());
  return box_at(truth, object, key, shifted(key.stamp, time));
}

}  // namespace lidar_upsampling
