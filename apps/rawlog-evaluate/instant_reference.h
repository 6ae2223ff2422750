// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "evaluation.h"
#include "lidar_upsampling/registration/surface.h"
#include "scan_feed.h"

namespace lidar_upsampling {

/// What a virtual scan is judged by, at its own instant.
struct InstantReference {
  LidarScan scan;                        ///< the nearest withheld scan, brought to the instant
  Pose T_ego = Pose::Identity();         ///< T_lidar_t_lidar_k
  std::vector<ObjectReference> objects;  ///< in view and within range
  std::vector<int> indices;              ///< of each among the key scan's
  std::vector<int> other_points;         ///< of the key scan's other objects, which may move, too
  bool interpolated = false;
  bool by_truth = false;
};

/// The key scan's motions to another scan, by registration.
struct ScanMotions {
  Pose T_ego = Pose::Identity();
  Matrix6d ego_covariance = Matrix6d::Zero();  ///< of a Twist on its left
  struct Object {
    bool known = false;  ///< has been registered
    RegistrationStatus status = RegistrationStatus::too_few_points;
    Pose T_lidar_lidar_k = Pose::Identity();
    double sigma_m = 0;
    bool moving = false;
  };
  std::vector<Object> objects;
};

/// @brief One key scan's objects, and where registration to the scans around finds them. Each is
/// registered to a scan once, however many virtual scans lie beside it.
class RegisteredMotions {
 public:
  /// @param objects of the key scan; both must outlive this.
  RegisteredMotions(const LidarScan& key, const std::vector<ObjectReference>& objects,
                    const EvaluationOptions& options)
      : key_(key), objects_(objects), options_(options) {}

  /// @brief The ego-motion alone; objects as far as they are known.
  /// @param ego_rate per second: where the registration of the ego-motion starts.
  /// @return null where the ego-motion is not found.
  [[nodiscard]] const ScanMotions* to(const LidarScan& scan, const Twist& ego_rate);

  /// Registers those of the objects that are not known yet to a scan that to() knows.
  void find(const LidarScan& scan, const std::vector<int>& which);

 private:
  struct Known {
    ScanMotions motions;
    Surface surface;  // to judge by
  };

  const LidarScan& key_;
  const std::vector<ObjectReference>& objects_;
  const EvaluationOptions& options_;
  std::map<Stamp, std::optional<Known>> known_;
};

/// What an instant's reference is made for and from.
struct InstantRequest {
  const LidarScan& key;
  const std::vector<ObjectReference>& objects;  ///< of the key scan
  const ScansAround& around;
  Stamp stamp;
  const std::vector<Camera>& cameras;
  const EvaluationOptions& options;
};

/// @brief The reference by true boxes and poses. @return none where they do not reach.
[[nodiscard]] std::optional<InstantReference> reference_by_truth(const Truth& truth,
                                                                 const InstantRequest& request);

/// @brief The reference by registration: ego-motion and objects interpolated between the key scan
/// and the scan after it, or two scans, at constant twists over ground; what moves on the scan
/// itself is brought along by its own motion.
/// @param ego_rate per second, a guess. @return none where the ego-motion is not found.
[[nodiscard]] std::optional<InstantReference> reference_by_registration(
    RegisteredMotions& motions, const InstantRequest& request, const Twist& ego_rate);

}  // namespace lidar_upsampling
