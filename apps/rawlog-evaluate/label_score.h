// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lidar_upsampling/types.h"
#include "page/run_report.h"
#include "truth.h"

namespace lidar_upsampling {

struct LabelScoreOptions {
  double mover_mps = 1.0;   ///< faster ones are movers
  double parked_mps = 0.3;  ///< slower ones are parked; what lies between counts as neither
  double grown_m = 0.5;     ///< a box takes what lies this far beside it, labels being loose
  double ignored_px = 10;   ///< the same for areas that nobody labelled
  int min_points = 1;       ///< of the key scan in the box; without any there is nothing to move
  double max_range_m = 70;  ///< of the boxes that count, at the key scan
  bool all_around = false;  ///< boxes outside of the cameras' view count, too
};

/// A labelled object at the key scan of an instant.
struct LabelledBox {
  std::string id, class_name;
  Pose T_box_lidar = Pose::Identity();             ///< lidar frame at the key scan
  Eigen::Vector3d size = Eigen::Vector3d::Zero();  ///< m
  std::optional<Pose> T_lidar_t_lidar_k;           ///< its motion; none: no label at the instant
  /// Over ground, halfway between the key scan and the instant, as which motions since the key scan
  /// are told; lidar frame at the instant.
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  bool velocity_known = true;  ///< else it does not count: too few labels tell of it
  double yaw_rate = 0;  ///< rad/s, where it is told: what turns is nowhere as fast as its centre
  double speed_mps = 0;
  double range_m = 0;  ///< of its centre, at the key scan
  bool counts = true;  ///< its velocity is known, it is in view, within range and hit by the scan;
                       ///< if not, it still takes rows
};

/// A virtual scan that labels tell of.
struct LabelledInstant {
  std::int64_t told_at = 0;                   ///< stamp of the report's rows, MRPT ticks
  double dt = 0;                              ///< s, since the key scan
  Pose T_lidar_k_lidar_t = Pose::Identity();  ///< ego-motion
  Pose T_vehicle_lidar = Pose::Identity();
  std::vector<LabelledBox> boxes;
  std::vector<std::pair<Camera, Box2d>> ignored;  ///< on the pictures at the instant
};

struct MoverSight {
  std::string id, class_name;
  double range_m = 0, speed_mps = 0;
  bool found = false;                 ///< has a row; left standing without
  double error_m = 0, error_mps = 0;  ///< in the plane; error_m: over the horizon
};

struct ParkedSight {
  bool told_to_move = false;
  double shift_m = 0;  ///< over the horizon
};

/// How far a report's row is true to its covariance.
struct RowError {
  std::string status;
  double normalised_sq = 0;  ///< position error squared, in units of its covariance
  double sigma_m = 0;        ///< reported, worst direction
  double error_m = 0;
};

/// How one row of the comparison does by the labels.
struct LabelScore {
  int num_images = 0;
  std::vector<MoverSight> movers;      ///< all that are labelled
  std::vector<ParkedSight> parked;     ///< those with a row
  std::vector<double> false_shifts_m;  ///< of what is told to move and lies in no label
  std::vector<RowError> rows;          ///< all that lie in a label that counts, with a covariance
  int num_followed = 0, num_switches = 0;  ///< objects with a row; changes of their tracks
};

/// @param point_k lidar frame at the key scan. @param grown m, by which the box is larger.
[[nodiscard]] bool holds(const LabelledBox& box, const Eigen::Vector3d& point_k, double grown);

/// @brief The labelled objects at an instant.
/// @param cameras for the view and for the ignored areas.
/// @return none where the labels or the poses do not reach.
[[nodiscard]] std::optional<LabelledInstant> labelled_instant(const Truth& truth,
                                                              const LidarScan& key, Stamp stamp,
                                                              const std::vector<Camera>& cameras,
                                                              const LabelScoreOptions& options);

/// @brief Judges the rows of a report. A row belongs to the box that holds it at the key scan,
/// taken back there by its own velocity, so that a wrong velocity does not hide it; of several the
/// one with most points counts, and one beside the box only where none lies in it. The others may
/// move as well if the object does; of one that is parked they move falsely. Rows out of view are
/// there for boxes that count: a picture may show of an object what the scan does not.
[[nodiscard]] LabelScore score_labels(const std::vector<LabelledInstant>& instants,
                                      const std::vector<ReportedObject>& told,
                                      const LabelScoreOptions& options);

void append(LabelScore& total, const LabelScore& score);

}  // namespace lidar_upsampling
