// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
// Objects of the scan as tracks in the world, as LidarUpsampler moves them.
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "lidar_upsampling/key_scan.h"
#include "lidar_upsampling/next_view.h"
#include "lidar_upsampling/objects/anchored_scan.h"
#include "lidar_upsampling/objects/cluster_detector.h"
#include "lidar_upsampling/objects/object_points.h"
#include "lidar_upsampling/stopwatch.h"
#include "lidar_upsampling/upsampler.h"
#include "lidar_upsampling/view_points.h"
#include "lidar_upsampling/vision/absolute_pose.h"
#include "lidar_upsampling/vision/projection.h"

namespace lidar_upsampling {
namespace {

ScanObject make_object(const LidarScan& scan, std::vector<int> points, std::string class_name,
                       double length, bool is_sweep) {
  ScanObject object;
  for (const int i : points) object.centroid += scan.points[i].cast<double>();
  object.centroid /= std::max<double>(1., static_cast<double>(points.size()));
  if (is_sweep) object.time_s = mean_time(scan.time_s, points);
  object.points = std::move(points);
  object.class_name = std::move(class_name);
  object.length = length;
  return object;
}

std::vector<ScanObject> objects_of_clusters(const LidarScan& scan, const SceneSegments& segments,
                                            const Config& config) {
  std::vector<ScanObject> objects;
  const bool is_sweep = config.sweep.scan_time != ScanTime::none;
  for (const int i : road_user_clusters(scan, segments, config.detector.clusters))
    objects.push_back(make_object(scan, segments.clusters[i], class_by_size(segments.extents[i]),
                                  segments.extents[i].length, is_sweep));
  return objects;
}

// The motion in the axes of the lidar frame at k, and as a rigid motion.
Twist motion_until(const TrackState& state, const Pose& T_rest_lidar_k, const ScanObject& object,
                   Stamp instant, const TrackOptions& options) {
  MotionQuestion question;
  question.R_rest_lidar_k = T_rest_lidar_k.linear();
  question.centroid = object.centroid;
  return expected_motion(predicted(state, instant, options.noise), question, 0, options).mean;
}

// The motion over ground of what keeps its place before the vehicle.
Twist motion_with_us(const Pose& T_lidar_t_lidar_k, const ScanObject& object) {
  Twist motion = Twist::Zero();
  motion.tail<3>() = T_lidar_t_lidar_k.inverse() * object.centroid - object.centroid;
  motion[5] = 0;
  return motion;
}

// Where none of the expected motions explains most of the points, what most of them agree on.
std::optional<Twist> consensus(const std::vector<Observation>& seen,
                               const std::vector<Correspondence>& pairs,
                               const Pose& T_camera_lidar_k, const Eigen::Vector3d& centroid,
                               const std::vector<Twist>& starts, const CameraModel& camera,
                               const AbsolutePoseOptions& options) {
  constexpr double kMost = 0.5;
  for (const Twist& start : starts) {
    const Pose T = T_camera_lidar_k * motion_pose(start, centroid);
    const auto near = std::count_if(seen.begin(), seen.end(), [&](const Observation& observation) {
      return sq_reprojection_error(observation, T) < options.first_gate_px * options.first_gate_px;
    });
    if (static_cast<double>(near) >= kMost * static_cast<double>(seen.size())) return {};
  }
  const auto pose = estimate_absolute_pose(pairs, camera, options);
  if (!pose) return {};
  const Pose T_mov = T_camera_lidar_k.inverse() * pose->T_camera_source;
  const Eigen::AngleAxisd turn(T_mov.linear());
  Twist motion;
  motion << turn.angle() * turn.axis(), T_mov * centroid - centroid;
  return motion;
}

// An object on a picture.
struct Appearance {
  const Camera* camera = nullptr;  // null: on none
  int num_points = 0;
  Box2d box;
};

Appearance appearance_of(const Camera& camera, const LidarScan& scan, const std::vector<int>& points,
                         const Pose& T_lidar_t_lidar_k) {
  const Pose T = T_camera_lidar_of(camera, scan.T_vehicle_lidar) * T_lidar_t_lidar_k;
  Appearance result{&camera, 0, Box2d::around_nothing()};
  for (const int i : points) {
    const auto pixel = project(camera.model, T * scan.points[i].cast<double>());
    if (!pixel) continue;
    result.box.extend(pixel->x(), pixel->y());
    ++result.num_points;
  }
  return result;
}

// On the picture that shows most of it, if any shows enough.
Appearance shown(const std::vector<ImageResult>& group, const LidarScan& scan,
                 const ObjectMotion& motion, double min_share) {
  Appearance best;
  for (const ImageResult& result : group) {
    const Appearance here =
        appearance_of(result.camera, scan, motion.points, motion.T_lidar_t_lidar_k);
    if (here.num_points > best.num_points) best = here;
  }
  const auto enough = min_share * static_cast<double>(motion.points.size());
  return best.num_points > 0 && best.num_points >= enough ? best : Appearance{};
}

}  // namespace

void LidarUpsampler::find_objects(const Picture* anchor, CameraView* view) {
  if (key_->objects_found) return;
  const bool by_boxes = config_.detector.type != DetectorOptions::Type::clusters;
  if (by_boxes && anchor == nullptr) return;
  if (!key_->segments) {
    const Stopwatch watch(timing_, "ground and clusters");
    key_->segments = segment_scan(key_->scan, config_.segments);
  }
  const Stopwatch watch(timing_, "candidates");
  const LidarScan& scan = key_->scan;
  if (!by_boxes) {
    key_->objects = objects_of_clusters(scan, *key_->segments, config_);
  } else {
    const Pose T_camera_lidar_a = T_camera_lidar_of(view->camera, scan.T_vehicle_lidar) *
                                  ego_step(anchor->instant).T_to_from;
    const AnchoredScan anchored = anchor_scan(scan, view->camera.model, T_camera_lidar_a);
    const auto visible = visible_points(anchored);
    for (const Detection& detection : detector_->detect(
             {anchor->image, &scan, &*key_->segments, T_camera_lidar_a, false})) {
      auto points = select_object_points(scan, visible, *key_->segments, detection.box,
                                         config_.object_points);
      if (!points) continue;
      const double length = cluster_extent(scan.points, {}, *points).length;
      key_->objects.push_back(make_object(scan, std::move(*points), detection.class_name, length,
                                          config_.sweep.scan_time != ScanTime::none));
    }
  }
  key_->track_of = take_up_scan(store_, key_->objects,
                                {scan, key_->T_rest_lidar_k, key_->step_covariance, *key_->seen,
                                 key_->seen_before.get(), key_->stamp_before},
                                config_.object_tracks);
  key_->objects_found = true;
}

void LidarUpsampler::look_ahead_tracked(const LidarScan& next, const SceneSegments& segments,
                                        const Pose& T_lidar_next_lidar_k) {
  find_objects(nullptr, nullptr);
  if (!key_->objects_found) return;
  const Pose T_rest_next = key_->T_rest_lidar_k * T_lidar_next_lidar_k.inverse();
  look_ahead(store_, objects_of_clusters(next, segments, config_),
             {next, T_rest_next, step_covariance_, next_->seen, key_->seen.get(), key_->scan.stamp},
             config_.object_tracks);
}

void LidarUpsampler::start_tracked(CameraView& view, const std::shared_ptr<const Picture>& anchor) {
  find_objects(anchor.get(), &view);
  const Stopwatch watch(timing_, "points to follow");
  const LidarScan& scan = key_->scan;
  const Pose T_camera_lidar_a = T_camera_lidar_of(view.camera, scan.T_vehicle_lidar) *
                                ego_step(anchor->instant).T_to_from;
  AnchoredScan anchored;
  cv::Mat texture;
  tbb::parallel_invoke(
      [&] { anchored = anchor_scan(scan, view.camera.model, T_camera_lidar_a); },
      [&] { cv::cornerMinEigenVal(anchor->image.gray, texture, 5); });
  view.candidates.assign(key_->objects.size(), {});
  view.anchor_dt = seconds_between(scan.stamp, anchor->instant);
  if (std::abs(view.anchor_dt) * 1e3 <= config_.timing.pair_tolerance_ms) view.anchor_dt = 0;
  for (std::size_t i = 0; i < view.candidates.size(); ++i) {
    const ScanObject& object = key_->objects[i];
    Candidate& candidate = view.candidates[i];
    candidate.points = object.points;
    candidate.centroid = object.centroid;
    candidate.time_s = object.time_s;
    const ObjectTrack& track = store_.tracks[key_->track_of[i]];
    if (track.log_odds <= 0) continue;
    constexpr double kShort_s = 0.01;
    candidate.rate = log_se3(motion_pose(
                         motion_until(track.state, key_->T_rest_lidar_k, object, shifted(track.stamp, kShort_s),
                                      config_.object_tracks),
                         object.centroid)) /
                     kShort_s;
  }
  view.points = {};
  view.sampling = anchored.sampling;
  choose_points(view, anchored, texture, scan, T_camera_lidar_a,
                !ego_step(anchor->instant).covariance.isZero(0), config_);
  view.anchor = anchor;
}

void LidarUpsampler::follow_tracked(CameraView& view, const Picture& picture, ImageResult& result) {
  const LidarScan& scan = key_->scan;
  const Pose T_camera_lidar = T_camera_lidar_of(view.camera, scan.T_vehicle_lidar);
  const Pose& ego = result.ego.T_to_from;
  const std::size_t count = key_->objects.size();
  std::vector<Ways> ways(count);
  result.starts.resize(count);
  {
    const Stopwatch watch(timing_, "point tracking");
    for (std::size_t i = 0; i < count; ++i) {
      const ScanObject& object = key_->objects[i];
      const ObjectTrack& track = store_.tracks[key_->track_of[i]];
      const Twist expected = motion_until(track.latest.stamp > track.stamp ? track.latest : track.state,
                                          key_->T_rest_lidar_k, object, picture.instant, config_.object_tracks);
      std::vector<Twist> motions;
      if (track.latest_log_odds > 0) {
        motions = {expected, Twist::Zero()};
      } else {
        motions = {Twist::Zero(), expected};
      }
      motions.push_back(motion_with_us(ego, object));
      const double px_per_m = view.camera.model.fx / std::max(1., object.centroid.norm());
      for (const Twist& motion : motions) {
        const bool is_new = std::none_of(
            result.starts[i].begin(), result.starts[i].end(), [&](const Twist& other) {
              return (other - motion).tail<3>().norm() * px_per_m < 0.3 * config_.klt.window_px;
            });
        if (!is_new) continue;
        result.starts[i].push_back(motion);
        ways[i].T_mov.push_back(motion_pose(motion, object.centroid));
      }
      const TrackState now = predicted(track.state, picture.instant, config_.object_tracks.noise);
      ways[i].reach_m = 2.5 * std::sqrt(0.5 * now.covariance.topLeftCorner<2, 2>().trace());
      if (ways[i].reach_m * px_per_m < config_.klt.window_px) ways[i].reach_m = 0;
    }
    follow_ways(view, picture, T_camera_lidar * ego, ways, config_.klt);
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = result.starts[i].size(); j < ways[i].T_mov.size(); ++j) {
        result.starts[i].emplace_back(Twist::Zero());
        result.starts[i].back().tail<3>() =
            ways[i].T_mov[j] * key_->objects[i].centroid - key_->objects[i].centroid;
      }
  }
  if (!result.ego.covariance.isZero(0)) {
    const Stopwatch watch(timing_, "ego-motion");
    result.ego = camera_step(view, picture, result.ego);
  }
  result.seen.resize(count);
  result.views.resize(count);
  result.num_followed.assign(count, 0);
  for (const int owner : view.points.owner)
    if (owner >= 0) ++result.num_followed[owner];
  const double dt = seconds_between(scan.stamp, picture.instant);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    const Candidate& candidate = view.candidates[i];
    const auto pairs = correspondences_of(view.points, static_cast<int>(i));
    result.seen[i] = observe(pairs, view.camera.model);
    ImageView& image = result.views[i];
    image.T_camera_lidar_k = T_camera_lidar * result.ego.T_to_from;
    const auto agreed = consensus(result.seen[i], pairs, image.T_camera_lidar_k, candidate.centroid,
                                  result.starts[i], view.camera.model, config_.object_motion.pose);
    if (agreed) result.starts[i].push_back(*agreed);
    const double until_anchor = view.anchor_dt == 0 ? 0 : view.anchor_dt - candidate.time_s;
    image.share = dt - candidate.time_s - until_anchor;
    image.offset = exp_se3(Twist(candidate.anchor_rate * until_anchor)) * candidate.centroid -
                   candidate.centroid;
  });
}

