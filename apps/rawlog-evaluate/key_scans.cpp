// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "key_scans.h"

#include <utility>

#include "lidar_upsampling/registration/scan_registration.h"

namespace lidar_upsampling {

void KeyScans::take(LidarScan scan) {
  const auto previous = std::exchange(key_, std::make_shared<KeyScan>());
  key_->scan = std::move(scan);
  if (references_ != nullptr) find_objects();
  if (!previous) return;
  prepare_last_motions(previous->scan);
  key_->objects_before = previous->objects;
}

void KeyScans::find_objects() {
  const LidarScan& key = key_->scan;
  key_->objects = truth_ != nullptr ? objects_by_truth(key, *truth_, options_.min_points_truth)
                                    : objects_by_clusters(key);
  key_->motions.emplace(key, key_->objects, options_);
}

std::shared_ptr<const LidarScan> KeyScans::scan() const {
  return key_ ? std::shared_ptr<const LidarScan>(key_, &key_->scan) : nullptr;
}

const LastMotions* KeyScans::last_motions() const {
  return key_ && key_->last_motions ? &*key_->last_motions : nullptr;
}

void KeyScans::prepare_last_motions(const LidarScan& previous) {
  const double dt = seconds_between(previous.stamp, key_->scan.stamp);
  if (!(dt > 0)) return;
  if (const auto T_previous_key = ego_motion_back_to(previous))
    key_->last_motions.emplace(previous, *T_previous_key, dt);
}

std::optional<Pose> KeyScans::ego_motion_back_to(const LidarScan& previous) const {
  const LidarScan& key = key_->scan;
  if (truth_ != nullptr) {
    const auto T = true_ego_motion(*truth_, previous, key.stamp);
    return T ? std::make_optional(T->inverse()) : std::nullopt;
  }
  const double dt = seconds_between(previous.stamp, key.stamp);
  const auto found = register_scans(key.points, previous.points, exp_se3(Twist(-dt * ego_rate_)));
  return found ? std::make_optional(found->T_target_source) : std::nullopt;
}

std::optional<InstantReference> KeyScans::reference_at(Stamp stamp) {
  const double dt = key_ ? seconds_between(key_->scan.stamp, stamp) : 0;
  if (references_ == nullptr || !(dt > 0)) return {};
  std::optional<InstantReference> reference = motions_to(stamp);
  if (!reference) return {};
  ego_rate_ = log_se3(reference->T_ego) / dt;
  if (!key_->last_motions) return reference;
  key_->last_motions->find(key_->objects, reference->indices, key_->scan, key_->objects_before);
  for (std::size_t i = 0; i < reference->indices.size(); ++i)
    reference->objects[i].last_motion = key_->objects[reference->indices[i]].last_motion;
  return reference;
}

std::optional<InstantReference> KeyScans::motions_to(Stamp stamp) {
  const auto around = references_->around(stamp, key_->scan.stamp);
  if (!around) return {};
  const InstantRequest request{key_->scan, key_->objects, *around, stamp, cameras_, options_};
  return truth_ != nullptr ? reference_by_truth(*truth_, request)
                           : reference_by_registration(*key_->motions, request, ego_rate_);
}

}  // namespace lidar_upsampling
