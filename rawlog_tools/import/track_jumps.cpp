// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "import/track_jumps.h"

#include <algorithm>
#include <utility>

namespace lidar_upsampling::importing {
namespace {

bool can_be_reached(const ObjectPose& from, const ObjectPose& to) {
  const double step = (to.T_world_object.translation() - from.T_world_object.translation()).norm();
  return step <= std::max(kNoJump, kFastestObject * seconds_between(from.stamp, to.stamp));
}

// The longest first. Of those that a label can be reached from, it belongs to the latest: in time,
// one can come from anywhere.
std::vector<std::vector<ObjectPose>> steady_parts(const ObjectTrack& track) {
  std::vector<std::vector<ObjectPose>> parts;
  for (const ObjectPose& pose : track.poses) {
    std::vector<ObjectPose>* latest = nullptr;
    for (auto& part : parts) {
      const bool is_later = latest == nullptr || part.back().stamp > latest->back().stamp;
      if (is_later && can_be_reached(part.back(), pose)) latest = &part;
    }
    if (latest == nullptr) {
      parts.push_back({pose});
    } else {
      latest->push_back(pose);
    }
  }
  std::stable_sort(parts.begin(), parts.end(),
                   [](const auto& a, const auto& b) { return a.size() > b.size(); });
  return parts;
}

std::string counted(int count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

}  // namespace

SteadyTracks without_jumps(const std::vector<ObjectTrack>& tracks) {
  int last_id = -1;
  for (const ObjectTrack& track : tracks) last_id = std::max(last_id, track.id);
  SteadyTracks steady;
  for (const ObjectTrack& track : tracks) {
    const auto parts = steady_parts(track);
    if (parts.size() > 1) ++steady.num_jumping;
    bool is_split = false;
    for (const auto& part : parts) {
      const bool is_first = &part == &parts.front();
      if (!is_first && part.size() == 1) {
        ++steady.num_left_out;
        continue;
      }
      is_split = is_split || !is_first;
      ObjectTrack own = track;
      own.poses = part;
      if (!is_first) own.id = ++last_id;
      steady.tracks.push_back(std::move(own));
    }
    if (is_split) ++steady.num_split;
  }
  return steady;
}

std::string warning_of(const SteadyTracks& steady) {
  if (steady.num_jumping == 0) return "";
  std::string text = counted(steady.num_jumping, "object") +
                     " with labels that jump by more than " +
                     std::to_string(static_cast<int>(kFastestObject)) + " m/s: ";
  if (steady.num_left_out > 0) text += counted(steady.num_left_out, "label") + " left out";
  if (steady.num_left_out > 0 && steady.num_split > 0) text += ", ";
  if (steady.num_split > 0) text += counted(steady.num_split, "track") + " split";
  return text + " (a number given to two objects, or misplaced boxes?)";
}

}  // namespace lidar_upsampling::importing
