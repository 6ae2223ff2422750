// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/scan/resample.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

#include "lidar_upsampling/scan/beams.h"
#include "lidar_upsampling/scan/caster.h"
#include "lidar_upsampling/scan/compose.h"
#include "lidar_upsampling/scan/patch_index.h"

namespace lidar_upsampling {

namespace {

// What beams may hit: patches of one scan or two, and the rows that they are of.
struct JoinedPatches {
  PatchRefs patches;
  std::vector<BeamRow> rows;
  std::vector<std::vector<Patch>> anew;  // of each row, what `patches` has in place of a scan's own
};

}  // namespace

/// All that does not change between the images of a key scan.
struct BeamResampler::Sensor {
  Sensor(const LidarScan& key, BeamPattern found, const ResampleOptions& options);

  void join(const PatchMotions& motions, int at_rest, JoinedPatches& joined) const;
  // @param other whose patches come after the own ones; null: none.
  void take_hits(const PatchMotions& motions, const std::vector<std::vector<BeamHit>>& hits,
                 const Sensor* other, VirtualScan& result) const;

  std::vector<int> source;    // of each point below, in the key scan
  std::vector<int> position;  // the reverse
  // All below is in the order of beams, so that memory is walked through, not jumped about in.
  BeamPattern pattern;
  LidarScan scan;
  Columns columns;
  std::vector<RowBeams> beams;  // of each row
  bool columns_to_left;
  PatchMaker maker;
  std::vector<Patch> patches;  // as if nothing moved but the sensor
};

namespace {

void check(std::size_t num_points, const VirtualScan& moved) {
  const std::size_t size = moved.source_index.size();
  const bool fits = moved.track_id.size() == size &&
                    std::all_of(moved.source_index.begin(), moved.source_index.end(), [&](int i) {
                      return i >= 0 && static_cast<std::size_t>(i) < num_points;
                    });
  if (!fits)
    throw std::invalid_argument("resampling: the virtual scan of " + std::to_string(size) +
                                " points was not made from the key scan of " +
                                std::to_string(num_points));
}

LidarScan in_order(const LidarScan& key, const std::vector<int>& order) {
  LidarScan scan;
  scan.points = taken(key.points, order);
  take_fields(key, order, scan);
  return scan;
}

BeamPattern in_order(BeamPattern pattern) {
  std::iota(pattern.order.begin(), pattern.order.end(), 0);
  return pattern;
}

std::vector<int> inverse(const std::vector<int>& order) {
  std::vector<int> result(order.size());
  for (int k = 0; k < static_cast<int>(order.size()); ++k) result[order[k]] = k;
  return result;
}

// Those patches that a mover's outline changes, on both sides of it.
// @param motion of each patch. @param at_rest the motion of the static scene.
std::vector<std::uint8_t> changed_by_movers(const std::vector<BeamNeighbours>& neighbours,
                                            const int* motion, int at_rest) {
  std::vector<std::uint8_t> is_changed(neighbours.size(), 0);
  for (int i = 0; i < static_cast<int>(is_changed.size()); ++i) {
    if (motion[i] <= at_rest) continue;
    for (const Side side : {kRight, kLeft, kDown, kUp})
      // Those of the next one lead here, too, if they go on straight.
      for (int other = i, step = 0; step < 2; ++step) {
        other = neighbours[other][side];
        if (other < 0) break;
        if (motion[other] != motion[i]) is_changed[i] = is_changed[other] = 1;
      }
  }
  return is_changed;
}

// What the beams of all rows hit; beams that hit nothing are left out.
std::vector<std::vector<BeamHit>> cast_all(const CastScene& scene,
                                           const std::vector<RowBeams>& beams,
                                           const ResampleOptions& options) {
  std::vector<std::vector<BeamHit>> hits(beams.size());
  tbb::enumerable_thread_specific<RowCaster> casters([&] { return RowCaster(scene, options); });
  tbb::parallel_for(std::size_t{0}, beams.size(), [&](std::size_t row) {
    hits[row] = casters.local().cast(static_cast<int>(row), beams[row]);
  });
  return hits;
}

void resize(std::size_t size, const LidarScan& key, VirtualScan& result) {
  LidarScan& scan = result.scan;
  scan.points.resize(size);
  scan.ring.resize(size);
  scan.intensity.resize(key.intensity.empty() ? 0 : size);
  scan.column.resize(key.column.empty() ? 0 : size);
  scan.time_s.resize(key.time_s.empty() ? 0 : size);
  result.source_index.resize(size);
  result.track_id.resize(size);
}

}  // namespace

BeamResampler::Sensor::Sensor(const LidarScan& key, BeamPattern found,
                              const ResampleOptions& options)
    : source(found.order),
      position(inverse(source)),
      pattern(in_order(std::move(found))),
      scan(in_order(key, source)),
      columns(pattern.azimuth_pitch),
      beams(pattern.num_rows()),
      columns_to_left(columns_go_left(scan, pattern)),
      maker(scan.points, pattern, options.patches),
      patches(key.size()) {
  const std::vector<bool> seen = seen_directions(pattern);
  tbb::parallel_for(0, pattern.num_rows(), [&](int r) {
    const BeamRow& row = pattern.rows[r];
    RowBeams& own = beams[r];
    own.beams = find_beams(scan, pattern, r, seen);
    own.first = first_of_columns(own.beams, columns);
    for (int k = row.begin; k < row.end; ++k) patches[k] = maker.make(r, k);
  });
}

// Ring, column and time are the beam's, intensity and object those of the patch that was hit.
void BeamResampler::Sensor::take_hits(const PatchMotions& motions,
                                      const std::vector<std::vector<BeamHit>>& hits,
                                      const Sensor* other, VirtualScan& result) const {
  const auto num_own = static_cast<int>(patches.size());
  std::vector<std::size_t> begin(hits.size() + 1, 0);
  for (std::size_t row = 0; row < hits.size(); ++row)
    begin[row + 1] = begin[row] + hits[row].size();
  resize(begin.back(), scan, result);
  tbb::parallel_for(std::size_t{0}, hits.size(), [&](std::size_t row) {
    LidarScan& to = result.scan;
    const Eigen::Vector3f origin = pattern.rows[row].origin();
    std::size_t i = begin[row];
    for (const BeamHit& hit : hits[row]) {
      const Beam& beam = beams[row].beams[hit.beam];
      const BeamLabel label = label_of(beam, scan, columns_to_left);
      to.points[i] = origin + hit.range * beam.direction;
      to.ring[i] = label.ring;
      if (!to.column.empty()) to.column[i] = label.column;
      if (!to.time_s.empty()) to.time_s[i] = label.time_s;
      const bool is_own = hit.patch < num_own;
      if (!to.intensity.empty())
        to.intensity[i] =
            is_own ? scan.intensity[hit.patch] : other->scan.intensity[hit.patch - num_own];
      result.source_index[i] = is_own ? source[hit.patch] : -1;
      result.track_id[i] = motions.track_id[motions.of_patch[hit.patch]];
      ++i;
    }
  });
}

BeamResampler::BeamResampler(const LidarScan& key_scan, const ResampleOptions& options)
    : num_points_(key_scan.size()), options_(options) {
  if (auto pattern = find_beam_pattern(key_scan))
    sensor_ = std::make_unique<const Sensor>(key_scan, std::move(*pattern), options);
}

BeamResampler::~BeamResampler() = default;

// Adds these patches, those at movers made anew, and their rows, to those that are there already.
void BeamResampler::Sensor::join(const PatchMotions& motions, int at_rest,
                                 JoinedPatches& joined) const {
  const auto first = static_cast<int>(joined.patches.size());
  const std::size_t first_row = joined.rows.size();
  joined.patches.append(patches);
  joined.anew.resize(first_row + pattern.rows.size());
  const int* const motion = motions.of_patch.data() + first;
  const auto is_changed = changed_by_movers(maker.neighbours(), motion, at_rest);
  tbb::parallel_for(0, pattern.num_rows(), [&](int r) {
    const BeamRow& row = pattern.rows[r];
    std::vector<Patch>& anew = joined.anew[first_row + r];
    anew.reserve(std::count(is_changed.data() + row.begin, is_changed.data() + row.end, 1));
    for (int i = row.begin; i < row.end; ++i) {
      if (is_changed[i] == 0) continue;
      anew.push_back(maker.make(r, i, motion));
      joined.patches.replace(first + i, anew.back());
    }
  });
  for (BeamRow row : pattern.rows) {
    row.begin += first;
    row.end += first;
    joined.rows.push_back(row);
  }
}

VirtualScan BeamResampler::resample(VirtualScan moved, const OtherView* other) const {
  check(num_points_, moved);
  moved.resampling = Resampling::no_beams;
  if (!sensor_) return moved;
  PatchMotions motions = motions_of(sensor_->position, moved);
  moved.resampling = Resampling::little_motion;
  if (largest_motion(sensor_->scan.points, motions) < options_.min_motion_m) return moved;
  moved.resampling = Resampling::done;

  JoinedPatches joined;
  sensor_->join(motions, 0, joined);
  const Sensor* second = other == nullptr ? nullptr : other->scan.sensor_.get();
  const bool needs_intensity = !sensor_->scan.intensity.empty();
  if (second != nullptr && needs_intensity && second->scan.intensity.empty()) second = nullptr;
  if (second != nullptr) {
    check(other->scan.num_points_, other->moved);
    const auto at_rest = static_cast<int>(motions.forth.size());
    motions.append(motions_of(second->position, other->moved));
    second->join(motions, at_rest, joined);
  }

  const BeamPattern& pattern = sensor_->pattern;
  // As far from its centre as a patch may be hit, 1: its edge.
  const auto reach = static_cast<float>(std::max(1 + options_.overlap, options_.max_gap));
  std::vector<FootprintsOfRow> footprints(joined.rows.size());
  tbb::parallel_for(std::size_t{0}, footprints.size(), [&](std::size_t i) {
    footprints[i] =
        find_footprints(joined.rows[i], pattern, sensor_->columns, joined.patches, motions, reach);
  });
  const auto hits =
      cast_all({pattern, joined.patches, motions, footprints}, sensor_->beams, options_);
  sensor_->take_hits(motions, hits, second, moved);
  return moved;
}

}  // namespace lidar_upsampling
