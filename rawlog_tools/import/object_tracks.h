// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lidar_upsampling/ego/trajectory.h"
#include "lidar_upsampling/metrics/label_velocity.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling::importing {

/// Where a label puts an object; its frame is in the middle of the box, +X along the length, +Z up.
struct ObjectPose {
  Stamp stamp;
  Pose T_world_object = Pose::Identity();
  bool hidden = false;  ///< the labels say that nothing of it is seen
};

/// One labelled object over the time it was labelled for.
struct ObjectTrack {
  int id = 0;
  std::string class_name;
  Eigen::Vector3d size = Eigen::Vector3d::Zero();  ///< m: length, width, height
  std::vector<ObjectPose> poses;                   ///< ascending stamps, at least one
};

struct ObjectVelocity {
  Eigen::Vector3d linear = Eigen::Vector3d::Zero();  ///< m/s over ground
  double yaw_rate = 0;                               ///< rad/s
};

/// What a log's labels tell of velocities: see metrics/label_velocity.h.
[[nodiscard]] LabelWindow label_window_of(const std::vector<ObjectTrack>& tracks);

/// @brief The velocity at a label: straight lines through the labels about it. None where they are
/// too few.
[[nodiscard]] std::optional<ObjectVelocity> velocity_at(const ObjectTrack& track, std::size_t index,
                                                        const LabelWindow& window);

/// @brief Whether it makes more than 0.5 m/s over the half second before and after: labels jump by
/// centimetres. False where the labels are too few to tell.
[[nodiscard]] bool moves_at(const ObjectTrack& track, std::size_t index, const LabelWindow& window);

/// @brief A track's pose at any time within its labels and up to 60 ms outside, as a picture may be
/// taken just before the first of them or after the last. None elsewhere, and where it is hidden.
class TrackInterpolator {
 public:
  explicit TrackInterpolator(const ObjectTrack& track);
  [[nodiscard]] std::optional<Pose> T_world_object(Stamp stamp) const;

 private:
  [[nodiscard]] bool hidden_at(Stamp stamp) const;

  const ObjectTrack& track_;
  Trajectory trajectory_;
};

/// A data set's class name as one of ours: lower case, no commas.
[[nodiscard]] std::string class_name_from(const std::string& label);

}  // namespace lidar_upsampling::importing
