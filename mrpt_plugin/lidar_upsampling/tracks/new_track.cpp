// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/tracks/new_track.h"

#include <cmath>

#include "lidar_upsampling/objects/sides.h"
#include "lidar_upsampling/tracks/log_odds.h"
#include "lidar_upsampling/tracks/pieces.h"
#include "lidar_upsampling/tracks/scan_factor.h"

namespace lidar_upsampling {
namespace {

double heading_of(const TrackedScan& scan) {
  const Pose T_rest_vehicle = scan.T_rest_lidar * scan.scan.T_vehicle_lidar.inverse();
  return std::atan2(T_rest_vehicle(1, 0), T_rest_vehicle(0, 0));
}

double heading_of(const ScanObject& object, const TrackedScan& scan) {
  const Eigen::Matrix3d R = scan.T_rest_lidar.linear();
  return yaw_of_sides(points_at(scan.scan, object.points)) + std::atan2(R(1, 0), R(0, 0));
}

/// Of an object of which nothing else is known, the likeliest first: it goes on foot, as most of
/// what looks like a person; anywhere; or along: our road, or its own sides, as whatever has
/// wheels.
std::vector<Course> beginnings_of(const ScanObject& object, const TrackedScan& scan,
                                  const MotionNoise& noise) {
  constexpr double kOnFoot = 0.75;  // of those; others ride, or are seen in part
  const bool is_person = object.class_name == "person" || object.class_name == "pedestrian";
  const double on_foot = is_person ? kOnFoot : 0, others = 1 - on_foot;
  const Stamp stamp = shifted(scan.scan.stamp, object.time_s);
  const TrackState any = new_track_state(stamp, noise);
  std::vector<Course> courses = {{any, others / 2},
                                 {going_along(any, heading_of(scan), noise), others / 4},
                                 {going_along(any, heading_of(object, scan), noise), others / 4}};
  if (!is_person) return courses;
  MotionNoise walking = noise;
  walking.unknown_speed_sigma = noise.slow_speed_sigma;
  courses.insert(courses.begin(), {new_track_state(stamp, walking), on_foot});
  return courses;
}

}  // namespace

ObjectTrack new_track(const ScanObject& object, const TrackedScan& scan,
                      const std::vector<ObjectTrack>& tracks, std::size_t num_known,
                      const TrackOptions& options) {
  const Whole whole = whole_of(object, scan, tracks, num_known, options);
  const double moves = whole.probability + (1 - whole.probability) * options.moving_prior;
  ObjectTrack track;
  const double as_piece = whole.probability / moves, alone = 1 - as_piece;
  track.beginnings = beginnings_of(object, scan, options.noise);
  for (Course& course : track.beginnings) course.probability *= alone;
  if (as_piece > kWorthAFit)
    track.beginnings.insert(as_piece > track.beginnings.front().probability
                                ? track.beginnings.begin()
                                : track.beginnings.end(),
                            {whole.state, as_piece});
  track.state = track.beginnings.front().from;
  track.by_scans = new_track_state(track.state.stamp, options.noise);
  track.log_odds = log_odds_of(moves) + log_ratio_of_class(object.class_name);
  return track;
}

}  // namespace lidar_upsampling
