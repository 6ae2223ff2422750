// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
// Objects of the scan as tracks in the world, as LidarUpsampler moves them: found once per scan,
// followed on every camera, estimated once per instant.
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "lidar_upsampling/key_scan.h"
#include "lidar_upsampling/objects/anchored_scan.h"
#include "lidar_upsampling/objects/beam_step.h"
#include "lidar_upsampling/objects/cluster_detector.h"
#include "lidar_upsampling/objects/object_points.h"
#include "lidar_upsampling/stopwatch.h"
#include "lidar_upsampling/tracks/hypotheses.h"
#include "lidar_upsampling/upsampler.h"
#include "lidar_upsampling/view_points.h"
#include "lidar_upsampling/view_ways.h"
#include "lidar_upsampling/vision/absolute_pose.h"
#include "lidar_upsampling/vision/projection.h"

namespace lidar_upsampling {
namespace {

ScanObject make_object(const LidarScan& scan, std::vector<int> points, std::string class_name,
                       double length, bool is_sweep) {
  ScanObject object;
  object.centroid = mean_of(points_at(scan, points));
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

std::vector<ScanObject> objects_of_boxes(const LidarScan& scan, const SceneSegments& segments,
                                         const Camera& camera, const Picture& anchor,
                                         const Pose& T_lidar_a_lidar_k, Detector& detector,
                                         const Config& config) {
  const Pose T_camera_lidar_a = T_camera_lidar_of(camera, scan.T_vehicle_lidar) * T_lidar_a_lidar_k;
  const auto visible = visible_points(anchor_scan(scan, camera.model, T_camera_lidar_a));
  const bool is_sweep = config.sweep.scan_time != ScanTime::none;
  std::vector<ScanObject> objects;
  for (const Detection& detection :
       detector.detect({anchor.image, &scan, &segments, T_camera_lidar_a, false})) {
    auto points =
        select_object_points(scan, visible, segments, detection.box, config.object_points);
    if (!points) continue;
    const double length = cluster_extent(scan.points, {}, *points).length;
    objects.push_back(
        make_object(scan, std::move(*points), detection.class_name, length, is_sweep));
  }
  return objects;
}

// What is to be followed of an object; its points lie on the anchor where it was by then.
Candidate make_candidate(const ScanObject& object, const ObjectTrack& track,
                         const Eigen::Matrix3d& R_rest_lidar_k) {
  Candidate candidate;
  candidate.points = object.points;
  candidate.centroid = object.centroid;
  candidate.time_s = object.time_s;
  if (track.log_odds <= 0) return candidate;
  const Eigen::Vector2d velocity = level_axes(R_rest_lidar_k).transpose() * track.state.velocity();
  candidate.rate[2] = track.state.mean[5];
  // About the object's centroid, as a twist about the lidar.
  candidate.rate.tail<3>() = Eigen::Vector3d(velocity.x(), velocity.y(), 0) -
                             Eigen::Vector3d(candidate.rate.head<3>()).cross(object.centroid);
  return candidate;
}

// The motion over ground of what keeps its place before the vehicle.
Twist motion_with_us(const Pose& T_lidar_t_lidar_k, const Eigen::Vector3d& centroid) {
  Twist motion = Twist::Zero();
  motion.segment<2>(3) = (T_lidar_t_lidar_k.inverse() * centroid - centroid).head<2>();
  return motion;
}

// Ways from which an object's points may be found on the next picture: as expected, parked, and
// with us; those that lead to the same pixels count once.
std::vector<Twist> motions_to_try(const ObjectTrack& track, const Twist& expected,
                                  const Twist& with_us, double near_m) {
  std::vector<Twist> motions;
  const bool moves = track.latest_log_odds > 0;
  for (const Twist& motion :
       {moves ? expected : Twist(Twist::Zero()), moves ? Twist(Twist::Zero()) : expected, with_us})
    if (std::none_of(motions.begin(), motions.end(), [&](const Twist& other) {
          return (other - motion).tail<3>().norm() < near_m;
        }))
      motions.push_back(motion);
  return motions;
}

// Where none of the expected motions explains most of the points, what most of them agree on.
std::optional<Twist> consensus(const std::vector<Correspondence>& pairs,
                               const std::vector<Observation>& seen, const Pose& T_camera_lidar_k,
                               const Eigen::Vector3d& centroid, const std::vector<Twist>& starts,
                               const CameraModel& camera, const AbsolutePoseOptions& options) {
  constexpr double kMost = 0.5;
  for (const Twist& start : starts) {
    const Pose T = T_camera_lidar_k * motion_pose(start, centroid);
    const auto near = std::count_if(seen.begin(), seen.end(), [&](const Observation& observation) {
      return sq_reprojection_error(observation, T) < std::pow(options.first_gate_px, 2);
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

Appearance appearance_of(const Camera& camera, const LidarScan& scan, const ObjectMotion& motion) {
  const Pose T = T_camera_lidar_of(camera, scan.T_vehicle_lidar) * motion.T_lidar_t_lidar_k;
  Appearance result{&camera, 0, Box2d::around_nothing()};
  for (const int i : motion.points) {
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
    const Appearance here = appearance_of(result.camera, scan, motion);
    if (here.num_points > best.num_points) best = here;
  }
  const auto enough = min_share * static_cast<double>(motion.points.size());
  return best.num_points > 0 && best.num_points >= enough ? best : Appearance{};
}

// All that the pictures of an instant show of an object.
struct Sights {
  ImageFactor image;
  std::vector<Twist> starts{Twist::Zero()};
  int num_followed = 0;
};

Sights sights_of(std::size_t object, const std::vector<ImageResult>& group, double dt) {
  Sights sights;
  for (const ImageResult& result : group) {
    if (result.seen.size() <= object || result.seen[object].empty()) continue;
    ImageView view = result.views[object];
    view.share /= dt;
    sights.image.add(view, result.seen[object]);
    sights.num_followed += result.num_followed[object];
    sights.starts.insert(sights.starts.end(), result.starts[object].begin(),
                         result.starts[object].end());
  }
  return sights;
}

MotionStatus status_of(const MotionAnswer& answer) {
  if (answer.is_seen) return answer.moves ? MotionStatus::moving : MotionStatus::stationary;
  return answer.moves ? MotionStatus::predicted : MotionStatus::too_few_points;
}

// @param dt s since the object's own sight.
ObjectMotion make_motion(const MotionAnswer& answer, const ScanObject& object,
                         const Pose& T_lidar_t_lidar_k, double dt) {
  const MotionFit& told = answer.moves ? answer.moving : answer.parked;
  ObjectMotion motion;
  motion.class_name = object.class_name;
  motion.points = object.points;
  motion.centroid_lidar_k = object.centroid;
  motion.status = status_of(answer);
  motion.num_inliers = told.num_inliers;
  motion.rmse_px = told.rmse_px;
  if (answer.moves) motion.T_mov = motion_pose(answer.moving.mean, object.centroid);
  motion.T_lidar_t_lidar_k = T_lidar_t_lidar_k * motion.T_mov;
  motion.velocity_lidar_k = (motion.T_mov * object.centroid - object.centroid) / dt;
  motion.yaw_rate = answer.moves ? answer.moving.mean[2] / dt : 0;
  const Eigen::Matrix3d R = T_lidar_t_lidar_k.linear();
  if (answer.is_seen || answer.moves)
    motion.position_covariance = R * told.covariance.bottomRightCorner<3, 3>() * R.transpose();
  if (answer.is_seen && !answer.moves) motion.unproven_step = R * answer.moving.mean.tail<3>();
  return motion;
}

}  // namespace

void LidarUpsampler::find_objects(const Picture* anchor, const CameraView* view) {
  if (key_->objects_found) return;
  const bool by_boxes = config_.detector.type != DetectorOptions::Type::clusters;
  if (by_boxes && anchor == nullptr) return;
  if (!key_->segments) {
    const Stopwatch watch(timing_, "ground and clusters");
    key_->segments = segment_scan(key_->scan, config_.segments);
  }
  const Stopwatch watch(timing_, "candidates");
  key_->objects = by_boxes
                      ? objects_of_boxes(key_->scan, *key_->segments, view->camera, *anchor,
                                         ego_step(anchor->instant).T_to_from, *detector_, config_)
                      : objects_of_clusters(key_->scan, *key_->segments, config_);
  key_->track_of = take_up_scan(store_, key_->objects,
                                {key_->scan, key_->T_rest_lidar_k, key_->step_covariance,
                                 *key_->seen, key_->seen_before.get(), key_->stamp_before},
                                track_options_);
  key_->objects_found = true;
}

void LidarUpsampler::start_tracked(CameraView& view, const std::shared_ptr<const Picture>& anchor) {
  find_objects(anchor.get(), &view);
  const Stopwatch watch(timing_, "points to follow");
  const LidarScan& scan = key_->scan;
  const EgoStep ego = ego_step(anchor->instant);
  const Pose T_camera_lidar_a =
      T_camera_lidar_of(view.camera, scan.T_vehicle_lidar) * ego.T_to_from;
  AnchoredScan anchored;
  cv::Mat texture;
  tbb::parallel_invoke([&] { anchored = anchor_scan(scan, view.camera.model, T_camera_lidar_a); },
                       [&] { cv::cornerMinEigenVal(anchor->image.gray, texture, 5); });
  view.candidates.clear();
  for (std::size_t i = 0; i < key_->objects.size(); ++i)
    view.candidates.push_back(make_candidate(key_->objects[i], store_.tracks[key_->track_of[i]],
                                             key_->T_rest_lidar_k.linear()));
  view.anchor_dt = seconds_between(scan.stamp, anchor->instant);
  if (std::abs(view.anchor_dt) * 1e3 <= config_.timing.pair_tolerance_ms) view.anchor_dt = 0;
  view.points = {};
  view.sampling = anchored.sampling;
  choose_points(view, anchored, texture, scan, T_camera_lidar_a, !ego.covariance.isZero(0),
                config_);
  view.anchor = anchor;
}

void LidarUpsampler::follow_objects(CameraView& view, const Picture& picture,
                                    ImageResult& result) const {
  const Pose& ego = result.ego.T_to_from;
  std::vector<Ways> ways(key_->objects.size());
  for (std::size_t i = 0; i < ways.size(); ++i) {
    const ObjectTrack& track = store_.tracks[key_->track_of[i]];
    const Eigen::Vector3d& centroid = key_->objects[i].centroid;
    const TrackState now = predicted(track.latest, picture.instant, track_options_.noise);
    const double m_per_px = std::max(1., centroid.norm()) / view.camera.model.fx;
    result.starts.push_back(motions_to_try(
        track, expected_motion(now, key_->T_rest_lidar_k.linear(), 0, track_options_).mean,
        motion_with_us(ego, centroid), 0.3 * config_.klt.window_px * m_per_px));
    for (const Twist& motion : result.starts[i])
      ways[i].T_mov.push_back(motion_pose(motion, centroid));
    // Two and a half sigmas, where that is more than what a patch finds by itself.
    const double sigma = std::sqrt(0.5 * now.covariance.topLeftCorner<2, 2>().trace());
    if (2.5 * sigma > config_.klt.window_px * m_per_px) ways[i].reach_m = 2.5 * sigma;
  }
  follow_ways(view, picture, T_camera_lidar_of(view.camera, key_->scan.T_vehicle_lidar) * ego, ways,
              config_.klt);
  for (std::size_t i = 0; i < ways.size(); ++i)
    for (std::size_t j = result.starts[i].size(); j < ways[i].T_mov.size(); ++j) {
      const Eigen::Vector3d& centroid = key_->objects[i].centroid;
      result.starts[i].emplace_back(Twist::Zero());
      result.starts[i].back().tail<3>() = ways[i].T_mov[j] * centroid - centroid;
    }
}

void LidarUpsampler::note_sights(const CameraView& view, const Picture& picture,
                                 ImageResult& result) const {
  const std::size_t count = key_->objects.size();
  const Pose T_camera_lidar_k =
      T_camera_lidar_of(view.camera, key_->scan.T_vehicle_lidar) * result.ego.T_to_from;
  const double dt = seconds_between(key_->scan.stamp, picture.instant);
  result.seen.resize(count);
  result.views.resize(count);
  result.num_followed.assign(count, 0);
  for (const int owner : view.points.owner)
    if (owner >= 0) ++result.num_followed[owner];
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    if (result.num_followed[i] == 0) return;
    const Candidate& candidate = view.candidates[i];
    const auto pairs = correspondences_of(view.points, static_cast<int>(i));
    result.seen[i] = observe(pairs, view.camera.model);
    const double until_anchor = view.anchor_dt == 0 ? 0 : view.anchor_dt - candidate.time_s;
    result.views[i] = {T_camera_lidar_k, dt - candidate.time_s - until_anchor,
                       exp_se3(Twist(candidate.anchor_rate * until_anchor)) * candidate.centroid -
                           candidate.centroid};
    const auto agreed = consensus(pairs, result.seen[i], T_camera_lidar_k, candidate.centroid,
                                  result.starts[i], view.camera.model, config_.object_motion.pose);
    if (agreed) result.starts[i].push_back(*agreed);
  });
}

void LidarUpsampler::follow_tracked(CameraView& view, const Picture& picture, ImageResult& result) {
  {
    const Stopwatch watch(timing_, "point tracking");
    follow_objects(view, picture, result);
  }
  if (!result.ego.covariance.isZero(0)) {
    const Stopwatch watch(timing_, "ego-motion");
    result.ego = camera_step(view, picture, result.ego);
  }
  const Stopwatch watch(timing_, "consensus");
  note_sights(view, picture, result);
}

std::vector<ObjectMotion> LidarUpsampler::tracked_motions(const std::vector<ImageResult>& group,
                                                          const ImageResult& newest) {
  constexpr double kLeast_s = 0.005;  // an image before the object's own sight is taken for this
  std::vector<ObjectMotion> motions(key_->objects.size());
  tbb::parallel_for(std::size_t{0}, motions.size(), [&](std::size_t i) {
    const ScanObject& object = key_->objects[i];
    ObjectTrack& track = store_.tracks[key_->track_of[i]];
    const double dt = std::max(kLeast_s, seconds_between(track.stamp, newest.instant));
    const Sights sights = sights_of(i, group, dt);
    const MotionQuestion question{
        shifted(track.stamp, dt), newest.ego.T_to_from,          newest.ego.covariance,
        object.centroid,          key_->T_rest_lidar_k.linear(), newest.camera.model.fx,
        sights.num_followed};
    const MotionAnswer answer =
        estimate_motion(track, sights.image, question, sights.starts, track_options_);
    track.latest = answer.state;
    track.latest_log_odds = answer.log_odds;
    ObjectMotion& motion = motions[i];
    motion = make_motion(answer, object, newest.ego.T_to_from, dt);
    motion.track_id = track.id;
    motion.num_tracked = static_cast<int>(sights.image.observations.size());
    const Appearance on_picture =
        shown(group, key_->scan, motion, config_.detector.clusters.min_visible);
    if (on_picture.camera == nullptr) return;
    motion.camera_label = on_picture.camera->label;
    motion.box = on_picture.box;
  });
  return motions;
}

}  // namespace lidar_upsampling
