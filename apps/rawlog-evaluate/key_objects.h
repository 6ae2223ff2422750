// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

#include "evaluation.h"
#include "lidar_upsampling/registration/surface.h"

namespace lidar_upsampling {

/// @brief The key scan's clusters that are as large as road users, motion still unknown.
[[nodiscard]] std::vector<ObjectReference> objects_by_clusters(const LidarScan& key);

/// @brief The key scan's objects by true boxes, their points without the ground.
[[nodiscard]] std::vector<ObjectReference> objects_by_truth(const LidarScan& key,
                                                            const Truth& truth, int min_points);

/// @brief Those that a camera sees at an instant (unless `all_around`), within range.
/// @param T_ego T_lidar_t_lidar_k. @return indices of `objects`.
[[nodiscard]] std::vector<int> in_scope(const std::vector<ObjectReference>& objects,
                                        const LidarScan& key, const Pose& T_ego,
                                        const std::vector<Camera>& cameras,
                                        const EvaluationOptions& options);

/// @brief What row `constant-velocity` goes by: objects of a key scan registered to the scan
/// before.
class LastMotions {
 public:
  /// @param T_previous_key ego-motion, lidar frames. @param dt s, between the scans.
  LastMotions(const LidarScan& previous, const Pose& T_previous_key, double dt);

  /// @brief Finds those that are not known yet. Where one of the objects of the scan before,
  /// whose motions are known, may have come, it may go on as that did.
  void find(std::vector<ObjectReference>& objects, const std::vector<int>& which,
            const LidarScan& key, const std::vector<ObjectReference>& before) const;

 private:
  [[nodiscard]] std::vector<Pose> guesses_for(const ObjectReference& object,
                                              const std::vector<ObjectReference>& before) const;

  Surface previous_;  // off the ground
  Pose T_previous_key_;
  double dt_;
};

/// @brief What row `constant-velocity` would tell of these objects at an instant.
/// @param T_ego T_lidar_t_lidar_k. @param dt s, since the key scan.
[[nodiscard]] std::vector<ReportedObject> constant_velocity_rows(
    const std::vector<ObjectReference>& objects, const std::vector<int>& which, const Pose& T_ego,
    double dt, std::int64_t told_at);

}  // namespace lidar_upsampling
