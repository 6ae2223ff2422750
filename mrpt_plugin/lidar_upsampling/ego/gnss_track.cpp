// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/ego/gnss_track.h"

#include <GeographicLib/LocalCartesian.hpp>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <vector>

namespace lidar_upsampling {

namespace {

constexpr double kNoiseWindow = 5.0;  ///< s to either side, over which the scatter is judged
constexpr double kMemory = 12.0;      ///< s; a fit's widest reach and the scatter's

struct Course {
  double heading, yaw_rate;
};

// Which way the vehicle's origin goes: an antenna ahead of it swings out in a turn.
Course course_of(const Eigen::Vector3d& velocity, const Eigen::Vector3d& acceleration,
                 const Eigen::Vector3d& antenna_in_vehicle) {
  const double speed = std::max(1e-3, velocity.head<2>().norm());
  const double yaw_rate =
      (velocity.x() * acceleration.y() - velocity.y() * acceleration.x()) / (speed * speed);
  const double slip = std::clamp(yaw_rate * antenna_in_vehicle.x() / speed, -0.9, 0.9);
  return {std::atan2(velocity.y(), velocity.x()) - std::asin(slip), yaw_rate};
}

void check(const GnssSample& sample) {
  if (!is_on_globe(sample)) {
    throw std::invalid_argument("a GNSS fix lies off the globe: latitude " +
                                std::to_string(sample.latitude_deg) + ", longitude " +
                                std::to_string(sample.longitude_deg) + ", height " +
                                std::to_string(sample.height_m));
  }
}

}  // namespace

/// Antenna position, velocity and acceleration at `center`.
struct GnssTrack::LocalFit {
  Stamp center, last;
  Eigen::Vector3d position, velocity, acceleration;
  double duration = 0;        ///< of the fixes that went in
  double velocity_sigma = 0;  ///< m/s, per axis
  bool moving = false;
};

GnssTrack::GnssTrack(const InterpolationLimits& limits, double min_step_m)
    : limits_(limits), min_step_m_(min_step_m) {}

void GnssTrack::add(const GnssSample& sample) {
  check(sample);
  if (!world_) {
    world_ = std::make_shared<const GeographicLib::LocalCartesian>(
        sample.latitude_deg, sample.longitude_deg, sample.height_m);
  }
  Eigen::Vector3d position;
  world_->Forward(sample.latitude_deg, sample.longitude_deg, sample.height_m, position.x(),
                  position.y(), position.z());
  antenna_in_vehicle_ = sample.antenna_in_vehicle;
  antenna_in_world_[sample.stamp] = position;
}

double GnssTrack::half_window(Stamp center) const {
  const auto& fixes = antenna_in_world_;
  const auto begin = fixes.lower_bound(shifted(center, -kNoiseWindow));
  const auto end = fixes.upper_bound(shifted(center, kNoiseWindow));
  std::vector<double> residuals;
  for (auto at = begin; at != end; ++at) {
    const auto after = std::next(at);
    if (at == begin || after == end) continue;
    const auto before = std::prev(at);
    const double share =
        seconds_between(before->first, at->first) / seconds_between(before->first, after->first);
    const Eigen::Vector3d middle = (1 - share) * before->second + share * after->second;
    residuals.push_back((at->second - middle).head<2>().norm());
  }
  // Median of a Rayleigh variable; three fixes' noise goes into each residual.
  const double sigma =
      residuals.empty() ? 0.1 : median(std::move(residuals)) / 1.1774 / std::sqrt(1.5);
  // Balances scatter against what a parabola cannot follow of a car's path.
  return std::clamp(2.5 * std::pow(sigma, 0.35), 0.4, 3.0);
}

GnssTrack::LocalFit GnssTrack::fit(Stamp center, double half_span, double half_window) const {
  const double reach = half_span + half_window;
  const auto& fixes = antenna_in_world_;
  auto begin = fixes.lower_bound(shifted(center, -reach));
  auto end = fixes.upper_bound(shifted(center, reach));
  while (std::distance(begin, end) < 3 && (begin != fixes.begin() || end != fixes.end())) {
    if (begin != fixes.begin()) --begin;
    if (end != fixes.end()) ++end;
  }
  const auto num_fixes = std::distance(begin, end);
  const int degree = num_fixes < 4 ? 1 : 2;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (auto it = begin; it != end; ++it) {
    const double t = seconds_between(center, it->first);
    const double beyond = std::max(0., std::abs(t) - half_span) / half_window;
    const double weight = std::max(0.02, 1 - beyond * beyond);
    const Eigen::Vector3d row(1, t, degree == 2 ? 0.5 * t * t : 0);
    normal += weight * row * row.transpose();
    moments += weight * row * it->second.transpose();
  }
  if (degree == 1) normal(2, 2) = 1;
  const Eigen::Matrix3d inverse = normal.inverse();
  const Eigen::Matrix3d solution = inverse * moments;
  LocalFit result{center, std::prev(end)->first, solution.row(0), solution.row(1), solution.row(2)};
  double sum = 0;
  for (auto it = begin; it != end; ++it) {
    const double t = seconds_between(center, it->first);
    const Eigen::Vector3d predicted =
        result.position + t * result.velocity + 0.5 * t * t * result.acceleration;
    sum += (it->second - predicted).head<2>().squaredNorm();
  }
  const double variance =
      sum / std::max<double>(1, 2. * static_cast<double>(num_fixes - degree - 1));
  result.duration = seconds_between(begin->first, result.last);
  result.velocity_sigma = std::sqrt(variance * std::max(0., inverse(1, 1)));
  const double speed = result.velocity.head<2>().norm();
  result.moving = speed * result.duration > min_step_m_ && speed > 4 * result.velocity_sigma;
  return result;
}

std::optional<double> GnssTrack::course(Stamp center) const {
  // A slow vehicle takes a longer look to move by a step.
  const double narrow = half_window(center);
  for (const int widening : {1, 2, 4}) {
    const LocalFit local = fit(center, 0, widening * narrow);
    if (local.moving)
      return course_of(local.velocity, local.acceleration, antenna_in_vehicle_).heading;
  }
  return std::nullopt;
}

double GnssTrack::held_heading(Stamp stamp) const {
  constexpr double kStride_s = 0.5;  // where there are fixes: a wrong one may lie centuries away
  const auto& fixes = antenna_in_world_;
  const Stamp first = fixes.begin()->first, last = fixes.rbegin()->first;
  for (Stamp t = std::min(stamp, last); t >= first;) {
    if (const auto heading = course(t)) return *heading;
    t = std::min(shifted(t, -kStride_s), std::prev(fixes.upper_bound(t))->first);
  }
  if (forgotten_heading_) return *forgotten_heading_;
  for (Stamp t = std::max(stamp, first); t <= last;) {
    if (const auto heading = course(t)) return *heading;
    t = std::max(shifted(t, kStride_s), fixes.lower_bound(t)->first);
  }
  return 0;
}

Pose GnssTrack::pose_of(const LocalFit& local, Stamp stamp) const {
  // Past the last fix the parabola would run away: constant velocity and yaw rate from there.
  const double t = seconds_between(local.center, std::min(stamp, local.last));
  const double beyond = seconds_between(local.center, stamp) - t;
  const Eigen::Vector3d velocity = local.velocity + t * local.acceleration;
  Eigen::Vector3d position =
      local.position + t * local.velocity + 0.5 * t * t * local.acceleration + beyond * velocity;
  double heading = 0;
  if (local.moving) {
    const Course there = course_of(velocity, local.acceleration, antenna_in_vehicle_);
    heading = there.heading + beyond * there.yaw_rate;
  } else {
    heading = held_heading(local.center);
  }
  Pose pose = Pose::Identity();
  pose.linear() = Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  pose.translation() = position - pose.linear() * antenna_in_vehicle_;
  return pose;
}

std::optional<std::pair<TrajectoryPose, TrajectoryPose>> GnssTrack::at(Stamp from, Stamp to) const {
  const Reach reach_from = reach_of(antenna_in_world_, from, limits_);
  const Reach reach_to = reach_of(antenna_in_world_, to, limits_);
  if (size() < 2 || reach_from == Reach::none || reach_to == Reach::none) {
    return std::nullopt;
  }
  const double dt = seconds_between(from, to);
  const Stamp middle = shifted(from, 0.5 * dt);
  const double window = half_window(middle);
  // One fit for both ends: its error moves them together and leaves the step between them alone.
  const bool is_joint = std::abs(dt) <= 2 * window;
  const LocalFit at_from =
      is_joint ? fit(middle, 0.5 * std::abs(dt), window) : fit(from, 0, window);
  const LocalFit at_to = is_joint ? at_from : fit(to, 0, window);
  return std::make_pair(TrajectoryPose{pose_of(at_from, from), reach_from == Reach::outside},
                        TrajectoryPose{pose_of(at_to, to), reach_to == Reach::outside});
}

void GnssTrack::forget_before(Stamp stamp) {
  constexpr int kLast = 4;  // stay in any case
  auto& fixes = antenna_in_world_;
  if (fixes.size() <= kLast) return;
  const Stamp oldest = std::min(shifted(stamp, -kMemory), std::prev(fixes.end(), kLast)->first);
  const auto keep = fixes.lower_bound(oldest);
  if (keep == fixes.begin()) return;
  if (const auto heading = course(keep->first)) forgotten_heading_ = heading;
  fixes.erase(fixes.begin(), keep);
}

}  // namespace lidar_upsampling
