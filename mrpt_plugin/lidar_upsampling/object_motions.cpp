// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/object_motions.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "lidar_upsampling/tracks/common_errors.h"
#include "lidar_upsampling/tracks/hypotheses.h"
#include "lidar_upsampling/tracks/picture_motion.h"
#include "lidar_upsampling/vision/projection.h"

namespace lidar_upsampling {
namespace {

constexpr double kLeast_s = 0.005;  // no motion is measured in less

// An object on a picture.
struct Appearance {
  const Camera* camera = nullptr;  // null: on none
  int num_points = 0;
  Box2d box;
};

Appearance appearance_of(const Camera& camera, const Pose& T_vehicle_lidar,
                         const std::vector<Eigen::Vector3f>& points,
                         const Pose& T_lidar_t_lidar_k) {
  const Pose T = T_camera_lidar_of(camera, T_vehicle_lidar) * T_lidar_t_lidar_k;
  const Projector pixel_of(camera.model);
  Appearance result{&camera, 0, Box2d::around_nothing()};
  for (const Eigen::Vector3f& point : points) {
    const auto pixel = pixel_of(T * point.cast<double>());
    if (!pixel) continue;
    result.box.extend(pixel->x(), pixel->y());
    ++result.num_points;
  }
  return result;
}

// Of the box around them, in the axes of the lidar frame.
std::vector<Eigen::Vector3f> corners_around(const std::vector<Eigen::Vector3f>& points) {
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& point : points) box.extend(point);
  std::vector<Eigen::Vector3f> corners;
  corners.reserve(8);
  for (int i = 0; i < 8; ++i)
    corners.push_back(box.corner(static_cast<Eigen::AlignedBox3f::CornerType>(i)));
  return corners;
}

Appearance most_of(const std::vector<const Camera*>& cameras, const Pose& T_vehicle_lidar,
                   const std::vector<Eigen::Vector3f>& points, const Pose& T_lidar_t_lidar_k) {
  Appearance best;
  for (const Camera* camera : cameras) {
    const Appearance here = appearance_of(*camera, T_vehicle_lidar, points, T_lidar_t_lidar_k);
    if (here.num_points > best.num_points) best = here;
  }
  return best.num_points > 0 ? best : Appearance{};
}

// On the picture that shows most of it, if any does: one of those that told, or else of the rig. Of
// what is hidden, where it would be. A picture may show of an object what the scan has not met:
// then a corner of it tells.
Appearance shown(const std::vector<const Camera*>& told, const std::vector<const Camera*>& rig,
                 const LidarScan& scan, const ObjectMotion& motion, const ObjectTrack& track) {
  const std::vector<Eigen::Vector3f> points =
      motion.points.empty() ? track.surface->points() : points_at(scan, motion.points);
  const auto look = [&](const auto& cameras, const std::vector<Eigen::Vector3f>& places) {
    return most_of(cameras, scan.T_vehicle_lidar, places, motion.T_lidar_t_lidar_k);
  };
  Appearance result = look(told, points);
  if (result.camera == nullptr) result = look(rig, points);
  return result.camera != nullptr ? result : look(rig, corners_around(points));
}

std::vector<const Camera*> cameras_of(const std::vector<ImageResult>& group) {
  std::vector<const Camera*> cameras;
  cameras.reserve(group.size());
  for (const ImageResult& result : group) cameras.push_back(&result.camera);
  return cameras;
}

// All that the pictures of an instant show of an object.
struct AllSights {
  ImageFactor image;
  std::vector<Twist> starts{Twist::Zero()};
  int num_followed = 0;
  std::optional<MotionFit> alone;  // by the picture that shows most of it
};

AllSights sights_of(std::size_t object, const std::vector<ImageResult>& group, double dt) {
  AllSights sights;
  for (const ImageResult& result : group) {
    if (result.objects.size() <= object) continue;
    const ObjectOnPicture& sight = result.objects[object];
    sights.num_followed += sight.num_followed;
    if (sight.seen.empty()) continue;
    ImageView view = sight.view;
    view.share /= dt;
    sights.image.add(view, sight.seen);
    sights.starts.insert(sights.starts.end(), sight.starts.begin(), sight.starts.end());
    if (sight.alone && (!sights.alone || sight.alone->num_inliers > sights.alone->num_inliers))
      sights.alone = sight.alone;
  }
  return sights;
}

MotionStatus status_of(const MotionAnswer& answer, int num_found, const Config& config) {
  if (answer.is_seen) return answer.moves ? MotionStatus::moving : MotionStatus::stationary;
  if (answer.moves) return MotionStatus::predicted;
  return num_found < config.object_motion.picture.min_points ? MotionStatus::too_few_points
                                                             : MotionStatus::no_consensus;
}

// Of the centroid over ground, axes of the lidar frame at k. The step of one that is told to stand
// counts in full: odds tell late of what has just begun to move.
Eigen::Matrix3d place_covariance(const MotionAnswer& answer, const MotionQuestion& question) {
  const Eigen::Matrix3d moving = answer.moving.covariance.bottomRightCorner<3, 3>();
  if (answer.moves) return moving;
  const Eigen::Vector3d step = answer.moving.mean.tail<3>();
  const double moves = 1 / (1 + std::exp(-answer.log_odds));
  return ego_error(question).bottomRightCorner<3, 3>() + moves * moving + step * step.transpose();
}

// @param dt s, in which the answer's motion goes on. @param until_image s since the object's own
// sight: less, if the image comes no later than that.
ObjectMotion make_motion(const MotionAnswer& answer, const ScanObject& object,
                         const MotionQuestion& question, double dt, double until_image) {
  const Pose& T_lidar_t_lidar_k = question.T_lidar_t_lidar_k;
  const MotionFit& told = answer.moves ? answer.moving : answer.parked;
  ObjectMotion motion;
  motion.class_name = object.class_name;
  motion.points = object.points;
  motion.centroid_lidar_k = object.centroid;
  motion.num_inliers = told.num_inliers;
  motion.rmse_px = told.rmse_px;
  if (answer.moves) {
    motion.T_mov = motion_pose(answer.moving.mean, object.centroid);
    motion.rate_lidar_k = log_se3(motion.T_mov) / dt;
    if (until_image < dt) motion.T_mov = exp_se3(Twist(motion.rate_lidar_k * until_image));
    motion.velocity_lidar_k = answer.moving.mean.tail<3>() / dt;
    motion.yaw_rate = answer.moving.mean[2] / dt;
  }
  motion.T_lidar_t_lidar_k = T_lidar_t_lidar_k * motion.T_mov;
  const Eigen::Matrix3d R = T_lidar_t_lidar_k.linear();
  if (answer.is_seen || answer.moves)
    motion.position_covariance = R * place_covariance(answer, question) * R.transpose();
  return motion;
}

MotionAnswer answer_for(const ObjectTrack& track, const AllSights& sights,
                        const MotionQuestion& question, const Config& config) {
  if (track.settled) return *track.settled;
  MotionAnswer answer =
      config.object_motion.world_tracks
          ? estimate_motion(track, sights.image, question, sights.starts, config.object_tracks)
          : answer_of_picture(track, sights.alone, question, config.object_motion.picture);
  answer.num_found = static_cast<int>(sights.image.observations.size());
  return answer;
}

// Over ground, since the key scan, m/s, frame at rest; zero where there is no time between.
Eigen::Vector2d ego_velocity(const PreparedScan& key, const ImageResult& newest) {
  const double dt = seconds_between(key.scan.stamp, newest.instant);
  if (dt < kLeast_s) return Eigen::Vector2d::Zero();
  const Eigen::Vector3d step =
      key.T_rest_lidar.linear() * newest.ego.T_to_from.inverse().translation();
  return step.head<2>() / dt;
}

}  // namespace

