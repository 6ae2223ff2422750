// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/ego/gnss_track.h"

#include <GeographicLib/LocalCartesian.hpp>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace lidar_upsampling {

namespace {

constexpr double kNoiseWindow = 5.0;  ///< s to either side, over which the scatter is judged
constexpr double kMemory = 12.0;      ///< s; a fit's widest reach and the scatter's

void check(const GnssSample& sample) {
  const bool sane = std::abs(sample.latitude_deg) <= 90 && std::abs(sample.longitude_deg) <= 540 &&
                    std::isfinite(sample.height_m) && sample.antenna_in_vehicle.allFinite();
  if (!sane) {
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
  const auto place = std::lower_bound(stamps_.begin(), stamps_.end(), sample.stamp);
  const auto index = place - stamps_.begin();
  if (place != stamps_.end() && *place == sample.stamp) {
    antenna_in_world_[index] = position;
    return;
  }
  stamps_.insert(place, sample.stamp);
  antenna_in_world_.insert(antenna_in_world_.begin() + index, position);
}

double GnssTrack::half_window(Stamp center) const {
  const auto begin =
      std::lower_bound(stamps_.begin(), stamps_.end(), shifted(center, -kNoiseWindow));
  const auto end = std::upper_bound(begin, stamps_.end(), shifted(center, kNoiseWindow));
  std::vector<double> residuals;
  for (auto i = begin - stamps_.begin() + 1; i + 1 < end - stamps_.begin(); ++i) {
    const double share = seconds_between(stamps_[i - 1], stamps_[i]) /
                         seconds_between(stamps_[i - 1], stamps_[i + 1]);
    const Eigen::Vector3d middle =
        (1 - share) * antenna_in_world_[i - 1] + share * antenna_in_world_[i + 1];
    residuals.push_back((antenna_in_world_[i] - middle).head<2>().norm());
  }
  // Median of a Rayleigh variable; three fixes' noise goes into each residual.
  const double sigma =
      residuals.empty() ? 0.1 : median(std::move(residuals)) / 1.1774 / std::sqrt(1.5);
  // Balances scatter against what a parabola cannot follow of a car's path.
  return std::clamp(2.5 * std::pow(sigma, 0.35), 0.4, 3.0);
}

GnssTrack::LocalFit GnssTrack::fit(Stamp center, double half_span, double half_window) const {
  const double reach = half_span + half_window;
  auto begin = std::lower_bound(stamps_.begin(), stamps_.end(), shifted(center, -reach));
  auto end = std::upper_bound(begin, stamps_.end(), shifted(center, reach));
  while (end - begin < 3 && (begin != stamps_.begin() || end != stamps_.end())) {
    begin -= begin != stamps_.begin() ? 1 : 0;
    end += end != stamps_.end() ? 1 : 0;
  }
  const int degree = end - begin < 4 ? 1 : 2;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  std::vector<Eigen::Vector3d> rows;
  for (auto it = begin; it != end; ++it) {
    const double t = seconds_between(center, *it);
    const double beyond = std::max(0., std::abs(t) - half_span) / half_window;
    const double weight = std::max(0.02, 1 - beyond * beyond);
    const Eigen::Vector3d row(1, t, degree == 2 ? 0.5 * t * t : 0);
    normal += weight * row * row.transpose();
    moments += weight * row * antenna_in_world_[it - stamps_.begin()].transpose();
  }
  if (degree == 1) {
    normal(2, 2) = 1;
  }
  const Eigen::Matrix3d inverse = normal.inverse();
  const Eigen::Matrix3d solution = inverse * moments;
  LocalFit result{center, *std::prev(end), solution.row(0), solution.row(1), solution.row(2)};
  double sum = 0;
  for (auto it = begin; it != end; ++it) {
    const double t = seconds_between(center, *it);
    const Eigen::Vector3d predicted =
        result.position + t * result.velocity + 0.5 * t * t * result.acceleration;
    sum += (antenna_in_world_[it - stamps_.begin()] - predicted).head<2>().squaredNorm();
  }
  const double variance = sum / std::max<double>(1, 2. * (end - begin - degree - 1));
  result.duration = seconds_between(*begin, *std::prev(end));
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
    if (local.moving) {
      const double yaw_rate = (local.velocity.x() * local.acceleration.y() -
                               local.velocity.y() * local.acceleration.x()) /
                              local.velocity.head<2>().squaredNorm();
      const double slip = yaw_rate * antenna_in_vehicle_.x() / local.velocity.head<2>().norm();
      return std::atan2(local.velocity.y(), local.velocity.x()) -
             std::asin(std::clamp(slip, -.9, .9));
    }
  }
  return std::nullopt;
}

double GnssTrack::held_heading(Stamp stamp) const {
  const double stride = 0.5;
  for (Stamp t = std::min(stamp, stamps_.back()); t >= stamps_.front(); t = shifted(t, -stride)) {
    if (const auto heading = course(t)) {
      return *heading;
    }
  }
  if (forgotten_heading_) {
    return *forgotten_heading_;
  }
  for (Stamp t = std::max(stamp, stamps_.front()); t <= stamps_.back(); t = shifted(t, stride)) {
    if (const auto heading = course(t)) {
      return *heading;
    }
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
    const double speed = std::max(1e-3, velocity.head<2>().norm());
    const double yaw_rate =
        (velocity.x() * local.acceleration.y() - velocity.y() * local.acceleration.x()) /
        (speed * speed);
    const double slip = std::clamp(yaw_rate * antenna_in_vehicle_.x() / speed, -0.9, 0.9);
    heading = std::atan2(velocity.y(), velocity.x()) - std::asin(slip) + beyond * yaw_rate;
  } else {
    heading = held_heading(local.center);
  }
  Pose pose = Pose::Identity();
  pose.linear() = Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  pose.translation() = position - pose.linear() * antenna_in_vehicle_;
  return pose;
}

std::optional<std::pair<TrajectoryPose, TrajectoryPose>> GnssTrack::at(Stamp from, Stamp to) const {
  const Reach reach_from = reach_of(stamps_, from, limits_);
  const Reach reach_to = reach_of(stamps_, to, limits_);
  if (stamps_.size() < 2 || reach_from == Reach::none || reach_to == Reach::none) {
    return std::nullopt;
  }
  const double dt = seconds_between(from, to);
  const Stamp middle = shifted(from, 0.5 * dt);
  const double window = half_window(middle);
  std::pair<TrajectoryPose, TrajectoryPose> poses;
  if (std::abs(dt) <= 2 * window) {
    // One fit for both ends: its error moves them together and leaves the step between them alone.
    const LocalFit joint = fit(middle, 0.5 * std::abs(dt), window);
    poses.first.T_world_vehicle = pose_of(joint, from);
    poses.second.T_world_vehicle = pose_of(joint, to);
  } else {
    poses.first.T_world_vehicle = pose_of(fit(from, 0, window), from);
    poses.second.T_world_vehicle = pose_of(fit(to, 0, window), to);
  }
  poses.first.extrapolated = reach_from == Reach::outside;
  poses.second.extrapolated = reach_to == Reach::outside;
  return poses;
}

void GnssTrack::forget_before(Stamp stamp) {
  const Stamp oldest = shifted(stamp, -kMemory);
  const auto first = std::lower_bound(stamps_.begin(), stamps_.end(), oldest);
  const auto keep = std::min<std::ptrdiff_t>(
      first - stamps_.begin(),
      std::max<std::ptrdiff_t>(0, static_cast<std::ptrdiff_t>(stamps_.size()) - 4));
  if (keep <= 0) {
    return;
  }
  if (const auto heading = course(stamps_[keep])) {
    forgotten_heading_ = heading;
  }
  stamps_.erase(stamps_.begin(), stamps_.begin() + keep);
  antenna_in_world_.erase(antenna_in_world_.begin(), antenna_in_world_.begin() + keep);
}

}  // namespace lidar_upsampling
