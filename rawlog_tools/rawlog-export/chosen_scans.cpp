// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "chosen_scans.h"

#include <mrpt/obs/CSensoryFrame.h>

#include <algorithm>
#include <stdexcept>

#include "lidar_upsampling/io/carriers.h"
#include "lidar_upsampling/io/log_index.h"
#include "lidar_upsampling/virtual_label.h"

namespace lidar_upsampling::exporting {
namespace {

const StreamInfo& stream_of(const LogIndex& index, const std::string& label) {
  if (!label.empty()) {
    if (const auto* stream = index.find(label, StreamKind::lidar)) return *stream;
    throw std::runtime_error(index.path + ": no 3D scans are labelled '" + label +
                             "' (--label); the log holds " + labels_of(index));
  }
  const StreamInfo* found = nullptr;
  for (const StreamInfo* stream : index.of_kind(StreamKind::lidar)) {
    if (!is_virtual_label(stream->label)) continue;
    if (found != nullptr)
      throw std::runtime_error(index.path + ": virtual scans of several labels, " + found->label +
                               " and " + stream->label + ": choose with --label");
    found = stream;
  }
  if (found == nullptr)
    throw std::runtime_error(
        index.path +
        ": no virtual scans (label *_VIRTUAL); choose others with --label; the log holds " +
        labels_of(index));
  return *found;
}

// One of the stream's scans, or all.
struct Chosen {
  std::optional<std::size_t> number;
  std::optional<Stamp> stamp;

  [[nodiscard]] bool holds(std::size_t of_scan, Stamp at) const {
    return (!number || *number == of_scan) && (!stamp || *stamp == at);
  }
};

Chosen chosen_of(const StreamInfo& stream, const Choice& choice, const std::string& path) {
  if (choice.index && *choice.index >= stream.count)
    throw std::runtime_error(path + ": --index " + std::to_string(*choice.index) + ", but '" +
                             stream.label + "' has scans 0 to " + std::to_string(stream.count - 1));
  if (!choice.stamp) return {choice.index, {}};
  if (stream.stamps.empty())
    throw std::runtime_error(path + ": no scan of '" + stream.label + "' has a time stamp");
  return {{}, *std::min_element(stream.stamps.begin(), stream.stamps.end(), [&](Stamp a, Stamp b) {
            return std::abs(seconds_between(*choice.stamp, a)) <
                   std::abs(seconds_between(*choice.stamp, b));
          })};
}

void for_each_observation(const RawlogEntry& entry,
                          const std::function<void(const mrpt::obs::CObservation::Ptr&)>& use) {
  if (auto frame = std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(entry.object)) {
    for (const auto& observation : *frame) use(observation);
  } else if (auto observation = std::dynamic_pointer_cast<mrpt::obs::CObservation>(entry.object)) {
    use(observation);
  }
}

}  // namespace

ReadScans for_each_chosen_scan(const LogFile& log, const Choice& choice,
                               const std::function<void(double)>& progress,
                               const std::function<void(const LidarScan&)>& use) {
  const LogIndex index = index_streams(log);
  const StreamInfo& stream = stream_of(index, choice.label);
  const Chosen chosen = chosen_of(stream, choice, log.path);
  std::size_t number = 0;
  ReadScans read;
  UsableObservations usable(counted_in(read.unused));
  RawlogReader reader(log, RecordBytes::dropped);
  while (const auto entry = reader.next()) {
    for_each_observation(*entry, [&](const mrpt::obs::CObservation::Ptr& observation) {
      if (observation->sensorLabel != stream.label || !is_lidar_scan(*observation)) return;
      if (chosen.holds(number, observation->timestamp)) {
        if (const auto scan = usable.scan(*observation)) use(*scan), ++read.count;
      }
      ++number;
    });
    progress(reader.progress());
  }
  read.damage = reader.damage();
  return read;
}

}  // namespace lidar_upsampling::exporting
