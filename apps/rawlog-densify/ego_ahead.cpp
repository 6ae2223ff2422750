// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "ego_ahead.h"

#include <algorithm>
#include <vector>

namespace lidar_upsampling {
namespace {

constexpr double kLatestBegin_s = 1;  // after the first scan

std::vector<const StreamInfo*> told_by(const LogIndex& streams, StreamKind kind) {
  auto found = streams.of_kind(kind);
  found.erase(std::remove_if(found.begin(), found.end(),
                             [](const StreamInfo* stream) { return stream->stamps.size() < 2; }),
              found.end());
  return found;
}

// Which one of several counts, and what counts where the best comes late, all of a log tells.
bool is_one_from_the_start(const std::vector<const StreamInfo*>& ego, const LogIndex& streams) {
  if (ego.size() != 1) return false;
  const auto lidars = streams.of_kind(StreamKind::lidar);
  return std::all_of(lidars.begin(), lidars.end(), [&](const StreamInfo* lidar) {
    return lidar->stamps.empty() ||
           seconds_between(lidar->stamps.front(), ego.front()->stamps.front()) < kLatestBegin_s;
  });
}

}  // namespace

double span_ahead_s(const Config& config) {
  return std::min(kMostEgoGap_s, config.ego_motion.max_interpolation_gap_s) + kLate_s;
}

std::set<std::string> streams_ahead(const LogIndex& index) {
  std::set<std::string> labels;
  for (const StreamKind kind : {StreamKind::lidar, StreamKind::pose, StreamKind::odometry})
    for (const StreamInfo* const stream : index.of_kind(kind)) labels.insert(stream->label);
  return labels;
}

bool ego_goes_by(const Config& config, const LogIndex& streams) {
  if (config.ego_motion.max_interpolation_gap_s > kMostEgoGap_s || !config.pose_file.path.empty())
    return false;
  if (streams.has_frames) return false;  // their movements are no stream
  const EgoSource source = config.ego_motion.source;
  if (source == EgoSource::camera || source == EgoSource::none) return true;
  const auto poses = told_by(streams, StreamKind::pose);
  const auto odometry = told_by(streams, StreamKind::odometry);
  if (source == EgoSource::poses || (source == EgoSource::automatic && !poses.empty()))
    return is_one_from_the_start(poses, streams);
  if (source == EgoSource::odometry || (source == EgoSource::automatic && !odometry.empty()))
    return is_one_from_the_start(odometry, streams);
  // A heading by GNSS is found from fixes far around.
  return source == EgoSource::automatic && told_by(streams, StreamKind::gnss).empty();
}

}  // namespace lidar_upsampling
