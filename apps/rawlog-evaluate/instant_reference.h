// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "evaluation.h"
#include "scan_feed.h"

namespace lidar_upsampling {

/// What a virtual scan is judged by, at its own instant.
struct InstantReference {
  LidarScan scan;                        ///< the nearest withheld scan, brought to the instant
  Pose T_ego = Pose::Identity();         ///< T_lidar_t_lidar_k
  std::vector<ObjectReference> objects;  ///< in view and within range
  bool interpolated = false;
  bool by_truth = false;
};

/// The key scan's motions to another scan, by registration.
struct ScanMotions {
  Pose T_ego = Pose::Identity();
  struct Object {
    RegistrationStatus status = RegistrationStatus::too_few_points;
    Pose T_lidar_lidar_k = Pose::Identity();
    double sigma_m = 0;
    bool moving = false;
  };
  std::vector<Object> objects;
};

/// @brief One key scan's objects, and where registration to the scans around finds them. Each scan
/// is registered to once, however many virtual scans lie beside it.
class RegisteredMotions {
 public:
  /// @param objects of the key scan; both must outlive this.
  RegisteredMotions(const LidarScan& key, const std::vector<ObjectReference>& objects,
                    const EvaluationOptions& options)
      : key_(key), objects_(objects), options_(options) {}

  /// @param ego_rate per second: where the registration of the ego-motion starts.
  /// @return null where the ego-motion is not found.
  [[nodiscard]] const ScanMotions* to(const LidarScan& scan, const Twist& ego_rate);

 private:
  [[nodiscard]] std::optional<ScanMotions> registered(const LidarScan& scan,
                                                      const Pose& T_ego_guess) const;

  const LidarScan& key_;
  const std::vector<ObjectReference>& objects_;
  const EvaluationOptions& options_;
  std::map<Stamp, std::optional<ScanMotions>> known_;
};

/// @brief The reference by true boxes and poses. @return none where they do not reach.
[[nodiscard]] std::optional<InstantReference> reference_by_truth(
    const Truth& truth, const LidarScan& key, const std::vector<ObjectReference>& objects,
    const ScansAround& around, Stamp stamp);

/// @brief The reference by registration: ego-motion and objects interpolated between the key scan
/// and the scan after it, or two scans, at constant twists over ground; what moves on the scan
/// itself is brought along by its own motion.
/// @return none where the ego-motion is not found.
[[nodiscard]] std::optional<InstantReference> reference_by_registration(
    RegisteredMotions& motions, const LidarScan& key, const std::vector<ObjectReference>& objects,
    const ScansAround& around, Stamp stamp, const Twist& ego_rate);

/// Leaves out objects out of view or range.
void keep_in_scope(InstantReference& reference, const LidarScan& key,
                   const std::vector<Camera>& cameras, const EvaluationOptions& options);

}  // namespace lidar_upsampling
