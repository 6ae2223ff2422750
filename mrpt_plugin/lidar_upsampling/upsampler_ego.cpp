// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
// How the vehicle moves, as LidarUpsampler asks for it: from image to image and from scan to scan.
#include <algorithm>
#include <cmath>

#include "lidar_upsampling/camera_view.h"
#include "lidar_upsampling/ego/camera_ego.h"
#include "lidar_upsampling/key_scan.h"
#include "lidar_upsampling/registration/scan_registration.h"
#include "lidar_upsampling/scan/sweep.h"
#include "lidar_upsampling/se3.h"
#include "lidar_upsampling/stopwatch.h"
#include "lidar_upsampling/upsampler.h"

namespace lidar_upsampling {
namespace {

Pose in_lidar(const Pose& T_to_from_vehicle, const Pose& T_vehicle_lidar) {
  return T_vehicle_lidar.inverse() * T_to_from_vehicle * T_vehicle_lidar;
}

}  // namespace

// As the poses tell it, with what they are likely to be wrong by; exact where they are taken at
// their word.
std::optional<EgoStep> LidarUpsampler::given_step(Stamp instant) const {
  const LidarScan& scan = key_->scan;
  auto step = ego_motion_.step(scan.stamp, instant);
  if (!step) return step;
  step->T_to_from = in_lidar(step->T_to_from, scan.T_vehicle_lidar);
  if (!ego_motion_.fuses()) return step;
  const double dt = std::max(1e-3, std::abs(seconds_between(scan.stamp, instant)));
  const Twist usual = usual_noise(ego_motion_.source(), step->T_to_from.translation() / dt);
  step->covariance = likely_noise(pose_noise_, usual).asDiagonal();
  return step;
}

EgoStep LidarUpsampler::steady_step(Stamp instant) const {
  const double dt = seconds_between(key_->scan.stamp, instant);
  const CameraEgoOptions options = camera_ego_options(std::abs(dt));
  Twist sigmas;
  sigmas << options.tilt_sigma_rad, options.tilt_sigma_rad, options.yaw_sigma_rad,
      options.forward_sigma_m, options.sideways_sigma_m, options.vertical_sigma_m;
  return {exp_se3(Twist(lidar_rate_ * dt)), true, sigmas.cwiseAbs2().asDiagonal()};
}

EgoStep LidarUpsampler::ego_step(Stamp instant) const {
  const auto given = given_step(instant);
  if (!given) return steady_step(instant);
  return rate_is_measured_ ? fused(*given, steady_step(instant)) : *given;
}

// How far a constant velocity may lead astray: far if it is only hoped for, little if it was
// measured between the last two scans.
CameraEgoOptions LidarUpsampler::camera_ego_options(double dt) const {
  constexpr double kForward = 2.5, kSideways = 1, kTurn = 0.5;  // m/s^2, m/s^2, rad/s^2
  CameraEgoOptions options = config_.camera_ego;
  if (!rate_is_measured_) return options;
  const double to_end = next_ ? seconds_between(key_->scan.stamp, next_->stamp) - dt : 0;
  const double reach = 0.5 * (next_ ? std::abs(to_end) : scan_period_s_ + dt) * dt;
  options.trust_guess = true;
  options.pose.min_inlier_ratio = std::min(0.1, options.pose.min_inlier_ratio);
  options.forward_sigma_m = 0.01 + kForward * reach;
  options.sideways_sigma_m = 0.01 + kSideways * reach;
  options.yaw_sigma_rad = 0.002 + kTurn * reach;
  return options;
}

EgoStep LidarUpsampler::camera_step(const CameraView& view, const Picture& picture,
                                    const EgoStep& predicted) {
  const Pose T_camera_lidar = view.camera.T_vehicle_camera.inverse() * key_->scan.T_vehicle_lidar;
  const double dt = seconds_between(key_->scan.stamp, picture.instant);
  CameraEgoOptions options = camera_ego_options(dt);
  if (given_step(picture.instant)) {
    options.guess_covariance = predicted.covariance;
    options.trust_guess = true;
  }
  const auto step =
      estimate_camera_ego(correspondences_of(view.points, kStaticOwner), view.camera.model,
                          T_camera_lidar, options, predicted.T_to_from);
  if (!step) return predicted;
  if (!rate_is_measured_) lidar_rate_ = log_se3(step->T_lidar_t_lidar_k) / dt;
  return {step->T_lidar_t_lidar_k, false, step->covariance};
}

double LidarUpsampler::turn_s() const {
  if (config_.sweep.period_ms > 0) return 1e-3 * config_.sweep.period_ms;
  double shortest_s = scan_period_s_;
  for (std::size_t i = 1; i < expected_scans_.size(); ++i) {
    const double between_s = seconds_between(expected_scans_[i - 1], expected_scans_[i]);
    if (between_s > 0 && (shortest_s <= 0 || between_s < shortest_s)) shortest_s = between_s;
  }
  return shortest_s;
}

void LidarUpsampler::straighten(LidarScan& scan, const std::vector<float>& times) const {
  deskew(scan, times, [&](double time) {
    const auto step = ego_motion_.step(shifted(scan.stamp, time), scan.stamp);
    return step ? in_lidar(step->T_to_from, scan.T_vehicle_lidar)
                : exp_se3(Twist(-time * lidar_rate_));
  });
}

Pose LidarUpsampler::take_up(LidarScan& scan, const Pose* known_step) {
  const std::vector<float> times = point_times(scan, config_.sweep, turn_s());
  const auto as_measured = times.empty() ? std::vector<Eigen::Vector3f>{} : scan.points;
  straighten(scan, times);
  if (known_step != nullptr) return *known_step;
  if (!key_) return Pose::Identity();
  const Pose T_scan_key = scan_step(scan);
  if (times.empty() || !rate_is_measured_ || given_step(scan.stamp)) return T_scan_key;
  scan.points = as_measured;  // once more, by the rate that it showed itself
  straighten(scan, times);
  return T_scan_key;
}

Pose LidarUpsampler::scan_step(const LidarScan& next) {
  const auto given = given_step(next.stamp);
  step_covariance_.setZero();
  if (given && !ego_motion_.fuses()) return given->T_to_from;
  const Pose guess = given ? given->T_to_from : ego_step(next.stamp).T_to_from;
  const Stopwatch watch(timing_, "scan registration");
  const auto registration =
      register_scans(key_->scan.points, next.points, guess, config_.scan_registration);
  rate_is_measured_ = registration.has_value();
  if (!registration) return guess;
  EgoStep step = step_of(*registration);
  if (given) {
    note_step(pose_noise_, *given, step);
    step = fused(*given_step(next.stamp), step);  // with what was learnt just now
  }
  lidar_rate_ = log_se3(step.T_to_from) / seconds_between(key_->scan.stamp, next.stamp);
  step_covariance_ = step.covariance;
  return step.T_to_from;
}

}  // namespace lidar_upsampling
