// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/scan/patch_motions.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>

namespace lidar_upsampling {
namespace {

constexpr int kStatic = -1;  // as in VirtualScan::track_id

}  // namespace

void PatchMotions::append(const PatchMotions& other) {
  const auto first = static_cast<int>(forth.size());
  forth.insert(forth.end(), other.forth.begin(), other.forth.end());
  back.insert(back.end(), other.back.begin(), other.back.end());
  track_id.insert(track_id.end(), other.track_id.begin(), other.track_id.end());
  for (const int motion : other.of_patch)
    of_patch.push_back(motion == kAbsent ? kAbsent : first + motion);
}

PatchMotions motions_of(const std::vector<int>& position, const VirtualScan& moved) {
  PatchMotions motions;
  motions.of_patch.assign(position.size(), PatchMotions::kAbsent);
  const auto add = [&](const Pose& T, int track_id) {
    motions.forth.emplace_back(T);
    motions.back.emplace_back(T.inverse());
    motions.track_id.push_back(track_id);
  };
  add(moved.T_lidar_t_lidar_k, kStatic);
  std::map<int, int> of_track{{kStatic, 0}};
  for (const ObjectMotion& object : moved.objects) {
    of_track[object.track_id] = static_cast<int>(motions.forth.size());
    add(object.T_lidar_t_lidar_k, object.track_id);
  }
  auto motion = of_track.find(kStatic);
  for (std::size_t k = 0; k < moved.source_index.size(); ++k) {
    if (motion->first != moved.track_id[k]) motion = of_track.find(moved.track_id[k]);
    if (motion == of_track.end())
      throw std::invalid_argument("resampling: points of track " +
                                  std::to_string(moved.track_id[k]) + ", but no such object");
    motions.of_patch[position[moved.source_index[k]]] = motion->second;
  }
  return motions;
}

double largest_motion(const std::vector<Eigen::Vector3f>& points, const PatchMotions& motions) {
  constexpr std::size_t kStep = 8;  // of the static scene, which has points enough
  std::vector<float> sum(motions.forth.size(), 0);
  std::vector<int> count(motions.forth.size(), 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const int motion = motions.of_patch[i];
    if (motion == PatchMotions::kAbsent || (motion == 0 && i % kStep != 0)) continue;
    sum[motion] += (motions.forth[motion] * points[i] - points[i]).norm();
    ++count[motion];
  }
  float largest = 0;
  for (std::size_t m = 0; m < sum.size(); ++m)
    if (count[m] > 0) largest = std::max(largest, sum[m] / static_cast<float>(count[m]));
  return largest;
}

}  // namespace lidar_upsampling
