// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <tbb/parallel_for.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "lidar_upsampling/robust/assignment.h"
#include "lidar_upsampling/tracks/log_odds.h"
#include "lidar_upsampling/tracks/object_tracks.h"

namespace lidar_upsampling {
namespace {

/// Where a track may be, if it moves, when an object was seen. Many are seen at one instant.
struct Courses {
  explicit Courses(const ObjectTrack& track, const TrackOptions& options)
      : known(courses_of(track, options)), now(known) {}

  void predict(Stamp instant, const MotionNoise& noise) {
    for (std::size_t i = 0; i < known.size(); ++i)
      if (now[i].from.stamp != instant) now[i].from = predicted(known[i].from, instant, noise);
  }

  std::vector<Course> known, now;
};

/// How much likelier the object is this track than a new one, as a logarithm.
/// @param courses in and out: predicted to the object's instant.
double log_ratio(const ObjectTrack& track, const ScanObject& object, const TrackedScan& scan,
                 const TrackOptions& options, Courses& courses) {
  constexpr double kSizeRatio = 0.7;  // of what two scans show of one object, in e-folds
  constexpr double kRise_m = 0.3;     // of its centroid, as other rings meet it
  constexpr double kLeast_m = 0.1;    // by which any centroid shifts: a ring more or less
  constexpr double kCertain = 50;     // the detector's own identity outweighs all else
  if (track.external_id >= 0 && object.external_id >= 0)
    return track.external_id == object.external_id ? kCertain : -kCertain;
  const Stamp instant = shifted(scan.scan.stamp, object.time_s);
  // What only one of the scans shows of it shifts its centroid by a half.
  const double shift = kLeast_m + options.extent_error * object.length +
                       0.5 * std::abs(object.length - track.length);
  const Eigen::Matrix2d parked =
      shift * shift * Eigen::Matrix2d::Identity() + ego_error(scan, object.centroid);
  const Eigen::Vector3d step = scan.T_rest_lidar * object.centroid - track.centroid_rest;
  const double is_moving = probability_of(track.latest_log_odds);
  double if_moving = 0;
  courses.predict(instant, options.noise);
  for (const Course& course : courses.now)
    if_moving += course.probability *
                 gaussian_density(step.head<2>() - course.from.mean.head<2>(),
                                  parked + course.from.covariance.topLeftCorner<2, 2>());
  const double here =
      is_moving * if_moving + (1 - is_moving) * gaussian_density(step.head<2>(), parked);
  const double size = static_cast<double>(object.points.size()) * object.centroid.squaredNorm();
  // Cauchy: one that comes out from behind another shows anything from a sliver to all of it.
  return std::log(here / options.birth_density) -
         std::log1p(std::pow(std::log(size / track.size) / kSizeRatio, 2)) -
         0.5 * std::pow(step.z() / kRise_m, 2);
}

}  // namespace

std::vector<int> associate(const std::vector<ObjectTrack>& tracks,
                           const std::vector<ScanObject>& objects, const TrackedScan& scan,
                           const TrackOptions& options) {
  if (tracks.empty()) return std::vector<int>(objects.size(), -1);
  CostMatrix cost(objects.size(), tracks.size());
  tbb::parallel_for(std::size_t{0}, tracks.size(), [&](std::size_t j) {
    Courses courses(tracks[j], options);
    for (std::size_t i = 0; i < objects.size(); ++i)
      cost(i, j) = std::min(0., -log_ratio(tracks[j], objects[i], scan, options, courses));
  });
  return solve_assignment(cost, 0.);
}

}  // namespace lidar_upsampling
