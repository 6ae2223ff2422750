// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "log_streams.h"

#include <mrpt/rtti/CObject.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <stdexcept>

#include "lidar_upsampling/front_end/pose_input.h"
#include "rawlog-densify/ego_ahead.h"

namespace lidar_upsampling {

LogIndices index_logs(const EvaluationJob& job) {
  LogIndices indices;
  LogIndex& input = indices.input;
  mrpt::rtti::registerAllPendingClasses();  // not by two threads at a time
  tbb::parallel_invoke(
      [&] {
        const LogFile log{job.input, job.accept_truncated};
        input = index_streams(log);
        indices.ego_goes_by = !job.paper_row || ego_goes_by(job.paper.config, input);
        if (!indices.ego_goes_by) input = index_log(log);
      },
      [&] {
        if (!job.reference.empty())
          indices.reference = index_streams({job.reference, job.accept_truncated});
      });
  take_poses_from_file(job.paper.config, job.paper.rig, input);
  return indices;
}

ScanLabels find_labels(const LogIndex& input, const std::string& wanted, const Config& config) {
  for (const StreamInfo* real : input.of_kind(StreamKind::lidar)) {
    const std::string dense = config.virtual_label(real->label);
    if ((wanted.empty() || wanted == real->label) && dense != real->label &&
        input.find(dense, StreamKind::lidar) != nullptr)
      return {real->label, dense};
  }
  throw std::runtime_error(
      input.path + ": holds no virtual scans (label " +
      config.virtual_label(wanted.empty() ? "..." : wanted) +
      "); densify it with rawlog-densify, or tell the output_label that it was "
      "densified with (--set). It holds " +
      labels_of(input));
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

LogIndex without_virtual(LogIndex index, const std::string& virtual_label) {
  auto& streams = index.streams;
  streams.erase(std::remove_if(streams.begin(), streams.end(),
                               [&](const StreamInfo& s) { return s.label == virtual_label; }),
                streams.end());
  return index;
}

}  // namespace lidar_upsampling
