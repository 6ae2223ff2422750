// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <algorithm>
#include <utility>

#include "lidar_upsampling/key_scan.h"
#include "lidar_upsampling/next_view.h"
#include "lidar_upsampling/objects/motion_to_next.h"
#include "lidar_upsampling/stopwatch.h"
#include "lidar_upsampling/upsampler.h"

// What a log on disk tells of what is to come.

namespace lidar_upsampling {

void LidarUpsampler::expect_scans(std::vector<Stamp> stamps) {
  std::sort(stamps.begin(), stamps.end());
  expected_scans_ = std::move(stamps);
}

void LidarUpsampler::expect_next(const LidarScan& next) {
  if (!key_ || next.stamp <= key_->scan.stamp) return;
  LidarScan straight = next;
  const Pose T_lidar_next_lidar_k = take_up(straight, nullptr);
  const Stopwatch watch(timing_, "next scan");
  SceneSegments segments = segment_scan(straight, config_.segments);
  next_ = std::make_unique<NextScan>(
      NextScan{next.stamp, Surface(without_ground(straight, segments.ground)), T_lidar_next_lidar_k,
               SeenSpace(straight.points, segments.vertical_step_deg), key_->seen.get(),
               segments.vertical_step_deg});
  next_view_ = std::make_unique<NextView>(
      NextView{std::move(straight), T_lidar_next_lidar_k, std::move(segments), nullptr});
  if (key_->resampler)
    next_view_->resampler =
        std::make_unique<const BeamResampler>(next_view_->scan, config_.resampling);
}

void LidarUpsampler::expect_movers(MoverHistory history) { history_ = std::move(history); }

void LidarUpsampler::keep_movers() { found_.emplace(); }

MoverHistory LidarUpsampler::take_movers() {
  return found_ ? std::exchange(*found_, {}) : MoverHistory{};
}

void LidarUpsampler::keep(const std::vector<ObjectMotion>& objects, Stamp instant) {
  for (const ObjectMotion& object : objects)
    if (moves(object))
      movers_[object.track_id] = make_mover(object.class_name, points_at(key_->scan, object.points),
                                            known_at(object, instant));
  found_->back().movers.clear();
  for (const auto& [id, mover] : movers_) found_->back().movers.push_back(mover);
}

}  // namespace lidar_upsampling