std::vector<ObjectMotion> LidarUpsampler::tracked_motions(const std::vector<ImageResult>& group,
                                                          const ImageResult& newest) {
  const TrackOptions& options = config_.object_tracks;
  std::vector<ObjectMotion> motions(key_->objects.size());
  tbb::parallel_for(std::size_t{0}, motions.size(), [&](std::size_t i) {
    const ScanObject& object = key_->objects[i];
    ObjectTrack& track = store_.tracks[key_->track_of[i]];
    MotionQuestion question;
    question.instant = newest.instant;
    question.T_lidar_t_lidar_k = newest.ego.T_to_from;
    question.ego_covariance = newest.ego.covariance;
    question.centroid = object.centroid;
    question.R_rest_lidar_k = key_->T_rest_lidar_k.linear();
    question.focal_px = newest.camera.model.fx;
    const double dt = std::max(0.005, seconds_between(track.stamp, newest.instant));
    ImageFactor image;
    std::vector<Twist> starts{Twist::Zero()};
    int num_followed = 0;
    for (const ImageResult& result : group) {
      if (result.seen.size() <= i || result.seen[i].empty()) continue;
      num_followed += result.num_followed[i];
      ImageView view = result.views[i];
      view.share /= dt;
      image.add(view, result.seen[i]);
      starts.insert(starts.end(), result.starts[i].begin(), result.starts[i].end());
    }
    const MotionAnswer answer = estimate_motion(track, image, num_followed, question, starts, options);
    track.latest = answer.state;
    track.latest_log_odds = std::clamp(answer.log_odds, -8., 8.);

    if (std::getenv("DBG")) {
      const Eigen::Vector3d c = object.centroid;
      std::fprintf(stderr,
                   "DBG t=%.3f id=%d %s n=%zu obs=%zu at=%.1f,%.1f,%.1f len=%.1f new=%d l=%.1f->%.1f d=%.2f,%.2f "
                   "sd=%.2f,%.2f inl=%d/%d rms=%.2f/%.2f v=%.1f,%.1f prior=%.1f,%.1f\n",
                   dt, track.id, track.class_name.c_str(), object.points.size(),
                   image.observations.size(), c.x(), c.y(), c.z(), object.length, track.is_new,
                   track.log_odds, answer.log_odds, answer.fit.mean[3], answer.fit.mean[4],
                   std::sqrt(answer.fit.covariance(3, 3)), std::sqrt(answer.fit.covariance(4, 4)),
                   answer.fit.num_inliers, answer.parked.num_inliers, answer.fit.rmse_px,
                   answer.parked.rmse_px, answer.state.mean[3], answer.state.mean[4],
                   track.state.mean[3], track.state.mean[4]);
    }
    ObjectMotion& motion = motions[i];
    motion.track_id = track.id;
    motion.class_name = track.class_name;
    motion.points = object.points;
    motion.centroid_lidar_k = object.centroid;
    motion.num_tracked = static_cast<int>(image.observations.size());
    motion.num_inliers = answer.moves ? answer.fit.num_inliers : answer.parked.num_inliers;
    motion.rmse_px = answer.moves ? answer.fit.rmse_px : answer.parked.rmse_px;
    motion.status = !answer.is_seen
                        ? (answer.moves ? MotionStatus::predicted : MotionStatus::too_few_points)
                        : (answer.moves ? MotionStatus::moving : MotionStatus::stationary);
    const Pose T_found = motion_pose(answer.fit.mean, object.centroid);
    if (answer.moves) motion.T_mov = T_found;
    motion.T_lidar_t_lidar_k = newest.ego.T_to_from * motion.T_mov;
    motion.velocity_lidar_k = (motion.T_mov * object.centroid - object.centroid) / dt;
    motion.yaw_rate = answer.moves ? answer.fit.mean[2] / dt : 0;
    const Eigen::Matrix3d R = newest.ego.T_to_from.linear();
    if (answer.is_seen || answer.moves)
      motion.position_covariance =
          R * (answer.moves ? answer.fit : answer.parked.num_inliers > 0 ? answer.parked : answer.fit)
                  .covariance.bottomRightCorner<3, 3>() * R.transpose();
    if (!answer.moves && answer.is_seen)
      motion.unproven_step = R * answer.fit.mean.tail<3>();
    const Appearance on_picture =
        shown(group, key_->scan, motion, config_.detector.clusters.min_visible);
    if (on_picture.camera != nullptr) motion.camera_label = on_picture.camera->label;
    motion.box = on_picture.box;
  });
  return motions;
}

}  // namespace lidar_upsampling
