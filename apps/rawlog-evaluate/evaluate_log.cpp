// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <stdexcept>

#include "evaluation.h"
#include "lidar_upsampling/io/log_index.h"
#include "lidar_upsampling/se3.h"
#include "scan_feed.h"

namespace lidar_upsampling {

namespace {

const std::string kEnding = "_VIRTUAL";

bool is_virtual(const std::string& label) {
  return label.size() > kEnding.size() &&
         label.compare(label.size() - kEnding.size(), kEnding.size(), kEnding) == 0;
}

/// The LiDAR whose virtual scans the log holds.
std::string find_label(const LogIndex& input, const std::string& wanted) {
  for (const StreamInfo* stream : input.of_kind(StreamKind::lidar)) {
    if (!is_virtual(stream->label)) continue;
    std::string real = stream->label.substr(0, stream->label.size() - kEnding.size());
    if (wanted.empty() || wanted == real) return real;
  }
  throw std::runtime_error(input.path + ": holds no virtual scans (label " +
                           (wanted.empty() ? "..." : wanted) + kEnding +
                           "); densify it with rawlog-densify. It holds " + labels_of(input));
}

const StreamInfo& reference_stream(const LogIndex& reference, const std::string& label) {
  if (const StreamInfo* same = reference.find(label, StreamKind::lidar)) return *same;
  const auto lidars = reference.of_kind(StreamKind::lidar);
  if (lidars.size() == 1) return *lidars.front();
  throw std::runtime_error(reference.path + ": holds no LiDAR scans with label " + label +
                           ". It holds " + labels_of(reference));
}

std::vector<Camera> calibrated_cameras(const LogIndex& index) {
  std::vector<Camera> cameras;
  for (const StreamInfo* stream : index.of_kind(StreamKind::camera))
    if (stream->calibrated()) cameras.push_back(*stream->camera);
  return cameras;
}

LogIndex whole_index(const std::string& path) {
  LogIndex index = index_log(path);
  if (index.corruption) throw std::runtime_error(*index.corruption);
  return index;
}

/// What is carried from scan to scan.
struct State {
  LidarScan key;
  bool has_key = false;
  Twist ego_rate = Twist::Zero();  ///< per second, of the last ego-motion: the next one's guess
};

}  // namespace

LogResult evaluate_log(const EvaluationJob& job, const std::function<void(double)>& progress) {
  const LogIndex input = whole_index(job.input), reference = whole_index(job.reference);
  LogResult result;
  result.label = find_label(input, job.label);
  result.virtual_label = result.label + kEnding;
  const StreamInfo& truth_scans = reference_stream(reference, result.label);
  const std::vector<Camera> cameras = calibrated_cameras(input);
  std::optional<Truth> truth;
  if (!job.truth_objects.empty()) truth = load_truth(job.truth_objects);

  ReferenceScans references(job.reference, truth_scans.label, truth_scans.stamps, job.tolerance_s);
  ScanFeed feed(job.input, [&](const std::string& label, Stamp) {
    return label == result.label || label == result.virtual_label;
  });
  State state;
  while (auto scan = feed.next()) {
    progress(feed.progress());
    if (scan->label == result.label) {
      state.key = std::move(*scan);
      state.has_key = true;
      continue;
    }
    ++result.num_virtual;
    const LidarScan* match = state.has_key ? references.nearest(scan->stamp) : nullptr;
    const double dt = match ? seconds_between(state.key.stamp, scan->stamp) : 0;
    if (!match || !(dt > 0) || !(match->stamp > state.key.stamp)) {
      ++result.num_unmatched;
      continue;
    }
    Pose T_ego = exp_se3(Twist(state.ego_rate * dt));
    result.scans.push_back(evaluate_scan({state.key, *scan, *match}, truth ? &*truth : nullptr,
                                         cameras, T_ego, job.options, &T_ego));
    state.ego_rate = log_se3(T_ego) / dt;
  }
  if (result.scans.empty())
    throw std::runtime_error(job.reference + ": none of its scans lies within " +
                             std::to_string(job.tolerance_s * 1e3) + " ms of one of the " +
                             std::to_string(result.num_virtual) + " virtual scans of " + job.input);
  return result;
}

}  // namespace lidar_upsampling
