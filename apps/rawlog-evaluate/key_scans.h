// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "instant_reference.h"
#include "key_objects.h"

namespace lidar_upsampling {

/// @brief The key scans of a log, one after the other, and what virtual scans are judged by until
/// the next: its objects, and where they are by truth or by registration.
class KeyScans {
 public:
  /// @param truth null: by registration. @param references null: by labels alone, which take no
  /// more than last_motions(). All must outlive this.
  KeyScans(const EvaluationOptions& options, const std::vector<Camera>& cameras, const Truth* truth,
           ReferenceScans* references)
      : options_(options), cameras_(cameras), truth_(truth), references_(references) {}

  void take(LidarScan scan);

  /// The last one taken; null: none was.
  [[nodiscard]] std::shared_ptr<const LidarScan> scan() const;
  /// Of its objects, since the scan before. @return null where there is none, or its ego-motion is
  /// not found.
  [[nodiscard]] const LastMotions* last_motions() const;

  /// @return none: no scan to judge by is near, or it does not come after the key scan.
  [[nodiscard]] std::optional<InstantReference> reference_at(Stamp stamp);

 private:
  /// A key scan and all that is judged once for it.
  struct KeyScan {
    LidarScan scan;
    std::vector<ObjectReference> objects, objects_before;
    std::optional<RegisteredMotions> motions;
    std::optional<LastMotions> last_motions;
  };

  void find_objects();
  void prepare_last_motions(const LidarScan& previous);
  [[nodiscard]] std::optional<Pose> ego_motion_back_to(const LidarScan& previous) const;
  [[nodiscard]] std::optional<InstantReference> motions_to(Stamp stamp);

  const EvaluationOptions& options_;
  const std::vector<Camera>& cameras_;
  const Truth* truth_;
  ReferenceScans* references_;
  std::shared_ptr<KeyScan> key_;
  Twist ego_rate_ = Twist::Zero();  ///< per second, of the last ego-motion: the next one's guess
};

}  // namespace lidar_upsampling
