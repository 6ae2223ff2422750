// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/scan/resample.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

#include "lidar_upsampling/scan/beams.h"
#include "lidar_upsampling/scan/caster.h"
#include "lidar_upsampling/scan/patch_index.h"
#include "lidar_upsampling/scan/taken.h"

namespace lidar_upsampling {

/// All that does not change between the images of a key scan.
struct BeamResampler::Sensor {
  Sensor(const LidarScan& key, BeamPattern found, const ResampleOptions& options);

  std::vector<int> source;    // of each point below, in the key scan
  std::vector<int> position;  // the reverse
  // All below is in the order of beams, so that memory is walked through, not jumped about in.
  BeamPattern pattern;
  LidarScan scan;
  std::vector<std::vector<Beam>> beams;        // of each row
  std::vector<std::vector<BeamLabel>> labels;  // of each beam
  PatchMaker maker;
  std::vector<Patch> patches;  // as if nothing moved but the sensor
  std::vector<PatchOutline> outlines;
};

namespace {

constexpr int kAbsent = -1;
constexpr int kStatic = -1;  // as in VirtualScan::track_id

void check(const LidarScan& key, const VirtualScan& moved) {
  const std::size_t size = moved.scan.size();
  const bool fits = moved.source_index.size() == size && moved.track_id.size() == size &&
                    std::all_of(moved.source_index.begin(), moved.source_index.end(), [&](int i) {
                      return i >= 0 && static_cast<std::size_t>(i) < key.size();
                    });
  if (!fits)
    throw std::invalid_argument("resampling: the virtual scan of " + std::to_string(size) +
                                " points was not made from the key scan of " +
                                std::to_string(key.size()));
}

LidarScan in_order(const LidarScan& key, const std::vector<int>& order) {
  LidarScan scan;
  scan.points = taken(key.points, order);
  take_fields(key, order, scan);
  return scan;
}

BeamPattern in_order(BeamPattern pattern, const std::vector<int>& order) {
  pattern.azimuth = taken(pattern.azimuth, order);
  std::iota(pattern.order.begin(), pattern.order.end(), 0);
  return pattern;
}

std::vector<int> inverse(const std::vector<int>& order) {
  std::vector<int> result(order.size());
  for (int k = 0; k < static_cast<int>(order.size()); ++k) result[order[k]] = k;
  return result;
}

// The static scene's motion comes first.
// @param position of each point of the key scan, among the patches.
PatchMotions motions_of(const std::vector<int>& position, const VirtualScan& moved) {
  PatchMotions motions;
  motions.of_patch.assign(position.size(), kAbsent);
  const auto add = [&](const Pose& T) {
    motions.forth.emplace_back(T);
    motions.back.emplace_back(T.inverse());
  };
  add(moved.T_lidar_t_lidar_k);
  std::map<int, int> of_track{{kStatic, 0}};
  for (const ObjectMotion& object : moved.objects) {
    of_track[object.track_id] = static_cast<int>(motions.forth.size());
    add(object.T_lidar_t_lidar_k);
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

// How far the static scene or an object moves, whichever moves most; mean over its points.
double largest_motion(const std::vector<Eigen::Vector3f>& points, const PatchMotions& motions) {
  std::vector<float> sum(motions.forth.size(), 0);
  std::vector<int> count(motions.forth.size(), 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const int motion = motions.of_patch[i];
    if (motion == kAbsent) continue;
    sum[motion] += (motions.forth[motion] * points[i] - points[i]).norm();
    ++count[motion];
  }
  float largest = 0;
  for (std::size_t m = 0; m < sum.size(); ++m)
    if (count[m] > 0) largest = std::max(largest, sum[m] / static_cast<float>(count[m]));
  return largest;
}

// The patches that a mover's outline changes: its own, and those beside it.
std::vector<int> at_movers(const PatchMaker& maker, const PatchMotions& motions) {
  std::vector<std::uint8_t> is_taken(motions.of_patch.size(), 0);
  std::vector<int> points;
  const auto take = [&](int i) {
    if (i < 0 || is_taken[i] != 0) return;
    is_taken[i] = 1;
    points.push_back(i);
  };
  for (int i = 0; i < static_cast<int>(motions.of_patch.size()); ++i) {
    if (motions.of_patch[i] <= 0) continue;
    take(i);
    const BeamNeighbours& around = maker.neighbours(i);
    for (const auto& side : {around.right, around.left, around.down, around.up})
      for (const int neighbour : side) take(neighbour);
  }
  return points;
}

// What the beams of a row hit; beams that hit nothing are left out.
struct RowHits {
  std::vector<Eigen::Vector3f> points;
  std::vector<BeamLabel> labels;
  std::vector<int> patches;
};

template <typename T, typename ValueOf>
void take_all(const std::vector<RowHits>& rows, std::vector<T>& values, const ValueOf& value_of) {
  std::size_t size = 0;
  for (const RowHits& row : rows) size += row.points.size();
  values.clear();
  values.reserve(size);
  for (const RowHits& row : rows)
    for (std::size_t k = 0; k < row.points.size(); ++k) values.push_back(value_of(row, k));
}

// Ring, column and time are the beam's, intensity and object those of the point that was hit.
// @param source of each patch, in the key scan.
void take_hits(const LidarScan& key, const std::vector<int>& source,
               const std::vector<RowHits>& rows, VirtualScan& result) {
  std::vector<int> track_of_point(source.size(), kStatic);
  for (std::size_t k = 0; k < result.source_index.size(); ++k)
    track_of_point[result.source_index[k]] = result.track_id[k];
  LidarScan& scan = result.scan;
  take_all(rows, scan.points, [](const RowHits& row, std::size_t k) { return row.points[k]; });
  take_all(rows, scan.ring, [](const RowHits& row, std::size_t k) { return row.labels[k].ring; });
  if (!key.column.empty())
    take_all(rows, scan.column,
             [](const RowHits& row, std::size_t k) { return row.labels[k].column; });
  if (!key.time_s.empty())
    take_all(rows, scan.time_s,
             [](const RowHits& row, std::size_t k) { return row.labels[k].time_s; });
  take_all(rows, result.source_index,
           [&](const RowHits& row, std::size_t k) { return source[row.patches[k]]; });
  take_all(rows, result.track_id, [&](const RowHits& row, std::size_t k) {
    return track_of_point[source[row.patches[k]]];
  });
  if (!key.intensity.empty())
    take_all(rows, scan.intensity, [&](const RowHits& row, std::size_t k) {
      return key.intensity[source[row.patches[k]]];
    });
}

}  // namespace

BeamResampler::Sensor::Sensor(const LidarScan& key, BeamPattern found,
                              const ResampleOptions& options)
    : source(found.order),
      position(inverse(source)),
      pattern(in_order(std::move(found), source)),
      scan(in_order(key, source)),
      beams(pattern.num_rows()),
      labels(pattern.num_rows()),
      maker(scan, pattern, options.patches),
      patches(maker.make_all(std::vector<int>(key.size(), 0))),
      outlines(key.size()) {
  const std::vector<bool> seen = seen_directions(pattern);
  const bool to_left = columns_go_left(scan, pattern);
  const auto overlap = static_cast<float>(1 + options.overlap);
  tbb::parallel_for(0, pattern.num_rows(), [&](int row) {
    beams[row] = find_beams(scan, pattern, row, seen);
    for (const Beam& beam : beams[row]) labels[row].push_back(label_of(beam, scan, to_left));
    for (int k = pattern.rows[row].begin; k < pattern.rows[row].end; ++k)
      outlines[k] = outline_of(patches[k], overlap);
  });
}

BeamResampler::BeamResampler(const LidarScan& key_scan, const ResampleOptions& options)
    : key_scan_(key_scan), options_(options) {
  if (auto pattern = find_beam_pattern(key_scan))
    sensor_ = std::make_unique<const Sensor>(key_scan, std::move(*pattern), options);
}

BeamResampler::~BeamResampler() = default;

VirtualScan BeamResampler::resample(VirtualScan moved) const {
  check(key_scan_, moved);
  moved.resampling = Resampling::no_beams;
  if (!sensor_) return moved;
  const PatchMotions motions = motions_of(sensor_->position, moved);
  moved.resampling = Resampling::little_motion;
  if (largest_motion(sensor_->scan.points, motions) < options_.min_motion_m) return moved;
  moved.resampling = Resampling::done;

  PatchSet patches{
      sensor_->patches, sensor_->outlines, std::vector<int>(key_scan_.size(), -1), {}, {}};
  for (const int i : at_movers(sensor_->maker, motions)) {
    patches.replacement[i] = static_cast<int>(patches.new_patches.size());
    patches.new_patches.push_back(sensor_->maker.make(i, motions.of_patch));
    patches.new_outlines.push_back(
        outline_of(patches.new_patches.back(), static_cast<float>(1 + options_.overlap)));
  }
  const PatchIndex index(sensor_->pattern, patches, motions);
  const BeamPattern& pattern = sensor_->pattern;
  std::vector<RowHits> rows(pattern.rows.size());
  tbb::parallel_for(0, pattern.num_rows(), [&](int row) {
    Caster caster(patches, motions, index, options_);
    RowHits& hits = rows[row];
    const Eigen::Vector3f origin = pattern.rows[row].origin();
    for (std::size_t k = 0; k < sensor_->beams[row].size(); ++k) {
      const Beam& beam = sensor_->beams[row][k];
      const BeamHit hit = caster.cast({origin, beam.direction}, row, beam);
      if (hit.patch < 0) continue;
      hits.points.emplace_back(origin + hit.range * beam.direction);
      hits.labels.push_back(sensor_->labels[row][k]);
      hits.patches.push_back(hit.patch);
    }
  });
  take_hits(key_scan_, sensor_->source, rows, moved);
  return moved;
}

}  // namespace lidar_upsampling
