// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lidar_upsampling/registration/seen_space.h"
#include "lidar_upsampling/registration/surface.h"
#include "lidar_upsampling/tracks/motion_estimate.h"
#include "lidar_upsampling/tracks/track_state.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

struct MotionAnswer;

/// What is assumed of objects, all in one place. Without a factor, the others decide alone.
struct TrackOptions {
  bool scan_factor = true;    ///< registration between real scans
  bool image_factor = true;   ///< what images told is known at the next one, and at the next scan
  bool ground_factor = true;  ///< vehicles stay on the ground, and level
  bool static_test = true;    ///< what is likelier parked stays; off: all moves as it was fitted

  MotionNoise noise;
  PointNoise points;
  double moving_prior = 0.3;  ///< probability, of a road user that nothing else is known of
  double loss_ratio = 10;  ///< how much worse a parked object that jumps is than a mover that stays
  double memory_s = 2;     ///< log-odds of moving decay to the prior's within this
  double birth_density = 2e-4;    ///< new objects per m^2 of the scene, from scan to scan
  double piece_share = 0.05;      ///< of moving objects, that a scan shows in pieces
  double extent_error = 0.1;      ///< share of its length by which what is seen of an object shifts
  double outlier_share = 0.02;    ///< of registrations, and of pictures, that are wrong
  double outlier_density = 0.01;  ///< per m^2, of where these lead
  double common_error_px = 0.25;  ///< what all points of an object have wrong alike on the picture
  double height_sigma_m = 0.02;   ///< vehicles stay on the ground...
  double tilt_sigma_deg = 0.3;    ///< ...and level...
  double ground_time_s = 0.1;     ///< ...and by as much again within this since the key scan
};

/// An object candidate of a scan.
struct ScanObject {
  std::vector<int> points;  ///< indices into the scan
  std::string class_name;
  int external_id = -1;                                ///< the detector's own identity, -1 if none
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  ///< lidar frame
  double length = 0;                                   ///< m, of the footprint
  double time_s = 0;  ///< of its points' measurement, from the scan's stamp
};

/// How an object that moves may go on from its last sight.
struct Course {
  TrackState from;
  double probability = 0;
  bool is_new = false;  ///< nothing that was known of it is true
};

/// From one sight of an object to the next.
struct Passage {
  TrackState from;         ///< at the first one, as it was taken; steps count from there
  TrackState arrived;      ///< at the second one
  bool surprised = false;  ///< `from` is nobody's: what was known at the first sight was wrong
};

/// What the scans to come tell of an object at its last sight.
struct Ahead {
  TrackState from;      ///< at that sight, as the filter has it
  TrackState next;      ///< at the next sight, with all scans to come; its step since that sight
  double log_odds = 0;  ///< of moving, with all scans to come
};

/// An object over time, in a frame at rest; of no camera.
struct ObjectTrack {
  int id = -1;
  int external_id = -1;  ///< the detector's own identity, -1 if none
  std::string class_name;
  Stamp stamp;                             ///< of its last sight in a scan
  Pose T_rest_lidar = Pose::Identity();    ///< then
  std::shared_ptr<const SeenSpace> seen;   ///< by that scan; null: it is as predicted then
  std::shared_ptr<const Surface> surface;  ///< its points, lidar frame then; with those that an
                                           ///< earlier sight has shown and something hides
  Eigen::Vector3d centroid_rest = Eigen::Vector3d::Zero();
  double size = 0;                 ///< what is seen of it: points times squared range, as an area
  double length = 0;               ///< m, of what is seen of it
  double whole_length = 0;         ///< m, with what is hidden of it
  int num_missed = 0;              ///< scans since that do not show it, though nothing hides it
  TrackState state;                ///< at `stamp`
  double log_odds = 0;             ///< of moving, at `stamp`
  TrackState by_scans;             ///< at `stamp`, as scans alone tell
  TrackState latest;               ///< with what the last image since then told
  double latest_log_odds = 0;      ///< likewise
  std::vector<Course> beginnings;  ///< of a new one, at `stamp`, the likeliest first
  std::optional<Passage> passage;  ///< from the sight before to the last one
  std::optional<Ahead> ahead;      ///< where scans to come are known and show it
  std::shared_ptr<const MotionAnswer> settled;  ///< parked beyond doubt, as an image since the last
                                                ///< sight told: until the next sight nobody asks

  /// All that is known before the image is looked at.
  [[nodiscard]] TrackState expected_at(Stamp instant, const MotionNoise& noise) const;
  [[nodiscard]] double expected_log_odds() const { return ahead ? ahead->log_odds : log_odds; }
};

/// A scan, as tracks need it.
struct TrackedScan {
  const LidarScan& scan;
  const Pose& T_rest_lidar;
  const Matrix6d& step_covariance;  ///< of the ego-motion since the scan before, a left increment
  std::shared_ptr<const SeenSpace> seen;  ///< not null
};

