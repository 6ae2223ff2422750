// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "clouds.h"
#include "lidar_upsampling/metrics/sampling.h"
#include "lidar_upsampling/registration/point_index.h"

namespace lidar_upsampling {

namespace {

// Of a reference scan, what belongs to an object whose points went there.
constexpr double kObjectReach_m = 0.3;
// A point without one this near under the reference motion is an outlier: hidden in one of the
// scans, or newly seen. The same points for every row, so that no row gains by being wrong.
constexpr double kOutlier_m = 0.5;

/// The two clouds that are compared, and which of their points are inliers.
struct Pair {
  Points estimate, reference;
  std::vector<std::uint8_t> estimate_inlier, reference_inlier;
};

Points kept(const Points& points, const std::vector<std::uint8_t>& keep) {
  Points result;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (keep[i] != 0) result.push_back(points[i]);
  return result;
}

SampledDistances distances(Points first, Points second, bool exact) {
  SampledDistances result;
  result.chamfer = compute_chamfer(first, second);
  const std::size_t count = std::min(first.size(), second.size());
  first.resize(count);  // they are in random order
  second.resize(count);
  result.emd = approximate_emd(first, second);
  if (!exact) return result;
  first.resize(std::min(count, kMaxExactEmdPoints));
  second.resize(first.size());
  result.exact = exact_emd(first, second);
  return result;
}

std::uint64_t seed_of(int seed, bool of_reference) {
  return 2 * static_cast<std::uint64_t>(seed) + (of_reference ? 1 : 0);
}

/// To 16384 points first, then what the camera sees, as the paper says.
void measure_scene(const PerRow<Points>& clouds, const LidarScan& reference,
                   const std::vector<Camera>& cameras, const EvaluationOptions& options,
                   ScanResult& result) {
  const std::vector<View> views = views_of(cameras, reference);
  const auto sampled = [&](const Points& cloud, std::uint64_t seed) {
    Points points;
    for (const auto& point : sample_points(cloud, options.protocol->num_points, seed))
      if (views.empty() || in_view(views.front(), point.cast<double>())) points.push_back(point);
    return points;
  };
  for (int seed = 0; seed < options.num_seeds; ++seed) {
    const Points truth = sampled(reference.points, seed_of(seed, true));
    for (const Row row : kRows) {
      if (clouds[row].empty()) continue;
      Points cloud = sampled(clouds[row], seed_of(seed, false));
      if (cloud.empty() || truth.empty()) continue;
      result.sampled[row].all.push_back(distances(std::move(cloud), truth, options.exact_emd));
    }
  }
}

bool on_road(const LidarScan& scan, const Eigen::Vector3f& point) {
  const Eigen::Vector3d p = scan.T_vehicle_lidar * point.cast<double>();
  return std::abs(p.x()) <= 32 && std::abs(p.y()) <= 8 && p.z() < 2;
}

bool counts(const ObjectResult& object) {
  return object.object.excluded.empty() && is_vehicle(object.object.class_name);
}

/// Points of the reference scan that belong to vehicles, by where the reference motion takes those
/// of the key scan.
Points vehicles_in_reference(const Points& oracle, const LidarScan& reference) {
  Points points;
  if (oracle.empty()) return points;
  const PointIndex index(oracle);
  for (const auto& point : without_ground(reference))
    if (const auto near = index.nearest(point);
        near.index >= 0 && near.sq_distance < kObjectReach_m * kObjectReach_m)
      points.push_back(point);
  return points;
}

std::vector<std::uint8_t> have_counterpart(const Points& points, const Points& others) {
  std::vector<std::uint8_t> flags(points.size(), 0);
  if (others.empty()) return flags;
  const PointIndex index(others);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto near = index.nearest(points[i]);
    flags[i] = near.index >= 0 && near.sq_distance < kOutlier_m * kOutlier_m ? 1 : 0;
  }
  return flags;
}

/// The vehicles of the key scan, all together, where a row puts them.
Points vehicles_by(Row row, const ScanSet& scans, const std::vector<ObjectResult>& objects) {
  Points points;
  for (const ObjectResult& object : objects) {
    if (!counts(object)) continue;
    const auto& T = object.estimates[row] ? object.estimates[row] : object.estimates[Row::ego];
    for (const int i : object.object.points)
      points.emplace_back((*T * scans.key.points[i].cast<double>()).cast<float>());
  }
  return points;
}

Pair cropped(const Pair& pair, const LidarScan& scan) {
  Pair result;
  const auto take = [&](const Points& points, const std::vector<std::uint8_t>& flags, Points& out,
                        std::vector<std::uint8_t>& out_flags) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!on_road(scan, points[i])) continue;
      out.push_back(points[i]);
      out_flags.push_back(flags[i]);
    }
  };
  take(pair.estimate, pair.estimate_inlier, result.estimate, result.estimate_inlier);
  take(pair.reference, pair.reference_inlier, result.reference, result.reference_inlier);
  return result;
}

void measure_pair(const Points& estimate, const Points& reference, const EvaluationOptions& options,
                  std::vector<SampledDistances>& results) {
  const std::size_t count =
      std::min({estimate.size(), reference.size(), options.protocol->num_points});
  if (count == 0) return;
  for (int seed = 0; seed < options.num_seeds; ++seed)
    results.push_back(distances(sample_points(estimate, count, seed_of(seed, false)),
                                sample_points(reference, count, seed_of(seed, true)),
                                options.exact_emd));
}

void measure_vehicles(const ScanSet& scans, const EvaluationOptions& options, ScanResult& result) {
  const Points oracle = vehicles_by(Row::oracle, scans, result.objects);
  const Points reference = vehicles_in_reference(oracle, scans.reference);
  const auto oracle_inlier = have_counterpart(oracle, reference);
  const auto reference_inlier = have_counterpart(reference, oracle);
  for (const Row row : kRows) {
    const bool known = row == Row::floor || row == Row::oracle ||
                       std::any_of(result.objects.begin(), result.objects.end(),
                                   [row](const auto& o) { return o.estimates[row].has_value(); });
    if (!known) continue;
    Pair pair{row == Row::floor ? reference : vehicles_by(row, scans, result.objects), reference,
              row == Row::floor ? reference_inlier : oracle_inlier, reference_inlier};
    if (options.protocol->crop_to_road) pair = cropped(pair, scans.reference);
    measure_pair(pair.estimate, pair.reference, options, result.sampled[row].all);
    measure_pair(kept(pair.estimate, pair.estimate_inlier),
                 kept(pair.reference, pair.reference_inlier), options, result.sampled[row].inliers);
  }
}

}  // namespace

void measure_samples(const PerRow<Points>& clouds, const ScanSet& scans,
                     const std::vector<Camera>& cameras, const EvaluationOptions& options,
                     ScanResult& result) {
  // The paper evaluates frames that hold candidates for moving objects.
  const bool has_candidates = std::any_of(result.objects.begin(), result.objects.end(), counts);
  if (!options.protocol || !has_candidates) return;
  if (options.protocol->measure == Protocol::Measure::scene)
    measure_scene(clouds, scans.reference, cameras, options, result);
  if (options.protocol->measure == Protocol::Measure::vehicles)
    measure_vehicles(scans, options, result);
}

}  // namespace lidar_upsampling
