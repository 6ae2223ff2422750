// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/scan/resample.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include "lidar_upsampling/scan/beams.h"
#include "lidar_upsampling/scan/patch_index.h"

namespace lidar_upsampling {
namespace {

constexpr int kAbsent = -1;
constexpr int kStatic = -1;  // as in VirtualScan::track_id

// What moves each point of the key scan: a position in `transforms`, kAbsent for points that are
// not part of the virtual scan.
struct PointMotions {
  std::vector<Eigen::Isometry3f> transforms;
  std::vector<int> of_point;
};

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

PointMotions motions_of(std::size_t num_points, const VirtualScan& moved) {
  PointMotions motions{{moved.T_lidar_t_lidar_k.cast<float>()},
                       std::vector<int>(num_points, kAbsent)};
  std::map<int, int> of_track{{kStatic, 0}};
  for (const ObjectMotion& object : moved.objects) {
    of_track[object.track_id] = static_cast<int>(motions.transforms.size());
    motions.transforms.push_back(object.T_lidar_t_lidar_k.cast<float>());
  }
  for (std::size_t k = 0; k < moved.source_index.size(); ++k) {
    const auto motion = of_track.find(moved.track_id[k]);
    if (motion == of_track.end())
      throw std::invalid_argument("resampling: points of track " +
                                  std::to_string(moved.track_id[k]) + ", but no such object");
    motions.of_point[moved.source_index[k]] = motion->second;
  }
  return motions;
}

// How far the static scene or an object moves, whichever moves most; mean over its points.
double largest_motion(const LidarScan& key, const PointMotions& motions) {
  std::vector<double> sum(motions.transforms.size(), 0);
  std::vector<int> count(motions.transforms.size(), 0);
  for (std::size_t i = 0; i < key.size(); ++i) {
    const int motion = motions.of_point[i];
    if (motion == kAbsent) continue;
    sum[motion] += (motions.transforms[motion] * key.points[i] - key.points[i]).norm();
    ++count[motion];
  }
  double largest = 0;
  for (std::size_t m = 0; m < sum.size(); ++m)
    if (count[m] > 0) largest = std::max(largest, sum[m] / count[m]);
  return largest;
}

struct Ray {
  Eigen::Vector3f origin, direction;
};

struct Hit {
  int patch = -1;
  float range = 0;
  float offset = 0;  // from the patch's centre, 1: at its edge
};

Hit hit_of(const Ray& ray, const Patch& patch, int number) {
  Hit hit{number, 0, 0};
  const Eigen::Vector3f from = ray.origin - patch.origin;
  const float range = (1 - patch.slope.dot(from)) / patch.slope.dot(ray.direction);
  const Eigen::Vector3f seen = patch.axes.transpose() * (from + range * ray.direction);
  if (!(range > 0) || !(seen.x() > 0)) return hit;  // parallel, or seen from behind
  const float x = seen.y() / seen.x(), y = seen.z() / seen.x();
  hit.range = range;
  hit.offset = std::max(std::abs(x) / (x < 0 ? patch.right : patch.left),
                        std::abs(y) / (y < 0 ? patch.down : patch.up));
  return hit;
}

// The first surface in the ray's way.
class Caster {
 public:
  Caster(const std::vector<Patch>& patches, const PatchIndex& index, const ResampleOptions& options)
      : patches_(patches), index_(index), options_(options) {}

  // A hit with range > 0, or none (patch -1).
  Hit cast(const Ray& ray, int row, const Beam& beam) {
    hits_.clear();
    index_.visit_cell(row, beam.azimuth, [&](int i) { add(ray, i, 1 + options_.overlap); });
    if (hits_.empty()) {
      // Where nothing came back before, nothing is expected but what has moved there.
      if (beam.point < 0) return {};
      return nearest_by(ray, row, beam.azimuth);
    }
    float range = std::numeric_limits<float>::infinity();
    for (const Hit& hit : hits_) range = std::min(range, hit.range);
    return blended(range);
  }

 private:
  void add(const Ray& ray, int patch, double reach) {
    const Hit hit = hit_of(ray, patches_[patch], patch);
    if (hit.range > 0 && hit.offset <= reach) hits_.push_back(hit);
  }

  // Of the hits on the same surface, the mean; the closest one's point is the source.
  [[nodiscard]] Hit blended(float range) const {
    const auto tolerance =
        static_cast<float>(options_.same_surface_m + options_.same_surface_per_range * range);
    Hit best{-1, 0, std::numeric_limits<float>::infinity()};
    float sum = 0, sum_weights = 0;
    for (const Hit& hit : hits_) {
      if (hit.range > range + tolerance) continue;
      const float weight = 1.001F + static_cast<float>(options_.overlap) - hit.offset;
      sum += weight * hit.range;
      sum_weights += weight;
      if (hit.offset < best.offset) best = hit;
    }
    best.range = sum / sum_weights;
    return best;
  }

