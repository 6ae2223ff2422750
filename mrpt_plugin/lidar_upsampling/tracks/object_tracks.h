// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lidar_upsampling/registration/seen_space.h"
#include "lidar_upsampling/tracks/motion_estimate.h"
#include "lidar_upsampling/tracks/track_state.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// What is assumed of objects, all at once.
struct TrackOptions {
  MotionNoise noise;
  PointNoise points;
  double moving_prior = 0.3;    ///< of a road user that nothing else is known of
  double loss_ratio = 10;       ///< how much worse a parked object that jumps is than a mover left standing
  double memory_s = 2;          ///< log-odds of moving decay to the prior's by this
  double birth_density = 2e-4;  ///< new objects per m^2 of the scene, from scan to scan
  double extent_error = 0.1;    ///< share of its length by which what is seen of an object shifts
  double outlier_share = 0.05;  ///< of registrations that are wrong
  int min_inliers = 6;          ///< or half of those followed, whatever is less, likewise
  double min_agreement = 0.3;   ///< share of found points that agree, or the picture is not heard
  double outlier_density = 0.01; ///< per m^2, of where these lead
  double static_tolerance_px = 0.35;  ///< what ego-motion and calibration may be wrong on the picture
  double height_sigma_m = 0.02;     ///< vehicles stay on the ground...
  double tilt_sigma_deg = 0.3;     ///< ...and level, plus this times the time since the key scan...
  double height_rate_sigma = 0.2;  ///< ...m/s
  double tilt_rate_sigma_deg = 3;  ///< ...deg/s
};

/// An object candidate of a scan.
struct ScanObject {
  std::vector<int> points;  ///< indices into the scan
  std::string class_name;
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  ///< lidar frame
  double length = 0;                                   ///< m, of the footprint
  double time_s = 0;                                   ///< of its points' measurement, from the scan's stamp
};

/// An object over time, of no camera, in a frame at rest.
struct ObjectTrack {
  int id = -1;
  std::string class_name;
  Stamp stamp;                          ///< of its last sight in a scan
  Pose T_rest_lidar;                    ///< then
  std::vector<Eigen::Vector3f> points;  ///< lidar frame then
  Eigen::Vector3d centroid_rest = Eigen::Vector3d::Zero();
  double size = 0;         ///< what is seen of it, as an area
  TrackState state;        ///< at `stamp`
  double log_odds = 0;     ///< of moving, at `stamp`
  TrackState latest;       ///< with what the last image since has told
  double latest_log_odds = 0;
  bool is_new = true;      ///< seen by one scan only
  std::optional<TrackState> ahead;  ///< at the scan to come, where that is known and shows it
  double ahead_log_odds = 0;
};

/// A scan, as tracks need it.
struct TrackedScan {
  const LidarScan& scan;
  const Pose& T_rest_lidar;
  const Matrix6d& step_covariance;  ///< of the ego-motion since the scan before
  const SeenSpace& seen;
  const SeenSpace* seen_before = nullptr;  ///< by the scan before; null: there was none
  Stamp stamp_before;
};

struct TrackStore {
  std::vector<ObjectTrack> tracks;
  int next_id = 0;
};

/// @brief Joins a scan's objects to the tracks, measures how they have moved since their last
/// sight, and forgets tracks of which nothing is known any more.
/// @return the track of each object, a position in `store.tracks`.
std::vector<int> take_up_scan(TrackStore& store, const std::vector<ScanObject>& objects,
                              const TrackedScan& scan, const TrackOptions& options);

/// @brief Lets the tracks know where the scan to come shows them.
void look_ahead(TrackStore& store, const std::vector<ScanObject>& objects,
                const TrackedScan& scan, const TrackOptions& options);

/// @brief The track of each object (-1: a new one), at the least total cost.
[[nodiscard]] std::vector<int> associate(const std::vector<ObjectTrack>& tracks,
                                         const std::vector<ScanObject>& objects,
                                         const TrackedScan& scan, const TrackOptions& options);

/// What is asked of an object at an instant, and what is known for it.
struct MotionQuestion {
  Stamp instant;
  Pose T_lidar_t_lidar_k = Pose::Identity();      ///< ego-motion
  Matrix6d ego_covariance = Matrix6d::Zero();     ///< of a left increment, lidar frame at t
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  ///< lidar frame at k
  Eigen::Matrix3d R_rest_lidar_k = Eigen::Matrix3d::Identity();
  double focal_px = 700;
};

/// The answer.
struct MotionAnswer {
  bool moves = false;
  bool is_seen = false;  ///< whether the picture was heard
  double log_odds = 0;
  MotionFit fit;      ///< of the moving object
  MotionFit parked;
  TrackState state;   ///< at the instant, if it moves
};

/// @brief The motion that the track expects until an instant, in the axes of the lidar frame at k.
[[nodiscard]] MotionExpected expected_motion(const TrackState& at_instant, const MotionQuestion& question,
                                             double dt, const TrackOptions& options);

/// @brief Both hypotheses, and which of them is to be told. Where few of the points that were
/// found agree with either, the picture was asked at the wrong place and says nothing.
/// @param num_followed points of the object, found again or not.
[[nodiscard]] MotionAnswer estimate_motion(const ObjectTrack& track, const ImageFactor& image,
                                           int num_followed, const MotionQuestion& question,
                                           const std::vector<Twist>& starts,
                                           const TrackOptions& options);

}  // namespace lidar_upsampling
