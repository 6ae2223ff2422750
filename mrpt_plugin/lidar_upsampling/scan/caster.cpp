// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/scan/caster.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lidar_upsampling {
namespace {

constexpr float kNever = std::numeric_limits<float>::infinity();

Ray moved(const Ray& ray, const Motion& T) { return {T * ray.origin, turned(T.R, ray.direction)}; }

BeamHit hit_of(const Ray& ray, const Patch& patch, int number) {
  BeamHit hit{number, 0, 0, 1};
  const Eigen::Vector3f from = ray.origin - patch.origin;
  const float approach = patch.slope.dot(ray.direction);
  const float range = (1 - patch.slope.dot(from)) / approach;
  const Eigen::Vector3f to_hit = from + range * ray.direction;
  const float ahead = patch.axes.col(0).dot(to_hit);
  if (!(range > 0) || !(ahead > 0)) return hit;  // parallel, or seen from behind
  const float x = patch.axes.col(1).dot(to_hit), y = patch.axes.col(2).dot(to_hit);
  hit.range = range;
  hit.approach = approach;
  hit.offset = std::max(std::abs(x) / (x < 0 ? patch.right : patch.left),
                        std::abs(y) / (y < 0 ? patch.down : patch.up)) /
               ahead;
  return hit;
}

}  // namespace

Caster::Caster(const PatchSet& patches, const PatchMotions& motions, const PatchIndex& index,
               const ResampleOptions& options)
    : patches_(patches), motions_(motions), index_(index), options_(options) {}

BeamHit Caster::cast(const Ray& ray, int row, const Beam& beam) {
  hits_.clear();
  static_ray_ = moved(ray, motions_.back[0]);
  const auto reach = static_cast<float>(1 + options_.overlap);
  index_.visit_cell(row, beam.azimuth, [&](int i) { add(ray, i, reach); });
  if (hits_.empty()) {
    // Where nothing came back before, nothing is expected but what has moved there.
    if (beam.point < 0) return {};
    return nearest_by(ray, row, beam.azimuth);
  }
  return blended(
      *std::min_element(hits_.begin(), hits_.end(),
                        [](const BeamHit& a, const BeamHit& b) { return a.range < b.range; }));
}

void Caster::add(const Ray& ray, int patch, float reach) {
  const int motion = motions_.of_patch[patch];
  const BeamHit hit = hit_of(motion == 0 ? static_ray_ : moved(ray, motions_.back[motion]),
                             patches_.patch(patch), patch);
  if (hit.range > 0 && hit.offset <= reach) hits_.push_back(hit);
}

// Of the hits on the same surface, the mean; the closest one's point is the source.
BeamHit Caster::blended(const BeamHit& first) const {
  if (hits_.size() == 1) return first;
  // Across the plane of the first one, so that ground seen at a flat angle counts as one surface.
  const float tolerance = static_cast<float>(options_.same_surface_m) *
                          patches_.patch(first.patch).slope.norm() / std::abs(first.approach);
  BeamHit best{-1, 0, kNever};
  float sum = 0, sum_weights = 0;
  for (const BeamHit& hit : hits_) {
    if (hit.range > first.range + tolerance) continue;
    const float weight = 1.001F + static_cast<float>(options_.overlap) - hit.offset;
    sum += weight * hit.range;
    sum_weights += weight;
    if (hit.offset < best.offset) best = hit;
  }
  best.range = sum / sum_weights;
  return best;
}

// In the cracks between patches.
BeamHit Caster::nearest_by(const Ray& ray, int row, float azimuth) {
  index_.visit_around(row, azimuth,
                      [&](int i) { add(ray, i, static_cast<float>(options_.max_gap)); });
  BeamHit best{-1, 0, kNever};
  for (const BeamHit& hit : hits_)
    if (hit.offset < best.offset) best = hit;
  return best;
}

}  // namespace lidar_upsampling