  // In the cracks between patches.
  Hit nearest_by(const Ray& ray, int row, float azimuth) {
    index_.visit_around(row, azimuth, [&](int i) { add(ray, i, options_.max_gap); });
    Hit best{-1, 0, std::numeric_limits<float>::infinity()};
    for (const Hit& hit : hits_)
      if (hit.offset < best.offset) best = hit;
    return best;
  }

  const std::vector<Patch>& patches_;
  const PatchIndex& index_;
  const ResampleOptions& options_;
  std::vector<Hit> hits_;
};

// What the beams of a row hit; beams that hit nothing are left out.
struct RowHits {
  std::vector<Eigen::Vector3f> points;
  std::vector<BeamLabel> labels;
  std::vector<int> patches;
};

std::vector<RowHits> cast_all(const LidarScan& key, const BeamPattern& pattern,
                              const std::vector<Patch>& patches, const PatchIndex& index,
                              const ResampleOptions& options) {
  const std::vector<bool> seen = seen_directions(pattern);
  const bool to_left = columns_go_left(key, pattern);
  std::vector<RowHits> rows(pattern.rows.size());
  tbb::parallel_for(0, pattern.num_rows(), [&](int row) {
    Caster caster(patches, index, options);
    RowHits& hits = rows[row];
    const Eigen::Vector3f origin = pattern.rows[row].origin();
    for (const Beam& beam : find_beams(key, pattern, row, seen)) {
      const Hit hit = caster.cast({origin, beam.direction}, row, beam);
      if (hit.patch < 0) continue;
      hits.points.emplace_back(origin + hit.range * beam.direction);
      hits.labels.push_back(label_of(beam, key, to_left));
      hits.patches.push_back(hit.patch);
    }
  });
  return rows;
}

void move_patches(const PointMotions& motions, std::vector<Patch>& patches) {
  tbb::parallel_for(std::size_t{0}, patches.size(), [&](std::size_t i) {
    if (motions.of_point[i] != kAbsent)
      patches[i] = moved_patch(patches[i], motions.transforms[motions.of_point[i]]);
  });
}

// Ring, column and time are the beam's, intensity and object those of the point that was hit.
void take_hits(const LidarScan& key, const std::vector<RowHits>& rows,
               const std::vector<int>& track_of_point, VirtualScan& result) {
  LidarScan& scan = result.scan;
  scan.points.clear();
  scan.intensity.clear();
  scan.ring.clear();
  scan.column.clear();
  scan.time_s.clear();
  result.source_index.clear();
  result.track_id.clear();
  for (const RowHits& row : rows) {
    scan.points.insert(scan.points.end(), row.points.begin(), row.points.end());
    result.source_index.insert(result.source_index.end(), row.patches.begin(), row.patches.end());
    for (const int i : row.patches) {
      result.track_id.push_back(track_of_point[i]);
      if (!key.intensity.empty()) scan.intensity.push_back(key.intensity[i]);
    }
    for (const BeamLabel& label : row.labels) {
      scan.ring.push_back(label.ring);
      if (!key.column.empty()) scan.column.push_back(label.column);
      if (!key.time_s.empty()) scan.time_s.push_back(label.time_s);
    }
  }
}

}  // namespace

ResampledScan resample_on_beams(const LidarScan& key_scan, VirtualScan moved,
                                const ResampleOptions& options) {
  check(key_scan, moved);
  ResampledScan result{std::move(moved), ResampleStatus::little_motion};
  const PointMotions motions = motions_of(key_scan.size(), result.scan);
  if (largest_motion(key_scan, motions) < options.min_motion_m) return result;
  result.status = ResampleStatus::no_beams;
  const auto pattern = find_beam_pattern(key_scan);
  if (!pattern) return result;

  std::vector<Patch> patches = make_patches(key_scan, *pattern, motions.of_point, options.patches);
  move_patches(motions, patches);
  std::vector<std::uint8_t> is_part(key_scan.size(), 0);
  std::vector<int> track_of_point(key_scan.size(), kStatic);
  for (std::size_t k = 0; k < result.scan.source_index.size(); ++k) {
    is_part[result.scan.source_index[k]] = 1;
    track_of_point[result.scan.source_index[k]] = result.scan.track_id[k];
  }
  const PatchIndex index(*pattern, patches, is_part, 1 + static_cast<float>(options.overlap));
  take_hits(key_scan, cast_all(key_scan, *pattern, patches, index, options), track_of_point,
            result.scan);
  result.status = ResampleStatus::done;
  return result;
}

}  // namespace lidar_upsampling
