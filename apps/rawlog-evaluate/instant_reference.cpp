// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "instant_reference.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "lidar_upsampling/objects/ground.h"
#include "lidar_upsampling/registration/scan_registration.h"
#include "lidar_upsampling/vision/projection.h"

namespace lidar_upsampling {

namespace {

// One sigma of what road users brake and turn with, m/s^2: what a constant velocity between two
// scans does not know.
constexpr double kManoeuvre_mps2 = 2;
// How far beside an object's key points its points on another scan are looked for, m.
constexpr double kBeside_m = 0.3;

/// The instant between two scans, of which the first may be the key scan.
struct Between {
  const ScanMotions* from = nullptr;  ///< null: the key scan
  const ScanMotions* to = nullptr;
  double share = 1;  ///< of the way; above one beyond the last scan
  double gap_s = 0;
};

Pose interpolated(const Pose& from, const Pose& to, double share) {
  return exp_se3(Twist(share * log_se3(to * from.inverse()))) * from;
}

Pose ego_at(const Between& between) {
  const Pose from = between.from != nullptr ? between.from->T_ego : Pose::Identity();
  return interpolated(from, between.to->T_ego, between.share);
}

/// Ego-motion and motion over ground each by its own twist.
Pose object_at(const Between& between, std::size_t i, const Pose& T_ego) {
  const auto over_ground = [i](const ScanMotions& scan) {
    return scan.T_ego.inverse() * scan.objects[i].T_lidar_lidar_k;
  };
  const Pose from = between.from != nullptr ? over_ground(*between.from) : Pose::Identity();
  return T_ego * interpolated(from, over_ground(*between.to), between.share);
}

double sigma_at(const Between& between, std::size_t i) {
  const double u = between.share;
  const double from = between.from != nullptr ? between.from->objects[i].sigma_m : 0;
  const double manoeuvre =
      0.5 * kManoeuvre_mps2 * std::abs(u * (1 - u)) * between.gap_s * between.gap_s;
  return std::hypot((1 - u) * from, u * between.to->objects[i].sigma_m, manoeuvre);
}

ObjectReference referenced(const ObjectReference& object, const Between& between, std::size_t i,
                           const Pose& T_ego, double dt) {
  ObjectReference result = object;
  for (const ScanMotions* scan : {between.to, between.from}) {
    if (scan == nullptr || scan->objects[i].status == RegistrationStatus::reliable) continue;
    result.excluded = to_string(scan->objects[i].status);
    return result;
  }
  result.motion.T_lidar_t_lidar_k = object_at(between, i, T_ego);
  result.motion.sigma_m = sigma_at(between, i);
  // By the longer step, which tells slow ones from standing ones.
  result.moving = between.to->objects[i].moving;
  result.speed = ground_speed(result.motion, T_ego, dt);
  return result;
}

// What covers the object's points of the key scan, in whose frame it is.
Eigen::AlignedBox3d room_of(const ObjectReference& object, const LidarScan& key) {
  Eigen::AlignedBox3d room;
  for (const int i : object.points) room.extend(key.points[i].cast<double>());
  const Eigen::Vector3d beside = Eigen::Vector3d::Constant(kBeside_m);
  return {room.min() - beside, room.max() + beside};
}

/// The scan as it would have been at the instant.
LidarScan brought_along(const LidarScan& scan, const ScanMotions& motions,
                        const InstantReference& reference, const LidarScan& key, Stamp stamp) {
  LidarScan moved = scan;
  moved.stamp = stamp;
  const Pose T_t_scan = reference.T_ego * motions.T_ego.inverse();
  for (auto& point : moved.points) point = (T_t_scan * point.cast<double>()).cast<float>();
  for (std::size_t i = 0; i < reference.objects.size(); ++i) {
    const ObjectReference& object = reference.objects[i];
    if (!object.moving || !object.excluded.empty()) continue;
    const Eigen::AlignedBox3d room = room_of(object, key);
    const Pose T_key_scan = motions.objects[i].T_lidar_lidar_k.inverse();
    const Pose T_own = object.motion.T_lidar_t_lidar_k * T_key_scan;
    for (std::size_t j = 0; j < scan.size(); ++j) {
      const Eigen::Vector3d point = scan.points[j].cast<double>();
      if (room.contains(T_key_scan * point)) moved.points[j] = (T_own * point).cast<float>();
    }
  }
  return moved;
}

// Normals are of ten neighbours however dense points are: what is judged by stays what it was where
// the method's own registration is made a better one.
Surface surface_to_judge_by(std::vector<Eigen::Vector3f> points) {
  NormalOptions options;
  options.min_radius_m = 0;
  return Surface(std::move(points), options);
}

std::optional<Between> between_scans(RegisteredMotions& motions, const LidarScan& key,
                                     const ScansAround& around, Stamp stamp,
                                     const Twist& ego_rate) {
  Between between;
  const bool has_before = around.before != nullptr && around.before->stamp > key.stamp;
  const LidarScan* last = around.after != nullptr ? around.after : around.before;
  if (last == nullptr || !(last->stamp > key.stamp)) return {};
  Stamp from = key.stamp;
  if (has_before && around.after != nullptr) {
    between.from = motions.to(*around.before, ego_rate);
    if (between.from == nullptr) return {};
    from = around.before->stamp;
  }
  between.to = motions.to(*last, ego_rate);
  if (between.to == nullptr) return {};
  between.gap_s = seconds_between(from, last->stamp);
  between.share = seconds_between(from, stamp) / between.gap_s;
  return between;
}

}  // namespace

const ScanMotions* RegisteredMotions::to(const LidarScan& scan, const Twist& ego_rate) {
  const auto [found, is_new] = known_.emplace(scan.stamp, std::nullopt);
  if (is_new) {
    const double dt = seconds_between(key_.stamp, scan.stamp);
    found->second = registered(scan, exp_se3(Twist(dt * ego_rate)));
  }
  return found->second ? &*found->second : nullptr;
}

std::optional<ScanMotions> RegisteredMotions::registered(const LidarScan& scan,
                                                         const Pose& T_ego_guess) const {
  const auto ego = register_scans(key_.points, scan.points, T_ego_guess);
  if (!ego) return {};
  ScanMotions motions;
  motions.T_ego = ego->T_target_source;
  motions.objects.resize(objects_.size());
  const double dt = seconds_between(key_.stamp, scan.stamp);
  const Surface surface = surface_to_judge_by(without_ground(scan));
  tbb::parallel_for(std::size_t{0}, objects_.size(), [&](std::size_t i) {
    const auto found = register_object(points_at(key_, objects_[i].points), surface,
                                       {motions.T_ego, Pose::Identity()}, options_.registration);
    // Repeated scans of parked cars scatter by 2 cm, whatever the registration says of itself.
    const ReferenceMotion motion{objects_[i].motion.centroid_k, found.T_target_object,
                                 std::hypot(0.02, found.spread_m)};
    motions.objects[i] = {found.status, motion.T_lidar_t_lidar_k, motion.sigma_m,
                          is_moving(motion, motions.T_ego, dt, options_.moving)};
  });
  return motions;
}

std::optional<InstantReference> reference_by_truth(const Truth& truth, const LidarScan& key,
                                                   const std::vector<ObjectReference>& objects,
                                                   const ScansAround& around, Stamp stamp) {
  const auto T_ego = true_ego_motion(truth, key, stamp);
  if (!T_ego) return {};
  InstantReference reference{{}, *T_ego, {}, around.nearest->stamp != stamp, true};
  for (const ObjectReference& object : objects) {
    const auto box = std::find_if(truth.objects.begin(), truth.objects.end(),
                                  [&](const TrueObject& other) { return other.id == object.id; });
    const auto motion = true_object_motion(truth, *box, key, stamp);
    if (!motion) continue;
    reference.objects.push_back(object);
    ObjectReference& placed = reference.objects.back();
    placed.motion = {object.motion.centroid_k, *motion, 0};
    placed.moving = box->moves_at(stamp);
    placed.speed = ground_speed(placed.motion, *T_ego, seconds_between(key.stamp, stamp));
  }
  reference.scan =
      reference.interpolated ? brought_to(truth, *around.nearest, stamp) : *around.nearest;
  return reference;
}

std::optional<InstantReference> reference_by_registration(
    RegisteredMotions& motions, const LidarScan& key, const std::vector<ObjectReference>& objects,
    const ScansAround& around, Stamp stamp, const Twist& ego_rate) {
  const auto between = between_scans(motions, key, around, stamp, ego_rate);
  if (!between) return {};
  InstantReference reference;
  reference.interpolated = around.nearest->stamp != stamp;
  reference.T_ego = ego_at(*between);
  const double dt = seconds_between(key.stamp, stamp);
  for (std::size_t i = 0; i < objects.size(); ++i)
    reference.objects.push_back(referenced(objects[i], *between, i, reference.T_ego, dt));
  const ScanMotions* nearest = motions.to(*around.nearest, ego_rate);
  if (nearest == nullptr) return {};
  reference.scan = reference.interpolated
                       ? brought_along(*around.nearest, *nearest, reference, key, stamp)
                       : *around.nearest;
  return reference;
}

bool in_view(const Camera& camera, const LidarScan& scan, const Eigen::Vector3d& point_in_lidar) {
  const Eigen::Vector3d in_camera =
      camera.T_vehicle_camera.inverse() * scan.T_vehicle_lidar * point_in_lidar;
  return project(camera.model, in_camera).has_value();
}

bool in_view(const std::vector<Camera>& cameras, const LidarScan& scan,
             const Eigen::Vector3d& point_in_lidar) {
  return std::any_of(cameras.begin(), cameras.end(),
                     [&](const Camera& camera) { return in_view(camera, scan, point_in_lidar); });
}

void keep_in_scope(InstantReference& reference, const LidarScan& key,
                   const std::vector<Camera>& cameras, const EvaluationOptions& options) {
  const auto out_of_scope = [&](const ObjectReference& object) {
    const Eigen::Vector3d& centre = object.motion.centroid_k;
    const bool seen =
        options.all_around || cameras.empty() || in_view(cameras, key, reference.T_ego * centre);
    return !seen || centre.head<2>().norm() > options.max_range_m;
  };
  auto& objects = reference.objects;
  objects.erase(std::remove_if(objects.begin(), objects.end(), out_of_scope), objects.end());
}

}  // namespace lidar_upsampling
