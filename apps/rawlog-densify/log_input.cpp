// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "log_input.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "ego_ahead.h"
#include "lidar_upsampling/front_end/pose_input.h"
#include "streams.h"

namespace lidar_upsampling {
namespace {

// What only a look at all of the log tells.
bool asks_for_all(const Config& config) {
  const PoseFileOptions& file = config.pose_file;
  return (config.sweep.scan_time == ScanTime::azimuth && config.sweep.period_ms <= 0) ||
         config.ego_motion.max_interpolation_gap_s > kMostEgoGap_s ||
         (!file.path.empty() && file.times.empty() && format_of(file) == PoseFileFormat::kitti);
}

// Whether there is the ego-motion that is asked for, and samples close by tell it.
bool has_ego(EgoSource source, const LogIndex& index) {
  const bool has_poses = index.poses.size() >= 2, has_odometry = index.odometry.size() >= 2;
  switch (source) {
    case EgoSource::automatic:
      return has_poses || has_odometry || index.gnss.empty();  // none: the camera's
    case EgoSource::poses:
      return has_poses;
    case EgoSource::odometry:
      return has_odometry;
    case EgoSource::gnss:
      return false;
    case EgoSource::camera:
    case EgoSource::none:
      break;
  }
  return true;
}

bool is_from(const RawlogEntry& entry, Stamp stamp) {
  const auto own = stamp_of(entry);
  return own && *own >= stamp;
}

}  // namespace

LogInput::LogInput(const DensifyJob& job, DensifyReport& report)
    : job_(job),
      report_(report),
      log_({job.input, job.accept_truncated}, span_ahead_s(job.config),
           job.config.compression == Compression::fast) {
  while (!log_.is_full())
    if (read_on() == nullptr) break;
}

LogIndex LogInput::index(bool whole, const std::function<void(double)>& progress) {
  auto beginning = whole ? std::nullopt : index_of_beginning();
  knows_all_ = !beginning || log_.is_at_end();
  if (beginning) return std::move(*beginning);
  log_.look_no_further();
  LogIndex index = index_log({job_.input, job_.accept_truncated}, progress);
  take_poses_from_file(job_.config, job_.rig, index);
  return index;
}

// None: it does not tell enough, or cannot be read again.
std::optional<LogIndex> LogInput::index_of_heavy_beginning() const {
  if (!std::filesystem::is_regular_file(job_.input)) return {};
  RawlogReader reader({job_.input, job_.accept_truncated}, RecordBytes::dropped);
  LogIndexer indexer(job_.input);
  std::optional<Stamp> first, newest;
  while (!first || seconds_between(*first, *newest) < span_ahead_s(job_.config)) {
    const auto entry = reader.next();
    if (!entry) break;
    indexer.add(*entry->object);
    const auto stamp = stamp_of(*entry);
    if (!stamp) continue;
    if (!first) first = stamp;
    newest = newest ? std::max(*newest, *stamp) : *stamp;
  }
  LogIndex index = indexer.take_index();
  // Of several the one with most samples counts, which may be another so far and later.
  if (index.of_kind(StreamKind::pose).size() > 1 || index.of_kind(StreamKind::odometry).size() > 1)
    return {};
  return index;
}

// None: it does not tell enough. What is wrong with it is told of the whole log.
std::optional<LogIndex> LogInput::index_of_beginning() {
  LogIndex index = log_.indexer().index();
  if (log_.is_at_end()) {
    take_poses_from_file(job_.config, job_.rig, index);
    return index;
  }
  try {
    if (asks_for_all(job_.config)) return {};
    if (!log_.spans()) {
      auto heavy = index_of_heavy_beginning();
      if (!heavy) return {};
      index = std::move(*heavy);
    }
    take_poses_from_file(job_.config, job_.rig, index);
    static_cast<void>(select_streams(index, job_.config, labels_of_calibrated(job_.rig)));
    if (!index.has_frames) log_.wait_for(streams_ahead(index), kLate_s);  // theirs are no streams
    if (!log_.spans() && !log_.has_awaited()) return {};
  } catch (const std::exception&) {
    return {};
  }
  if (!has_ego(job_.config.ego_motion.source, index)) return {};
  return index;
}

void LogInput::know_all(const LogIndex& index, bool ego_goes_by) {
  knows_all_ = true;
  ego_goes_by_ = ego_goes_by;
  if (ego_goes_by)
    log_.wait_for(streams_ahead(index), kLate_s);
  else
    log_.look_no_further();
}

void LogInput::take_ego_from(Stamp stamp) {
  const auto add = [&](const auto& news, auto& kept) {
    for (const auto& sample : news)
      if (sample.stamp >= stamp) kept.push_back(sample);
  };
  const EgoNews news = log_.indexer().take_ego();
  add(news.poses, passed_.poses);
  add(news.odometry, passed_.odometry);
  add(news.gnss, passed_.gnss);
}

void LogInput::skip_to(Stamp stamp) {
  for (;;) {
    if (log_.waiting().empty() && read_on() == nullptr) return;
    if (is_from(log_.waiting().front(), stamp)) return;
    static_cast<void>(log_.next());
    if (ego_goes_by_) take_ego_from(shifted(stamp, -kEgoMemory_s));
  }
}

std::optional<RawlogEntry> LogInput::next(Densification& run, std::optional<Stamp> end) {
  if (ego_goes_by_) {
    run.go_on_by(std::exchange(passed_, {}));
    run.go_on_by(log_.indexer().take_ego());
  }
  for (; num_told_ < log_.waiting().size(); ++num_told_) run.look_ahead(log_.waiting()[num_told_]);
  while (!log_.is_full() || run.wants_scans()) {
    const RawlogEntry* const entry = read_on();
    if (entry == nullptr) break;
    if (!knows_all_) run.learn(log_.indexer());
    if (ego_goes_by_) run.go_on_by(log_.indexer().take_ego());
    run.look_ahead(*entry);
    ++num_told_;
  }
  if (end && !log_.waiting().empty() && is_from(log_.waiting().front(), *end)) return {};
  auto entry = log_.next();
  if (entry) --num_told_;
  return entry;
}

const RawlogEntry* LogInput::read_on() {
  if (log_.is_at_end()) return nullptr;
  const Timed reading(report_, "reading");
  const RawlogEntry* const entry = log_.read_on();
  if (log_.corruption()) report_.warn(*log_.corruption());
  return entry;
}

}  // namespace lidar_upsampling