std::vector<ObjectMotion> estimate_motions(const std::vector<ImageResult>& group,
                                           const ImageResult& newest, const KeyObjects& objects,
                                           const std::vector<const Camera*>& rig, TrackStore& store,
                                           const Config& config) {
  const PreparedScan& key = objects.key;
  const auto in_group = cameras_of(group);
  const Eigen::Vector2d velocity = ego_velocity(key, newest);
  std::vector<ObjectMotion> motions(objects.track_of.size());
  tbb::parallel_for(std::size_t{0}, motions.size(), [&](std::size_t i) {
    const ScanObject& object = objects.object(i);
    ObjectTrack& track = store.tracks[objects.track_of[i]];
    // An image may come before the object's own sight.
    const double until_image = seconds_between(track.stamp, newest.instant);
    const double dt = std::max(kLeast_s, until_image);
    const AllSights sights = sights_of(i, group, dt);
    const MotionQuestion question{shifted(track.stamp, dt), newest.ego.T_to_from,
                                  newest.ego.covariance,    velocity,
                                  object.centroid,          key.T_rest_lidar.linear(),
                                  newest.camera.model.fx,   sights.num_followed};
    const MotionAnswer answer = answer_for(track, sights, question, config);
    if (!track.settled) note_answer(track, answer, config.object_tracks.noise);
    ObjectMotion& motion = motions[i];
    motion = make_motion(answer, object, question, dt, until_image);
    motion.num_tracked = answer.num_found;
    motion.status = status_of(answer, motion.num_tracked, config);
    motion.track_id = track.id;
    const Appearance on_picture = shown(in_group, rig, key.scan, motion, track);
    if (on_picture.camera == nullptr) return;
    motion.camera_label = on_picture.camera->label;
    motion.box = on_picture.box;
  });
  return motions;
}

}  // namespace lidar_upsampling
