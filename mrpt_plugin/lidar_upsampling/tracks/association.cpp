// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

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

/// Where what is known of a track's shape lies by now, if it moves or if it stands, by its odds.
class Shape {
 public:
  Shape(const ObjectTrack& track, const TrackedScan& scan, const TrackOptions& options) {
    TrackState now = predicted(track.latest, scan.scan.stamp, options.noise);
    if (track.latest_log_odds > 0)
      sigma_m_ = std::sqrt(0.5 * now.covariance.topLeftCorner<2, 2>().trace());
    else
      now.mean.segment<6>(0).setZero();
    const Eigen::Vector3d velocity(now.mean[3], now.mean[4], 0);
    velocity_ = (scan.T_rest_lidar.linear().transpose() * velocity).cast<float>();
    places_ = evenly_thinned(points_by(track, now, scan.T_rest_lidar), kMostPlaces);
    for (const Eigen::Vector3f& place : places_) bounds_.extend(place);
  }

  /// Density (1/m^2) of an object that is a part of it: anywhere on it.
  [[nodiscard]] double density_of_part(const ScanObject& object, const LidarScan& scan) const {
    const double sigma = std::hypot(kReach_m, sigma_m_);
    const Eigen::Vector3f step = velocity_ * static_cast<float>(object.time_s);
    const Eigen::Vector2d extent = bounds_.sizes().head<2>().cast<double>().array() + 2.5 * sigma;
    if (bounds_.squaredExteriorDistance(object.centroid.cast<float>() - step) > 9 * sigma * sigma)
      return 0;
    const std::size_t stride = 1 + object.points.size() / kAsked;
    double sum_sq = 0;
    int count = 0;
    for (std::size_t i = 0; i < object.points.size(); i += stride, ++count)
      sum_sq += sq_distance(scan.points[object.points[i]] - step);
    return std::exp(-0.5 * sum_sq / count / (sigma * sigma)) / extent.prod();
  }

 private:
  static constexpr std::size_t kMostPlaces = 200, kAsked = 16;  // points that tell

  [[nodiscard]] double sq_distance(const Eigen::Vector3f& point) const {
    float least = std::numeric_limits<float>::infinity();
    for (const Eigen::Vector3f& place : places_)
      least = std::min(least, (place - point).squaredNorm());
    return least;
  }

  double sigma_m_ = 0;
  Eigen::Vector3f velocity_;  ///< m/s, lidar frame
  std::vector<Eigen::Vector3f> places_;
  Eigen::AlignedBox3f bounds_;
};

/// Density (1/m^2) of the object as the whole track, by its centroid.
/// @param courses in and out: predicted to the object's instant.
/// @param is_there probability, if it moves.
double density_of_whole(const ObjectTrack& track, const ScanObject& object, const TrackedScan& scan,
                        const TrackOptions& options, double is_there, Courses& courses) {
  constexpr double kSizeRatio = 0.7;  // of what two scans show of one object, in e-folds
  constexpr double kRise_m = 0.3;     // of its centroid, as other rings meet it
  constexpr double kLeast_m = 0.1;    // by which any centroid shifts: a ring more or less
  // What only one of the scans shows of it lies anywhere about the rest, and shifts its centroid by
  // up to a half.
  const double sq_shift = kLeast_m * kLeast_m + std::pow(options.extent_error * object.length, 2) +
                          std::pow(object.length - track.length, 2) / 12;
  const Eigen::Matrix2d parked =
      sq_shift * Eigen::Matrix2d::Identity() + ego_error(scan, object.centroid);
  const Eigen::Vector3d step = scan.T_rest_lidar * object.centroid - track.centroid_rest;
  const double is_moving = probability_of(track.latest_log_odds);
  double if_moving = 0;
  courses.predict(shifted(scan.scan.stamp, object.time_s), options.noise);
  for (const Course& course : courses.now)
    if_moving += course.probability *
                 gaussian_density(step.head<2>() - course.from.mean.head<2>(),
                                  parked + course.from.covariance.topLeftCorner<2, 2>());
  const double here =
      is_moving * is_there * if_moving + (1 - is_moving) * gaussian_density(step.head<2>(), parked);
  const double size = static_cast<double>(object.points.size()) * object.centroid.squaredNorm();
  // Cauchy: one that comes out from behind another shows anything from a sliver to all of it.
  return here / (1 + std::pow(std::log(size / track.size) / kSizeRatio, 2)) *
         std::exp(-0.5 * std::pow(step.z() / kRise_m, 2));
}

/// How much likelier the object is this track, or a part of it, than a new one, as a logarithm.
/// @param courses in and out: predicted to the object's instant.
double log_ratio(const ObjectTrack& track, const Shape& shape, const ScanObject& object,
                 const TrackedScan& scan, const TrackOptions& options, Courses& courses) {
  constexpr double kCertain = 50;  // the detector's own identity outweighs all else
  if (track.external_id >= 0 && object.external_id >= 0)
    return track.external_id == object.external_id ? kCertain : -kCertain;
  const double is_there = probability_of_being_there(track);
  const double whole = density_of_whole(track, object, scan, options, is_there, courses);
  const double part = (track.latest_log_odds > 0 ? is_there : 1) * options.piece_share *
                      shape.density_of_part(object, scan.scan);
  return std::log(std::max(whole, part) / options.birth_density);
}

}  // namespace

std::vector<int> associate(const std::vector<ObjectTrack>& tracks,
                           const std::vector<ScanObject>& objects, const TrackedScan& scan,
                           const TrackOptions& options) {
  if (tracks.empty()) return std::vector<int>(objects.size(), -1);
  CostMatrix cost(objects.size(), tracks.size());
  tbb::parallel_for(std::size_t{0}, tracks.size(), [&](std::size_t j) {
    Courses courses(tracks[j], options);
    const Shape shape(tracks[j], scan, options);
    for (std::size_t i = 0; i < objects.size(); ++i)
      cost(i, j) = std::min(0., -log_ratio(tracks[j], shape, objects[i], scan, options, courses));
  });
  return solve_assignment(cost, 0.);
}

}  // namespace lidar_upsampling
