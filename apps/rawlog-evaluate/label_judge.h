// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

#include "evaluation.h"
#include "key_objects.h"

namespace lidar_upsampling {

/// @brief Gathers what labels and row `constant-velocity` tell of a log's virtual scans, one after
/// the other, and judges all rows at the end.
class LabelJudge {
 public:
  /// @param real_stamps of the LiDAR's scans that the densified log holds. All must outlive this.
  LabelJudge(const Truth& truth, const EvaluationOptions& options,
             const std::vector<Camera>& cameras, std::vector<Stamp> real_stamps);

  /// The key scan of the instants to come.
  /// @param last_motions to the scan before; null if there is none. Both must stay until the next.
  void take_key(const LidarScan& key, const LastMotions* last_motions);
  /// @param told_at the virtual scan's stamp in the log. @param stamp the instant that it is of.
  void note(Stamp stamp, Stamp told_at);

  /// @param told null: the row does not tell of objects.
  [[nodiscard]] LabelScore score(const std::vector<ReportedObject>& told) const {
    return score_labels(instants_, told, options_.labels);
  }
  [[nodiscard]] const std::vector<ReportedObject>& constant_velocity() const {
    return constant_velocity_;
  }
  [[nodiscard]] int num_noted() const { return static_cast<int>(instants_.size()); }
  [[nodiscard]] int num_unlabelled() const { return num_unlabelled_; }

 private:
  [[nodiscard]] bool at_real_scan(Stamp stamp) const;

  const Truth& truth_;
  const EvaluationOptions& options_;
  const std::vector<Camera>& cameras_;
  std::vector<Stamp> real_stamps_;
  const LidarScan* key_ = nullptr;
  std::vector<ObjectReference> clusters_, clusters_before_;  // of the key scan, of that before
  const LastMotions* last_motions_ = nullptr;
  std::vector<LabelledInstant> instants_;
  std::vector<ReportedObject> constant_velocity_;
  int num_unlabelled_ = 0;
};

}  // namespace lidar_upsampling
