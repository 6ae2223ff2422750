// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/camera_view.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "lidar_upsampling/objects/anchored_scan.h"
#include "lidar_upsampling/objects/object_points.h"
#include "lidar_upsampling/objects/travel.h"
#include "lidar_upsampling/sightings.h"
#include "lidar_upsampling/view_points.h"

namespace lidar_upsampling {
namespace {

Eigen::Vector3d centroid_of(const LidarScan& scan, const std::vector<int>& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const int i : points) sum += scan.points[i].cast<double>();
  return sum / std::max<double>(1., static_cast<double>(points.size()));
}

// What is seen of an object is as large as its points are many and far.
Place place_of(const KeyScanView& key, const std::vector<int>& points) {
  const Eigen::Vector3d centroid = centroid_of(key.scan, points);
  return {key.T_rest_lidar_k * centroid,
          static_cast<double>(points.size()) * centroid.squaredNorm()};
}

// The motion since the scan that last showed the object, by registration; what was known before is
// where it starts.
void measure_motions(std::vector<Candidate>& candidates, const std::map<int, PastObject>& past,
                     const KeyScanView& key, double acceleration_sigma) {
  tbb::parallel_for(std::size_t{0}, candidates.size(), [&](std::size_t i) {
    Candidate& candidate = candidates[i];
    const auto found = past.find(candidate.track_id);
    if (found == past.end() || (candidate.known && candidate.known->travel)) return;
    const PastObject& before = found->second;
    const Stamp instant = shifted(key.scan.stamp, candidate.time_s);
    const Pose T_k_before = key.T_rest_lidar_k.inverse() * before.T_rest_lidar;
    ObjectScans scans{before.points, points_at(key.scan, candidate.points), T_k_before,
                      Pose::Identity(), seconds_between(before.stamp, instant)};
    if (candidate.known) {
      const Eigen::Vector3d centroid = T_k_before.inverse() * candidate.centroid;
      scans.T_mov_guess = exp_se3(
          Twist(scans.dt * rate_over_ground(*candidate.known,
                                            before.T_rest_lidar.linear().transpose(), centroid)));
    }
    auto measured = measure_between_scans(scans, instant, key.T_rest_lidar_k.linear());
    if (!measured) return;
    candidate.known =
        candidate.known ? fused(*candidate.known, *measured, acceleration_sigma) : measured;
  });
}

// Pieces of a parked one differ from scan to scan, and so does where registration puts them.
void forget_contradicted(std::vector<Candidate>& candidates, const std::map<int, PastObject>& past,
                         const KeyScanView& key) {
  if (key.seen_before == nullptr) return;
  tbb::parallel_for(std::size_t{0}, candidates.size(), [&](std::size_t i) {
    Candidate& candidate = candidates[i];
    const auto found = past.find(candidate.track_id);
    if (found == past.end() || !candidate.known) return;
    const PastObject& before = found->second;
    const Stamp instant = shifted(key.scan.stamp, candidate.time_s);
    const double dt = seconds_between(before.stamp, instant);
    if (std::abs(dt - seconds_between(key.stamp_before, key.scan.stamp)) > 0.5 * dt) return;
    const Pose T_before_k = before.T_rest_lidar.inverse() * key.T_rest_lidar_k;
    const Eigen::Vector3d step = dt * candidate.known->velocity_at_rest;
    const Eigen::Vector3d step_k = key.T_rest_lidar_k.linear().transpose() * step;
    const Eigen::Vector3d step_before = before.T_rest_lidar.linear().transpose() * step;
    const auto points = points_at(key.scan, candidate.points);
    const bool is_whole = !is_proven(candidate);
    if (was_there_then({points, key.seen, is_whole}, step_k.head<2>(), T_before_k,
                       *key.seen_before) &&
        was_there_then({before.points, *key.seen_before, is_whole}, -step_before.head<2>(),
                       T_before_k.inverse(), key.seen))
      candidate.known.reset();
  });
}

// Candidates with their points in the scan, their identities and the motion to expect of them.
std::vector<Candidate> find_candidates(CameraView& view, const Picture& anchor,
                                       const KeyScanView& key, const Pose& T_camera_lidar_a,
                                       const std::vector<ProjectedPoint>& visible,
                                       const std::map<int, KnownMotion>& known, Detector& detector,
                                       const Config& config) {
  std::vector<Sighting> sightings;
  for (Detection& detection : detector.detect(
           {anchor.image, &key.scan, &key.segments, T_camera_lidar_a, key.next != nullptr})) {
    auto found = detection.points.empty()
                     ? select_object_points(key.scan, visible, key.segments, detection.box,
                                            config.object_points)
                     : std::optional(std::move(detection.points));
    if (!found) continue;
    detection.points.clear();
    sightings.push_back({std::move(detection), std::move(*found), {}});
  }
  find_expected(sightings, key, view.camera.model, T_camera_lidar_a);

  std::vector<Detection> detections;
  std::vector<std::optional<Place>> places;
  for (const Sighting& sighting : sightings) {
    detections.push_back(sighting.detection);
    places.emplace_back(place_of(key, sighting.points));
  }
  const std::vector<int> ids = view.tracker.update(anchor.instant, detections, places);
  std::vector<Candidate> candidates(sightings.size());
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    Candidate& candidate = candidates[i];
    candidate.detection = std::move(detections[i]);
    candidate.track_id = ids[i];
    candidate.points = std::move(sightings[i].points);
    candidate.foreseen = std::move(sightings[i].foreseen);
    candidate.centroid = centroid_of(key.scan, candidate.points);
    if (config.sweep.scan_time != ScanTime::none)
      candidate.time_s = mean_time(key.scan.time_s, candidate.points);
    if (const auto motion = known.find(ids[i]); motion != known.end())
      candidate.known = motion->second;
    if (const auto past = view.past.find(ids[i]); past != view.past.end())
      candidate.scans_moving = past->second.scans_moving;
  }
  return candidates;
}

