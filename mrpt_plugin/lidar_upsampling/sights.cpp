// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/sights.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "lidar_upsampling/objects/anchored_scan.h"
#include "lidar_upsampling/tracks/picture_motion.h"
#include "lidar_upsampling/view_points.h"
#include "lidar_upsampling/view_ways.h"

namespace lidar_upsampling {
namespace {

// What is to be followed of an object; its points lie on the anchor where it was by then.
FollowedObject followed_object(const ScanObject& object, const ObjectTrack& track,
                               const Eigen::Matrix3d& R_rest_lidar_k, const MotionNoise& noise) {
  FollowedObject followed{object.points, object.centroid, object.time_s, Twist::Zero()};
  if (track.expected_log_odds() <= 0) return followed;
  const TrackState state = track.expected_at(track.stamp, noise);
  const Eigen::Vector2d velocity = level_axes(R_rest_lidar_k).transpose() * state.velocity();
  followed.rate[2] = state.mean[5];
  // About the object's centroid, as a twist about the lidar.
  followed.rate.tail<3>() = Eigen::Vector3d(velocity.x(), velocity.y(), 0) -
                            Eigen::Vector3d(followed.rate.head<3>()).cross(object.centroid);
  return followed;
}

// Motions over ground from which an object's points may be found on the next picture: as expected,
// and parked, the likelier first; one, if both lead to the same pixels.
std::vector<Twist> motions_to_try(const ObjectTrack& track, const TrackState& now,
                                  const ScanObject& object, const Eigen::Matrix3d& R_rest_k,
                                  double focal_px, const Config& config) {
  constexpr double kSamePatch = 0.3;  // of a patch's side, within which the search ends alike
  const TrackOptions& options = config.object_tracks;
  const double patch_m = config.klt.window_px * std::max(1., object.centroid.norm()) / focal_px;
  const double log_odds = track.ahead ? track.ahead->log_odds : track.latest_log_odds;
  const Twist expected = expected_motion(now, R_rest_k, 0, options).mean, parked = Twist::Zero();
  if (!config.object_motion.world_tracks) return {expected};
  const bool is_same = expected.tail<3>().norm() < kSamePatch * patch_m;
  if (log_odds > 0) return is_same ? std::vector{expected} : std::vector{expected, parked};
  return is_same ? std::vector{parked} : std::vector{parked, expected};
}

TrackState expected_on_picture(const ObjectTrack& track, Stamp instant, const MotionNoise& noise) {
  return track.ahead ? track.expected_at(instant, noise) : predicted(track.latest, instant, noise);
}

PlanarStep in_lidar(const PlanarStep& step, const Eigen::Matrix3d& R_rest_lidar_k) {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  R.topLeftCorner<2, 2>() = level_axes(R_rest_lidar_k).transpose();
  return {R * step.mean, R * step.covariance * R.transpose()};
}

// Whether one of the expected motions explains most of the points.
bool is_explained(const std::vector<Observation>& seen, const Pose& T_camera_lidar_k,
                  const Eigen::Vector3d& centroid, const std::vector<Twist>& starts,
                  double near_px) {
  constexpr double kMost = 0.5;
  return std::any_of(starts.begin(), starts.end(), [&](const Twist& start) {
    const Pose T = T_camera_lidar_k * motion_pose(start, centroid);
    const auto near = std::count_if(seen.begin(), seen.end(), [&](const Observation& observation) {
      return sq_reprojection_error(observation, T) < near_px * near_px;
    });
    return static_cast<double>(near) >= kMost * static_cast<double>(seen.size());
  });
}

// From what a picture shows to have changed since the anchor to the motion since the object's
// sight, as fast.
void since_sight(MotionFit& fit, const ImageView& view, double dt) {
  if (view.share <= 0 || dt <= 0) return;
  const double stretch = dt / view.share;
  fit.mean.tail<3>() = stretch * (fit.mean.tail<3>() - view.offset);
  fit.covariance.bottomRows<3>() *= stretch;
  fit.covariance.rightCols<3>() *= stretch;
}

}  // namespace

Pose T_camera_lidar_of(const Camera& camera, const Pose& T_vehicle_lidar) {
  return camera.T_vehicle_camera.inverse() * T_vehicle_lidar;
}

void start_view(CameraView& view, const std::shared_ptr<const Picture>& anchor,
                const KeyObjects& objects, const EgoStep& ego, const Config& config) {
  const LidarScan& scan = objects.key.scan;
  const Pose T_camera_lidar_a =
      T_camera_lidar_of(view.camera, scan.T_vehicle_lidar) * ego.T_to_from;
  AnchoredScan anchored;
  cv::Mat texture;
  tbb::parallel_invoke([&] { anchored = anchor_scan(scan, view.camera.model, T_camera_lidar_a); },
                       [&] { cv::cornerMinEigenVal(anchor->image.gray, texture, 5); });
  view.objects.clear();
  for (std::size_t i = 0; i < objects.track_of.size(); ++i)
    view.objects.push_back(followed_object(objects.object(i), objects.track(i),
                                           objects.key.T_rest_lidar.linear(),
                                           config.object_tracks.noise));
  view.anchor_dt = seconds_between(scan.stamp, anchor->instant);
  if (std::abs(view.anchor_dt) * 1e3 <= config.timing.pair_tolerance_ms) view.anchor_dt = 0;
  view.points = {};
  choose_points(view, anchored, texture, scan, T_camera_lidar_a, !ego.covariance.isZero(0), config);
  view.anchor = anchor;
}

std::vector<ObjectOnPicture> follow_objects(CameraView& view, const Picture& picture,
                                            const KeyObjects& objects, const Pose& ego,
                                            const Config& config) {
  const PreparedScan& key = objects.key;
  const std::size_t count = objects.track_of.size();
  std::vector<ObjectOnPicture> sights(count);
  std::vector<Ways> ways(count);
  for (std::size_t i = 0; i < count; ++i) {
    const ScanObject& object = objects.object(i);
    const ObjectTrack& track = objects.track(i);
    if (track.settled) continue;
    const Eigen::Matrix3d R_rest_k = key.T_rest_lidar.linear();
    const TrackState now = expected_on_picture(track, picture.instant, config.object_tracks.noise);
    sights[i].starts = motions_to_try(track, now, object, R_rest_k, view.camera.model.fx, config);
    for (const Twist& motion : sights[i].starts)
      ways[i].motions.push_back(motion_pose(motion, object.centroid));
    if (config.object_motion.world_tracks) ways[i].step = in_lidar(now.step(), R_rest_k);
  }
  follow_ways(view, picture, T_camera_lidar_of(view.camera, key.scan.T_vehicle_lidar) * ego, ways,
              config.klt);
  return sights;
}

void note_sights(std::vector<ObjectOnPicture>& sights, const CameraView& view,
                 const Picture& picture, const KeyObjects& objects, const Pose& ego,
                 const Config& config) {
  const LidarScan& scan = objects.key.scan;
  const PictureMotionOptions& options = config.object_motion.picture;
  const Pose T_camera_lidar_k = T_camera_lidar_of(view.camera, scan.T_vehicle_lidar) * ego;
  const double dt = seconds_between(scan.stamp, picture.instant);
  for (const int owner : view.points.owner)
    if (owner >= 0 && !objects.track(owner).settled) ++sights[owner].num_followed;
  tbb::parallel_for(std::size_t{0}, sights.size(), [&](std::size_t i) {
    ObjectOnPicture& sight = sights[i];
    if (sight.num_followed == 0) return;
    const FollowedObject& object = view.objects[i];
    const auto pairs = correspondences_of(view.points, static_cast<int>(i));
    sight.seen = observe(pairs, view.camera.model);
    weigh_by_texture(sight.seen, pairs, config.object_tracks.points.sigma_px);
    const double until_anchor = view.anchor_dt - object.time_s;
    sight.view = {T_camera_lidar_k, dt - object.time_s - until_anchor,
                  exp_se3(Twist(object.rate * until_anchor)) * object.centroid - object.centroid};
    if (config.object_motion.world_tracks &&
        is_explained(sight.seen, T_camera_lidar_k, object.centroid, sight.starts,
                     options.pose.first_gate_px))
      return;
    sight.alone =
        picture_motion(pairs, view.camera.model, T_camera_lidar_k, object.centroid, options);
    if (!sight.alone) return;
    since_sight(*sight.alone, sight.view, dt - object.time_s);
    sight.starts.push_back(sight.alone->mean);
  });
}

}  // namespace lidar_upsampling
