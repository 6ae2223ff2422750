// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lidar_upsampling/ego/trajectory.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// A box of known motion, a simulator's or a label's; its pose is that of its centre.
struct TrueObject {
  std::string id, class_name;
  Eigen::Vector3d size = Eigen::Vector3d::Zero();  ///< m: length, width, height
  Trajectory T_world_object;
  std::map<Stamp, bool> moving;
  std::map<Stamp, Eigen::Vector3d> velocity;  ///< m/s in the world, at the labels that tell one
  std::map<Stamp, double> yaw_rate;           ///< rad/s, likewise

  /// At the nearest stamp known.
  [[nodiscard]] bool moves_at(Stamp stamp) const;
  /// Between two labels that tell one, or within 60 ms of one. @return none further off.
  [[nodiscard]] std::optional<Eigen::Vector3d> velocity_at(Stamp stamp) const;
  /// At the nearest label; 0 where none tells one.
  [[nodiscard]] double yaw_rate_at(Stamp stamp) const;
};

/// An area of a camera's picture with objects that nobody labelled.
struct IgnoredArea {
  std::string camera;
  Box2d box;
};

/// What a simulator knows exactly, or people have labelled.
struct Truth {
  Trajectory T_world_vehicle;
  std::vector<TrueObject> objects;
  std::multimap<Stamp, IgnoredArea> ignored;
  std::vector<std::string> warnings;  ///< what is wrong with the labels, and how often
};

/// @brief Reads `<stem>_objects.csv` and, beside it, `<stem>_ego.csv` and, if there is one,
/// `<stem>_ignored.csv`, as rawlog-simulate and the importers write them. Columns that may be left
/// out: pitch, roll; vx, vy, vz (then fitted to the neighbouring boxes' centres); moving (then by
/// the speed).
/// @throw std::runtime_error naming the file, line and column at fault.
[[nodiscard]] Truth load_truth(const std::string& objects_csv);

/// @brief What load_truth() reads. @throw std::runtime_error it is no `<stem>_objects.csv`.
[[nodiscard]] std::vector<std::string> truth_tables(const std::string& objects_csv);

/// Where the truth takes points of the key scan: T_lidar_t_lidar_k of the ego-motion, or of an
/// object since the scan saw it. None where the truth does not reach.
[[nodiscard]] std::optional<Pose> true_ego_motion(const Truth& truth, const LidarScan& key,
                                                  Stamp stamp);
[[nodiscard]] std::optional<Pose> true_object_motion(const Truth& truth, const TrueObject& object,
                                                     const LidarScan& key, Stamp stamp);

/// @brief The scan as it would have been at another instant close by: the scene moved by the true
/// ego-motion, each object by its own. Where the truth does not reach, the scan as it is.
[[nodiscard]] LidarScan brought_to(const Truth& truth, const LidarScan& scan, Stamp stamp);

/// T_object_lidar at the key scan.
[[nodiscard]] std::optional<Pose> box_in_scan(const Truth& truth, const TrueObject& object,
                                              const LidarScan& key);

/// The same when the scan saw it, which of a straightened sweep was not at the stamp.
[[nodiscard]] std::optional<Pose> box_as_seen(const Truth& truth, const TrueObject& object,
                                              const LidarScan& key);

}  // namespace lidar_upsampling
