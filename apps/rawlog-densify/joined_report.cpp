// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <map>
#include <utility>

#include "parts.h"

namespace lidar_upsampling {
namespace {

using Rows = std::vector<ReportRow>;

Eigen::Vector3d position_of(const ReportRow& row) {
  return row.object.T_lidar_t_lidar_k * row.object.centroid_lidar_k;
}

const ReportRow* nearest_row(const Rows& rows, Stamp stamp, const ReportRow& to) {
  const ReportRow* found = nullptr;
  for (const ReportRow& row : rows) {
    if (row.stamp != stamp) continue;
    if (found == nullptr || (position_of(row) - position_of(to)).norm() <
                                (position_of(*found) - position_of(to)).norm())
      found = &row;
  }
  return found;
}

/// Tracks of a part, by the whole's numbers.
class Numbers {
 public:
  explicit Numbers(int& next) : next_(next) {}

  // Both have seen the last instant before the part: what lies at one place then is one.
  void match(const Rows& before, const Rows& warm_up, Stamp stamp) {
    constexpr double kSame_m = 0.5;
    for (const ReportRow& row : warm_up) {
      if (row.stamp != stamp) continue;
      const ReportRow* const there = nearest_row(before, stamp, row);
      if (there == nullptr || (position_of(*there) - position_of(row)).norm() > kSame_m ||
          nearest_row(warm_up, stamp, *there) != &row)
        continue;
      of_.emplace(row.object.track_id, there->object.track_id);
    }
  }

  int of(int track) {
    const auto [number, is_new] = of_.emplace(track, next_);
    if (is_new) ++next_;
    return number->second;
  }

 private:
  std::map<int, int> of_;
  int& next_;
};

void add_counts(DensifyReport& all, const DensifyReport& part) {
  all.num_objects_in += part.num_objects_in;
  all.num_scans += part.num_scans;
  all.num_images += part.num_images;
  all.num_virtual_scans += part.num_virtual_scans;
  all.num_extrapolated += part.num_extrapolated;
  for (const auto& [what, count] : part.resampling) all.resampling[what] += count;
  for (const auto& [kind, warning] : part.warnings) {
    DensifyReport::Warning& joined = all.warnings[kind];
    if (joined.count == 0) joined.first = warning.first;
    joined.count += warning.count;
  }
  for (const auto& [what, count] : part.object_status) all.object_status[what] += count;
  for (const std::string& stage : part.stage_order) {
    if (all.stage_ms.find(stage) == all.stage_ms.end()) all.stage_order.push_back(stage);
    all.stage_ms[stage].add(part.stage_ms.at(stage));
  }
  if (all.carrier.empty()) all.carrier = part.carrier;
}

}  // namespace

DensifyReport joined(std::vector<PartReport> parts, std::shared_ptr<ReportRows> rows) {
  DensifyReport all = parts.front().report.begun_anew();
  all.rows = std::move(rows);
  int next_track = 0;
  for (PartReport& part : parts) {
    Numbers numbers(next_track);
    Pose T_rest_part = Pose::Identity();
    if (part.warm_up.num_virtual_scans > 0 && part.warm_up.last_stamp == all.last_stamp) {
      numbers.match(all.last_rows, part.warm_up.last_rows, all.last_stamp);
      T_rest_part = all.T_rest_lidar_last * part.warm_up.T_rest_lidar_last.inverse();
    }
    const auto renumber = [&](ReportRow& row) {
      row.object.track_id = numbers.of(row.object.track_id);
      row.T_rest_lidar = T_rest_part * row.T_rest_lidar;
    };
    add_counts(all, part.report);
    if (all.rows && part.report.rows) {
      part.report.rows->for_each(
          [&](ReportRow& row) {
            renumber(row);
            all.rows->add(row);
          },
          [&](Stamp stamp, const OtherCluster& cluster) { all.rows->add(stamp, cluster); });
      part.report.rows.reset();
    }
    for (const int track : part.report.tracks) all.tracks.insert(numbers.of(track));
    for (const int track : part.report.moving_tracks) all.moving_tracks.insert(numbers.of(track));
    if (part.report.num_virtual_scans == 0) continue;
    all.last_rows = std::move(part.report.last_rows);
    for (ReportRow& row : all.last_rows) renumber(row);
    all.last_stamp = part.report.last_stamp;
    all.T_rest_lidar_last = T_rest_part * part.report.T_rest_lidar_last;
  }
  return all;
}

}  // namespace lidar_upsampling
