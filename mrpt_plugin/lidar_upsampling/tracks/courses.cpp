// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <cmath>

#include "lidar_upsampling/tracks/object_tracks.h"

namespace lidar_upsampling {
namespace {

/// Probability that images have not told of it: a velocity so far from what scans tell is rather of
/// what stands around it, or of anything.
double doubt_of_images(const ObjectTrack& track, const TrackOptions& options) {
  const auto covariance_of = [](const TrackState& state) {
    return Eigen::Matrix2d(state.covariance.block<2, 2>(3, 3));
  };
  const TrackState by_scans = predicted(track.by_scans, track.latest.stamp, options.noise);
  const Eigen::Vector2d told = track.latest.velocity();
  const Eigen::Matrix2d P = covariance_of(track.latest);
  const Eigen::Matrix2d any =
      std::pow(options.noise.unknown_speed_sigma, 2) * Eigen::Matrix2d::Identity();
  const double right = gaussian_density(told - by_scans.velocity(), P + covariance_of(by_scans));
  const double wrong = (gaussian_density(told, P) + gaussian_density(told, P + any)) / 2;
  const double share = options.outlier_share;
  return right > 0 ? share * wrong / (share * wrong + (1 - share) * right) : 1;
}

}  // namespace

bool is_told_by_picture(const ObjectTrack& track, const TrackOptions& options) {
  return options.image_factor && !track.ahead && track.latest.stamp != track.stamp;
}

std::vector<Course> courses_of(const ObjectTrack& track, const TrackOptions& options) {
  const bool is_told = options.image_factor && track.latest.stamp != track.stamp;
  if (!is_told && !track.beginnings.empty()) return track.beginnings;
  const double wrong = options.outlier_share;
  const double doubt = options.image_factor ? doubt_of_images(track, options) : 0;
  return {{new_track_state(track.stamp, options.noise), wrong, true},
          {track.latest, (1 - wrong) * (1 - doubt)},
          {track.by_scans, (1 - wrong) * doubt}};
}

std::vector<Course> courses_before_images(const ObjectTrack& track,
                                          const Eigen::Vector2d& ego_velocity,
                                          const MotionNoise& noise) {
  if (track.beginnings.empty()) return {{track.state, 1}};
  constexpr double kSlow_m_s = 4;  // of us: then others' speed may as well be another
  constexpr double kAny_m_s = 2, kShareOfSpeed = 0.2;  // how much their speed differs from ours
  const double speed = ego_velocity.norm();
  const double share = speed * speed / (speed * speed + kSlow_m_s * kSlow_m_s) / 3;
  std::vector<Course> courses = track.beginnings;
  for (Course& course : courses) course.probability *= 1 - share;
  if (share / 2 < kWorthAFit) return courses;
  MotionNoise as_fast = noise;
  as_fast.unknown_speed_sigma = kAny_m_s + kShareOfSpeed * speed;
  TrackState traffic = going_along(new_track_state(track.stamp, noise),
                                   std::atan2(ego_velocity.y(), ego_velocity.x()), as_fast);
  for (const double way : {1., -1.}) {
    traffic.mean.segment<2>(3) = way * ego_velocity;
    courses.push_back({traffic, share / 2});
  }
  return courses;
}

}  // namespace lidar_upsampling