// Whether later scans tell more of a mover than what was before.
bool tells_more(const KnownMotion& foreseen, const std::optional<KnownMotion>& known) {
  return !known || !known->found_moving ||
         foreseen.velocity_covariance.trace() < known->velocity_covariance.trace();
}

// Objects that one scan misses are looked for in the next ones.
void remember(std::map<int, PastObject>& past, const KeyScanView& key,
              const std::vector<Candidate>& candidates) {
  constexpr double kForgetAfter_s = 0.7;
  constexpr double kSignificant = 13.8;  // chi-square of two degrees of freedom, one in a thousand
  for (auto object = past.begin(); object != past.end();)
    object = seconds_between(object->second.stamp, key.scan.stamp) > kForgetAfter_s
                 ? past.erase(object)
                 : std::next(object);
  for (const Candidate& candidate : candidates) {
    const auto& known = candidate.known;
    const bool moves = known && evidence_of_motion(*known) > kSignificant;
    past[candidate.track_id] = {shifted(key.scan.stamp, candidate.time_s), key.T_rest_lidar_k,
                                points_at(key.scan, candidate.points),
                                moves ? candidate.scans_moving + (known->from_scans ? 1 : 0) : 0};
  }
}

}  // namespace

Pose T_camera_lidar_of(const Camera& camera, const Pose& T_vehicle_lidar) {
  return camera.T_vehicle_camera.inverse() * T_vehicle_lidar;
}

void start_view(CameraView& view, std::shared_ptr<const Picture> anchor, const KeyScanView& key,
                const Pose& T_lidar_a_lidar_k, const std::map<int, KnownMotion>& known,
                bool with_static_points, Detector& detector, const Config& config) {
  const LidarScan& scan = key.scan;
  const CameraModel& camera = view.camera.model;
  const Pose T_camera_lidar_a =
      T_camera_lidar_of(view.camera, scan.T_vehicle_lidar) * T_lidar_a_lidar_k;
  AnchoredScan anchored;
  cv::Mat texture;
  tbb::parallel_invoke([&] { anchored = anchor_scan(scan, camera, T_camera_lidar_a); },
                       [&] { cv::cornerMinEigenVal(anchor->image.gray, texture, 5); });
  view.candidates = find_candidates(view, *anchor, key, T_camera_lidar_a, visible_points(anchored),
                                    known, detector, config);
  if (config.object_motion.prior.from_scans) {
    measure_motions(view.candidates, view.past, key, config.object_motion.prior.acceleration_sigma);
    forget_contradicted(view.candidates, view.past, key);
  }
  for (Candidate& candidate : view.candidates)
    if (candidate.foreseen && tells_more(*candidate.foreseen, candidate.known))
      candidate.known = candidate.foreseen;
  for (Candidate& candidate : view.candidates)
    if (candidate.known)
      candidate.rate = rate_over_ground(*candidate.known, key.T_rest_lidar_k.linear().transpose(),
                                        candidate.centroid);
  if (!config.object_motion.prior.from_images) {  // it still tells where to look for the points
    for (Candidate& candidate : view.candidates) {
      if (!candidate.known) continue;
      candidate.known->found_moving = false;
      if (!candidate.known->from_scans) candidate.known.reset();
    }
  }
  remember(view.past, key, view.candidates);
  view.R_rest_lidar_k = key.T_rest_lidar_k.linear();
  view.points = {};
  view.anchor_dt = seconds_between(scan.stamp, anchor->instant);
  if (std::abs(view.anchor_dt) * 1e3 <= config.timing.pair_tolerance_ms) view.anchor_dt = 0;

  view.sampling = anchored.sampling;
  choose_points(view, anchored, texture, scan, T_camera_lidar_a, with_static_points, config);
  view.anchor = std::move(anchor);
}

}  // namespace lidar_upsampling
