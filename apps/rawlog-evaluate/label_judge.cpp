// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "label_judge.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lidar_upsampling {

namespace {

// A virtual scan this near to a real one that the log still holds has nothing withheld to be judged
// by: people's labels are those of the scans.
constexpr double kAtRealScan_s = 0.015;

/// Objects whose middle is out of view, of which labels in view tell.
std::vector<int> labelled_beyond(const std::vector<ObjectReference>& objects,
                                 const std::vector<int>& seen, const LabelledInstant& instant,
                                 double grown) {
  std::vector<int> which;
  for (int i = 0; i < static_cast<int>(objects.size()); ++i) {
    if (std::binary_search(seen.begin(), seen.end(), i)) continue;
    const auto is_of = [&](const LabelledBox& box) {
      return box.counts && holds(box, objects[i].motion.centroid_k, grown);
    };
    if (std::any_of(instant.boxes.begin(), instant.boxes.end(), is_of)) which.push_back(i);
  }
  return which;
}

}  // namespace

LabelJudge::LabelJudge(const Truth& truth, const EvaluationOptions& options,
                       const std::vector<Camera>& cameras, std::vector<Stamp> real_stamps)
    : truth_(truth), options_(options), cameras_(cameras), real_stamps_(std::move(real_stamps)) {
  std::sort(real_stamps_.begin(), real_stamps_.end());
}

void LabelJudge::take_key(const LidarScan& key, const LastMotions* last_motions) {
  key_ = &key;
  clusters_before_ = std::exchange(clusters_, objects_by_clusters(key));
  last_motions_ = last_motions;
}

bool LabelJudge::at_real_scan(Stamp stamp) const {
  const auto near = [&](auto real) {
    return real != real_stamps_.end() && std::abs(seconds_between(*real, stamp)) < kAtRealScan_s;
  };
  const auto next = std::lower_bound(real_stamps_.begin(), real_stamps_.end(), stamp);
  return near(next) || (next != real_stamps_.begin() && near(std::prev(next)));
}

void LabelJudge::note(Stamp stamp, Stamp told_at) {
  std::optional<LabelledInstant> instant;
  if (key_ != nullptr && key_->stamp < stamp && !at_real_scan(stamp))
    instant = labelled_instant(truth_, *key_, stamp, cameras_, options_.labels);
  if (!instant) {
    ++num_unlabelled_;
    return;
  }
  instant->told_at = told_at.time_since_epoch().count();
  const Pose T_ego = instant->T_lidar_k_lidar_t.inverse();
  const auto seen = in_scope(clusters_, *key_, T_ego, cameras_, options_);
  const auto beyond = labelled_beyond(clusters_, seen, *instant, options_.labels.grown_m);
  for (const auto* which : {&seen, &beyond}) {
    if (last_motions_ != nullptr) last_motions_->find(clusters_, *which, *key_, clusters_before_);
    for (ReportedObject& row :
         constant_velocity_rows(clusters_, *which, T_ego, instant->dt, instant->told_at)) {
      row.in_view = which == &seen;
      constant_velocity_.push_back(std::move(row));
    }
  }
  instants_.push_back(std::move(*instant));
}

}  // namespace lidar_upsampling