/// @brief Whether an image since its last sight told something of it that scans to come do not tell
/// better.
[[nodiscard]] bool is_told_by_picture(const ObjectTrack& track, const TrackOptions& options);

/// @brief As images have told, as scans alone tell (images may be wrong, and all in the same way),
/// or any (scans may be, too); as long as nothing has told: its beginnings. The probabilities sum
/// to one.
[[nodiscard]] std::vector<Course> courses_of(const ObjectTrack& track, const TrackOptions& options);

/// @brief Of what images have not told yet, all true: a new object's beginnings, among which it
/// goes with the traffic, or against it.
/// @param ego_velocity over ground, m/s, frame at rest.
[[nodiscard]] std::vector<Course> courses_before_images(const ObjectTrack& track,
                                                        const Eigen::Vector2d& ego_velocity,
                                                        const MotionNoise& noise);

/// Of probability; each way costs a fit per image.
constexpr double kWorthAFit = 1e-3;

struct TrackStore {
  std::vector<ObjectTrack> tracks;
  int next_id = 0;
};

/// Odds are no better known than 1 in 3000: tests of registrations and patches are not.
constexpr double kMostLogOdds = 8;

/// @brief Joins a scan's objects to the tracks, measures how they have moved since their last
/// sight, and forgets tracks of which nothing is known any more.
/// @param objects in and out: pieces of one mover become one.
/// @return the track of each object, a position in `store.tracks`.
std::vector<int> take_up_scan(TrackStore& store, std::vector<ScanObject>& objects,
                              const TrackedScan& scan, const TrackOptions& options);

/// How far an object's points lie from where they are predicted, m: another scan meets others.
constexpr float kReach_m = 0.3F;

/// Side of the cubes that have one point each of an object's surface, m: nearer neighbours tell the
/// noise of their ranges.
constexpr double kFine_m = 0.1;

/// As long may any object be, at least, whatever has been seen of it, m.
constexpr double kCar_m = 4;

/// Whether it moves, by all that is known, for certain enough to be told so.
[[nodiscard]] bool is_mover(const ObjectTrack& track, const TrackOptions& options);

/// Of what moves, after the scans that should have shown it and did not.
[[nodiscard]] double probability_of_being_there(const ObjectTrack& track);

/// Whether its place is known so well, one sigma per axis.
[[nodiscard]] bool is_known_within(const TrackState& state, double sigma_m);

/// @brief Whether it moves, and is known to lie within reach of a place.
/// @param now its state as predicted.
[[nodiscard]] bool is_predictable(const ObjectTrack& track, const TrackState& now,
                                  const TrackOptions& options);

/// @brief T_lidar_then: from the lidar frame of its last sight to another, as it is predicted.
[[nodiscard]] Eigen::Isometry3f from_sight(const ObjectTrack& track, const TrackState& now,
                                           const Pose& T_rest_lidar);

/// @brief Where its points are predicted, in another lidar frame.
[[nodiscard]] std::vector<Eigen::Vector3f> points_by(const ObjectTrack& track,
                                                     const TrackState& now,
                                                     const Pose& T_rest_lidar);

/// @brief It is as predicted by now; all that was seen of it comes along.
void go_on(ObjectTrack& track, TrackState now, const Pose& T_rest_lidar,
           const TrackOptions& options);

/// A scan to come, with its objects.
struct ScanToCome {
  const std::vector<ScanObject>& objects;
  TrackedScan scan;
};

/// @brief What scans to come tell of the tracks: they are filtered on through these scans, and
/// smoothed back to the next sight of each. The tracks themselves stay where they are.
void look_ahead(TrackStore& store, const std::vector<ScanToCome>& to_come,
                const TrackOptions& options);

/// @brief The track of each object: the likeliest one-to-one assignment, where an object is a new
/// one (-1) if no track explains it better (Bar-Shalom et al., 6.4). A track is where it is
/// predicted if it moves and where it was if it is parked, by its odds.
[[nodiscard]] std::vector<int> associate(const std::vector<ObjectTrack>& tracks,
                                         const std::vector<ScanObject>& objects,
                                         const TrackedScan& scan, const TrackOptions& options);

/// @brief Covariance (m^2, axes of the frame at rest) of where a place of the scan before lies now,
/// by the ego-motion's error.
/// @param place lidar frame now.
[[nodiscard]] Eigen::Matrix2d ego_error(const TrackedScan& scan, const Eigen::Vector3d& place);

/// @brief The level axes of a lidar frame in those of the frame at rest.
[[nodiscard]] Eigen::Matrix2d level_axes(const Eigen::Matrix3d& R_rest_lidar);

}  // namespace lidar_upsampling
