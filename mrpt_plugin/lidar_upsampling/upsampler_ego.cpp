// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
// How the vehicle moves, as LidarUpsampler asks for it: from image to image and from scan to scan.
#include <algorithm>
#include <cmath>

#include "lidar_upsampling/camera_view.h"
#include "lidar_upsampling/ego/camera_ego.h"
#include "lidar_upsampling/prepared_scan.h"
#include "lidar_upsampling/registration/scan_registration.h"
#include "lidar_upsampling/se3.h"
#include "lidar_upsampling/stopwatch.h"
#include "lidar_upsampling/tracks/log_odds.h"
#include "lidar_upsampling/upsampler.h"

namespace lidar_upsampling {

// As the poses tell it, with what they are likely to be wrong by; exact where they are taken at
// their word.
std::optional<EgoStep> LidarUpsampler::given_step(const LidarScan& scan, Stamp instant) const {
  auto step = ego_motion_.step(scan.stamp, instant);
  if (!step) return step;
  step->T_to_from = between_sensors(step->T_to_from, scan.T_vehicle_lidar);
  if (!ego_motion_.fuses()) return step;
  const double dt = std::max(1e-3, std::abs(seconds_between(scan.stamp, instant)));
  const Twist usual = usual_noise(ego_motion_.source(), step->T_to_from.translation() / dt);
  Twist noise = likely_noise(pose_noise_, usual);
  if (ego_motion_.source() == EgoSource::gnss) noise = noise.cwiseMax(smoothing_noise(dt));
  step->covariance = noise.asDiagonal();
  return step;
}

EgoStep LidarUpsampler::steady_step(Stamp instant) const {
  const double dt = seconds_between(key_->scan.stamp, instant);
  const CameraEgoOptions options = camera_ego_options(std::abs(dt));
  return {exp_se3(Twist(steady_motion().rate * dt)), true, options.sigmas.cwiseAbs2().asDiagonal()};
}

// Until the next scan, where that is known; else as since the scan before.
SteadyMotion& LidarUpsampler::steady_motion() const {
  return to_come_.empty() ? key_->motion : to_come_.front()->motion;
}

EgoStep LidarUpsampler::ego_step(Stamp instant) const {
  const auto given = given_step(key_->scan, instant);
  if (!given) return steady_step(instant);
  return steady_motion().is_measured ? fused(*given, steady_step(instant)) : *given;
}

// How far a constant velocity may lead astray: far if it is only hoped for, little if it was
// measured between the last two scans.
CameraEgoOptions LidarUpsampler::camera_ego_options(double dt) const {
  constexpr double kForward = 2.5, kSideways = 1, kTurning = 0.5;  // m/s^2, m/s^2, rad/s^2
  CameraEgoOptions options = config_.camera_ego;
  if (!steady_motion().is_measured) return options;
  const bool is_between = !to_come_.empty();
  const double to_end =
      is_between ? seconds_between(key_->scan.stamp, to_come_.front()->scan.stamp) - dt : 0;
  const double reach = 0.5 * (is_between ? std::abs(to_end) : scan_period_s_ + dt) * dt;
  options.trust_guess = true;
  options.pose.min_inlier_ratio = std::min(0.1, options.pose.min_inlier_ratio);
  options.sigmas.segment<3>(2) << 0.002 + kTurning * reach, 0.01 + kForward * reach,
      0.01 + kSideways * reach;
  return options;
}

EgoStep LidarUpsampler::camera_step(const CameraView& view, const Picture& picture,
                                    const EgoStep& predicted) {
  const Pose T_camera_lidar = view.camera.T_vehicle_camera.inverse() * key_->scan.T_vehicle_lidar;
  const double dt = seconds_between(key_->scan.stamp, picture.instant);
  CameraEgoOptions options = camera_ego_options(dt);
  if (given_step(key_->scan, picture.instant)) {
    options.guess_covariance = predicted.covariance;
    options.trust_guess = true;
  }
  const auto step =
      estimate_camera_ego(correspondences_of(view.points, kStaticOwner), view.camera.model,
                          T_camera_lidar, options, predicted.T_to_from);
  if (!step) return predicted;
  if (!steady_motion().is_measured) steady_motion().rate = log_se3(step->T_to_from) / dt;
  return *step;
}

// All but those of road users that are not known to be parked: what moves along with us, or alone
// stands out, would be taken for the world.
std::vector<Eigen::Vector3f> LidarUpsampler::standing_points(const PreparedScan& before) const {
  const bool are_tracked = &before == key_.get() && track_of_.size() == before.objects.size();
  std::vector<bool> may_move(before.scan.size(), false);
  for (std::size_t i = 0; i < before.objects.size(); ++i) {
    const bool is_parked = are_tracked && store_.tracks[track_of_[i]].log_odds <
                                              log_odds_of(config_.object_tracks.moving_prior);
    if (is_parked) continue;
    for (const int point : before.objects[i].points) may_move[point] = true;
  }
  std::vector<Eigen::Vector3f> points;
  points.reserve(may_move.size());
  for (std::size_t i = 0; i < may_move.size(); ++i)
    if (!may_move[i]) points.push_back(before.scan.points[i]);
  return points;
}

void LidarUpsampler::step_between_scans(const PreparedScan& before, PreparedScan& now) {
  now.motion = {before.motion.rate, false};
  now.step_covariance.setZero();
  const auto given = given_step(before.scan, now.scan.stamp);
  const double dt = seconds_between(before.scan.stamp, now.scan.stamp);
  now.T_scan_before = given ? given->T_to_from : exp_se3(Twist(before.motion.rate * dt));
  if (given && !ego_motion_.fuses()) return;
  const Stopwatch watch(timing_, "scan registration");
  // Without poses all that stands out is needed: the most of it is parked.
  const auto registration = register_scans(given ? standing_points(before) : before.scan.points,
                                           now.scan.points, now.T_scan_before);
  if (!registration) return;
  EgoStep step = step_of(*registration);
  if (given) {
    note_step(pose_noise_, *given, step);
    step = fused(*given_step(before.scan, now.scan.stamp), step);  // with what was learnt just now
  }
  now.T_scan_before = step.T_to_from;
  now.step_covariance = step.covariance;
  now.motion = {log_se3(step.T_to_from) / dt, true};
}

}  // namespace lidar_upsampling
