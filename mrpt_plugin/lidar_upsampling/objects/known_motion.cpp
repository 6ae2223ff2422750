// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/known_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "lidar_upsampling/registration/object_registration.h"
#include "lidar_upsampling/units.h"

namespace lidar_upsampling {
namespace {

constexpr double kMaxRise_m = 0.1;  // between two scans, what a road user may rise or sink

/// The points' mean, and that of those farthest to either side as the sensor sees them: an object
/// that comes out from behind another keeps one end.
std::array<Eigen::Vector3d, 3> landmarks(const std::vector<Eigen::Vector3f>& points,
                                         const Pose& T_k) {
  const Eigen::Vector3d mean = T_k * mean_of(points);
  const Eigen::Vector2d side = Eigen::Vector2d(-mean.y(), mean.x()).normalized();
  std::vector<std::pair<double, Eigen::Vector3d>> across;
  for (const auto& point : points) {
    const Eigen::Vector3d at = T_k * point.cast<double>();
    across.emplace_back(side.dot(at.head<2>()), at);
  }
  const std::size_t share = 1 + points.size() / 10;
  const auto by_side = [](const auto& a, const auto& b) { return a.first < b.first; };
  std::array<Eigen::Vector3d, 3> result{mean, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  std::sort(across.begin(), across.end(), by_side);
  for (std::size_t i = 0; i < share; ++i) {
    result[1] += across[i].second / static_cast<double>(share);
    result[2] += across[across.size() - 1 - i].second / static_cast<double>(share);
  }
  return result;
}

/// Level steps over ground that the object may have taken, by its outline.
std::array<Eigen::Vector3d, 3> steps_by_shape(const ObjectScans& scans) {
  const auto before = landmarks(scans.before, scans.T_lidar_k_lidar_before);
  auto step = landmarks(scans.now, Pose::Identity());
  for (std::size_t i = 0; i < step.size(); ++i) {
    step[i] -= before[i];
    if (i > 0) step[i].z() = 0;
  }
  return step;
}

bool can_be_registered(const ObjectScans& scans, const ObjectRegistrationOptions& options) {
  return static_cast<int>(scans.before.size()) >= options.min_points &&
         static_cast<int>(scans.now.size()) >= options.min_points && scans.dt > 0;
}

/// The object as it is now put on what was seen before.
ObjectRegistration register_backwards(const ObjectScans& scans, std::vector<Pose> guesses,
                                      const ObjectRegistrationOptions& options) {
  for (Pose& guess : guesses) guess = guess.inverse();
  ObjectRegistration result = register_object(scans.now, Surface(scans.before), guesses, options);
  result.T_target_object = result.T_target_object.inverse();
  const Eigen::Matrix2d turn = result.T_target_object.linear().topLeftCorner<2, 2>();
  result.slack = turn * result.slack * turn.transpose();
  return result;
}

/// The view with fewer points is likelier to be a part of the other one than the reverse.
ObjectRegistration register_views(const ObjectScans& scans, const std::vector<Pose>& guesses,
                                  const ObjectRegistrationOptions& options) {
  if (scans.before.size() > scans.now.size()) return register_backwards(scans, guesses, options);
  return register_object(scans.before, Surface(scans.now), guesses, options);
}

std::optional<KnownMotion> motion_of(const ObjectRegistration& registration,
                                     const ObjectScans& scans, Stamp stamp_k,
                                     const Eigen::Matrix3d& R_rest_lidar_k) {
  if (registration.status != RegistrationStatus::reliable &&
      registration.status != RegistrationStatus::ambiguous)
    return {};
  // Over ground, in the axes of the lidar frame at k.
  const Pose T_mov_k = registration.T_target_object * scans.T_lidar_k_lidar_before.inverse();
  const Eigen::Vector3d centroid = mean_of(scans.now);
  const Eigen::Vector3d step = centroid - T_mov_k.inverse() * centroid;
  if (std::abs(step.z()) > kMaxRise_m) return {};
  KnownMotion known;
  known.stamp = shifted(stamp_k, -0.5 * scans.dt);
  known.from_scans = true;
  known.velocity_at_rest = R_rest_lidar_k * Eigen::Vector3d(step / scans.dt);
  known.yaw_rate = std::atan2(T_mov_k.linear()(1, 0), T_mov_k.linear()(0, 0)) / scans.dt;
  // Few points lock into the gaps between rings: where matches lie far apart, so do the answers.
  constexpr double kRegistrationSigma_m = 0.03;
  const double sigma = std::hypot(kRegistrationSigma_m, 0.5 * registration.residual_m);
  const Eigen::Matrix2d turn = R_rest_lidar_k.topLeftCorner<2, 2>();
  known.velocity_covariance =
      (sigma * sigma * Eigen::Matrix2d::Identity() + turn * registration.slack * turn.transpose()) /
      (scans.dt * scans.dt);
  return known;
}

struct Extent {
  float front = -std::numeric_limits<float>::infinity();     ///< farthest ahead
  float nearest_m = std::numeric_limits<float>::infinity();  ///< from the sensor
};

Extent extent_of(const std::vector<Eigen::Vector3f>& points, const Eigen::Vector3f& ahead) {
  Extent extent;
  for (const Eigen::Vector3f& point : points) {
    extent.front = std::max(extent.front, ahead.dot(point));
    extent.nearest_m = std::min(extent.nearest_m, point.norm());
  }
  return extent;
}

}  // namespace

KnownMotion known_from(const ObjectMotion& motion, Stamp stamp_k, double dt,
                       const Eigen::Matrix3d& R_rest_lidar_k) {
  KnownMotion known;
  known.stamp = shifted(stamp_k, 0.5 * dt);
  known.velocity_at_rest = R_rest_lidar_k * motion.velocity_lidar_k;
  known.yaw_rate = motion.yaw_rate;
  known.found_moving = motion.status == MotionStatus::moving;
  const Eigen::Matrix3d R =
      R_rest_lidar_k * motion.T_mov.linear() * motion.T_lidar_t_lidar_k.linear().transpose();
  known.velocity_covariance =
      (R * motion.position_covariance * R.transpose()).topLeftCorner<2, 2>() / (dt * dt);
  return known;
}

double evidence_of_motion(const KnownMotion& known) {
  constexpr double kFinest = 0.1;  // m/s
  const Eigen::Vector2d velocity = known.velocity_at_rest.head<2>();
  const Eigen::Matrix2d covariance =
      known.velocity_covariance + kFinest * kFinest * Eigen::Matrix2d::Identity();
  const double evidence = velocity.dot(covariance.inverse() * velocity);
  // What stood still between two scans does so now, a hundred to one; but it may have crept.
  constexpr double kCreeping = 0.2;      // m/s
  constexpr double kSignificant = 5.99;  // one in twenty
  const double kOdds = 2 * std::log(100.);
  const bool stood = known.from_scans && evidence < kSignificant &&
                     known.velocity_covariance.trace() < 2 * kCreeping * kCreeping;
  return stood ? evidence - kOdds : evidence;
}

KnownMotion fused(const KnownMotion& older, const KnownMotion& newer, double acceleration_sigma) {
  constexpr double kInherited = 1;  // m/s: the older one was sought where a still older one led
  constexpr double kContradiction = 13.8;  // chi-square of 2 degrees of freedom, one in a thousand
  const double between = std::abs(seconds_between(older.stamp, newer.stamp));
  const double change = std::hypot(kInherited, acceleration_sigma * between);
  const Eigen::Matrix2d older_covariance =
      older.velocity_covariance + change * change * Eigen::Matrix2d::Identity();
  const Eigen::Vector2d difference = (older.velocity_at_rest - newer.velocity_at_rest).head<2>();
  const Eigen::Matrix2d gain =
      newer.velocity_covariance * (older_covariance + newer.velocity_covariance).inverse();
  KnownMotion result = newer;
  result.found_moving = older.found_moving || newer.found_moving;
  if (difference.dot((older_covariance + newer.velocity_covariance).inverse() * difference) >
      kContradiction)
    return result;
  result.velocity_at_rest.head<2>() += gain * difference;
  result.velocity_covariance = newer.velocity_covariance - gain * newer.velocity_covariance;
  return result;
}

Twist rate_over_ground(const KnownMotion& known, const Eigen::Matrix3d& R_lidar_k_rest,
                       const Eigen::Vector3d& centroid) {
  const Eigen::Vector3d omega(0, 0, known.yaw_rate);
  Twist rate;
  rate << omega, R_lidar_k_rest * known.velocity_at_rest - omega.cross(centroid);
  return rate;
}

MotionPrior expect_motion(const std::optional<KnownMotion>& known, Stamp key_stamp,
                          const Eigen::Matrix3d& R_lidar_k_rest, const Eigen::Vector3d& centroid,
                          double dt, const MotionPriorOptions& options) {
  MotionPrior prior;
  constexpr double kAnyTilt = 3;  // rad
  prior.height_sigma_m = options.ground ? options.height_sigma_m + options.height_rate_sigma * dt
                                        : options.unknown_speed_sigma * dt;
  prior.tilt_sigma = options.ground
                         ? kDegree * (options.tilt_sigma_deg + options.tilt_rate_sigma_deg * dt)
                         : kAnyTilt;
  prior.yaw_sigma = options.yaw_rate_sigma * dt + kDegree * options.tilt_sigma_deg;
  if (!known) {
    prior.position_covariance =
        std::pow(options.unknown_speed_sigma * dt, 2) * Eigen::Matrix2d::Identity();
    prior.yaw_sigma += 3 * options.yaw_rate_sigma * dt;
    return prior;
  }
  prior.T_mov = exp_se3(Twist(rate_over_ground(*known, R_lidar_k_rest, centroid) * dt));
  const double age = seconds_between(known->stamp, key_stamp) + 0.5 * dt;
  const Eigen::Matrix2d turn = R_lidar_k_rest.topLeftCorner<2, 2>();
  prior.position_covariance = dt * dt * turn * known->velocity_covariance * turn.transpose() +
                              (std::pow(options.acceleration_sigma * age * dt, 2) + 0.005 * 0.005) *
                                  Eigen::Matrix2d::Identity();
  return prior;
}

PosePrior pose_prior(const MotionPrior& prior, const Pose& T_camera_t_lidar_k_ego,
                     const Eigen::Vector3d& centroid) {
  PosePrior result;
  result.T_mean = T_camera_t_lidar_k_ego * prior.T_mov;
  // An increment (w, t) of the camera frame turns the object by w and moves its centroid c by
  // t + w x c; both are judged in the lidar frame's axes.
  const Eigen::Matrix3d R_lidar_camera = T_camera_t_lidar_k_ego.linear().transpose();
  const Eigen::Vector3d c = result.T_mean * centroid;
  const Eigen::Vector3d turn(1 / prior.tilt_sigma, 1 / prior.tilt_sigma, 1 / prior.yaw_sigma);
  Eigen::Matrix3d step = Eigen::Matrix3d::Zero();
  step.topLeftCorner<2, 2>() = Eigen::Matrix2d(prior.position_covariance.inverse()).llt().matrixU();
  step(2, 2) = 1 / prior.height_sigma_m;
  result.sqrt_information.topLeftCorner<3, 3>() = turn.asDiagonal() * R_lidar_camera;
  result.sqrt_information.bottomLeftCorner<3, 3>() = step * R_lidar_camera * skew(-c);
  result.sqrt_information.bottomRightCorner<3, 3>() = step * R_lidar_camera;
  return result;
}

std::optional<KnownMotion> measure_between_scans(const ObjectScans& scans, Stamp stamp_k,
                                                 const Eigen::Matrix3d& R_rest_lidar_k) {
  const ObjectRegistrationOptions options = options_between_scans(120, 15, 0);
  if (!can_be_registered(scans, options)) return {};
  const Pose& T_ego = scans.T_lidar_k_lidar_before;
  std::vector<Pose> guesses{T_ego, T_ego * scans.T_mov_guess};
  const auto steps = steps_by_shape(scans);
  guesses.emplace_back(Eigen::Translation3d(steps[0]) * T_ego);
  ObjectRegistration registration = register_views(scans, guesses, options);
  if (registration.status == RegistrationStatus::poor_overlap) {
    guesses.emplace_back(Eigen::Translation3d(steps[1]) * T_ego);
    guesses.emplace_back(Eigen::Translation3d(steps[2]) * T_ego);
    registration = register_views(scans, guesses, options);
  }
  return motion_of(registration, scans, stamp_k, R_rest_lidar_k);
}

bool was_there_then(const ObjectSight& object, const Eigen::Vector2d& step,
                    const Pose& T_other_lidar, const SeenSpace& other) {
  constexpr double kTelling_m = 0.7;  // what SeenSpace can tell a place from its surroundings by
  constexpr int kFewest = 3;
  constexpr double kLeastShare = 0.15;
  if (step.norm() < kTelling_m) return false;
  const Eigen::Vector3f ahead(static_cast<float>(step.x()), static_cast<float>(step.y()), 0);
  const Eigen::Isometry3f T = T_other_lidar.cast<float>();
  const Extent extent = extent_of(object.points, ahead);
  int telling = 0, gone = 0;
  for (const Eigen::Vector3f& point : object.points) {
    const Eigen::Vector3f further = point + ahead;
    const Sight beyond = object.seen.at(further), then = other.at(T * point);
    const bool is_end =
        beyond == Sight::seen_through || (beyond == Sight::open && object.is_whole &&
                                          ahead.dot(point) > extent.front - ahead.squaredNorm());
    const bool is_behind_itself =
        beyond == Sight::hidden && object.seen.reach(further) > extent.nearest_m;
    const bool tells = is_behind_itself || (is_end && then != Sight::hidden);
    telling += tells ? 1 : 0;
    gone += tells && then != Sight::open ? 1 : 0;
  }
  const int fewest = std::max(kFewest, static_cast<int>(object.points.size()) / 5);
  return telling >= fewest && gone < kLeastShare * telling;
}

}  // namespace lidar_upsampling
