// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "instant_reference.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "key_objects.h"
#include "lidar_upsampling/objects/ground.h"
#include "lidar_upsampling/registration/scan_registration.h"

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
  const LidarScan *from_scan = nullptr, *to_scan = nullptr;
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

/// With what a constant velocity between the two does not know of braking and turning.
double interpolated_sigma(const Between& between, double from, double to) {
  const double u = between.share;
  const double manoeuvre =
      0.5 * kManoeuvre_mps2 * std::abs(u * (1 - u)) * between.gap_s * between.gap_s;
  return std::hypot((1 - u) * from, u * to, manoeuvre);
}

double sigma_at(const Between& between, std::size_t i) {
  const double from = between.from != nullptr ? between.from->objects[i].sigma_m : 0;
  return interpolated_sigma(between, from, between.to->objects[i].sigma_m);
}

/// Of a point that stands, by the ego-motion's registration alone.
double ego_sigma_at(const Between& between, const Eigen::Vector3d& point) {
  const auto sigma = [&](const ScanMotions* scan) {
    if (scan == nullptr) return 0.;
    Eigen::Matrix<double, 3, 6> by_twist;
    by_twist << -skew(scan->T_ego * point), Eigen::Matrix3d::Identity();
    const Eigen::Matrix3d covariance = by_twist * scan->ego_covariance * by_twist.transpose();
    return std::sqrt(covariance.trace());
  };
  return interpolated_sigma(between, sigma(between.from), sigma(between.to));
}

ObjectReference referenced(const ObjectReference& object, const Between& between, std::size_t i,
                           const Pose& T_ego, double dt) {
  ObjectReference result = object;
  for (const ScanMotions* scan : {between.to, between.from}) {
    if (scan == nullptr || scan->objects[i].status == RegistrationStatus::reliable) continue;
    result.excluded = to_string(scan->objects[i].status);
    return result;
  }
  // By the longer step, which tells slow ones from standing ones.
  result.moving = between.to->objects[i].moving;
  const bool at_scan = between.from == nullptr && between.share == 1;
  if (result.moving || at_scan) {
    result.motion.T_lidar_t_lidar_k = object_at(between, i, T_ego);
    result.motion.sigma_m = sigma_at(between, i);
  } else {
    // What stands needs no registration of its own, which would scatter by 2 cm.
    result.motion.T_lidar_t_lidar_k = T_ego;
    result.motion.sigma_m = ego_sigma_at(between, result.motion.centroid_k);
  }
  result.speed = velocity_error(result.motion, T_ego, dt);
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
    const Pose T_key_scan = motions.objects[reference.indices[i]].T_lidar_lidar_k.inverse();
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

std::optional<Between> between_scans(RegisteredMotions& motions, const InstantRequest& request,
                                     const Twist& ego_rate) {
  const auto& [key, objects, around, stamp, cameras, options] = request;
  Between between;
  const bool has_before = around.before != nullptr && around.before->stamp > key.stamp;
  const LidarScan* last = around.after != nullptr ? around.after : around.before;
  if (last == nullptr || !(last->stamp > key.stamp)) return {};
  Stamp from = key.stamp;
  if (has_before && around.after != nullptr) {
    between.from = motions.to(*around.before, ego_rate);
    if (between.from == nullptr) return {};
    between.from_scan = around.before;
    from = around.before->stamp;
  }
  between.to = motions.to(*last, ego_rate);
  if (between.to == nullptr) return {};
  between.to_scan = last;
  between.gap_s = seconds_between(from, last->stamp);
  between.share = seconds_between(from, stamp) / between.gap_s;
  return between;
}

}  // namespace

const ScanMotions* RegisteredMotions::to(const LidarScan& scan, const Twist& ego_rate) {
  const auto [found, is_new] = known_.emplace(scan.stamp, std::nullopt);
  if (is_new) {
    const double dt = seconds_between(key_.stamp, scan.stamp);
    if (const auto ego = register_scans(key_.points, scan.points, exp_se3(Twist(dt * ego_rate)))) {
      found->second.emplace(Known{{ego->T_target_source, ego->covariance, {}},
                                  surface_to_judge_by(without_ground(scan))});
      found->second->motions.objects.resize(objects_.size());
    }
  }
  return found->second ? &found->second->motions : nullptr;
}

void RegisteredMotions::find(const LidarScan& scan, const std::vector<int>& which) {
  Known& known = *known_.at(scan.stamp);
  const Pose& T_ego = known.motions.T_ego;
  const double dt = seconds_between(key_.stamp, scan.stamp);
  tbb::parallel_for(std::size_t{0}, which.size(), [&](std::size_t i) {
    const ObjectReference& object = objects_[which[i]];
    ScanMotions::Object& result = known.motions.objects[which[i]];
    if (result.known) return;
    const auto found = register_object(points_at(key_, object.points), known.surface,
                                       {T_ego, Pose::Identity()}, options_.registration);
    // Repeated scans of parked cars scatter by 2 cm, whatever the registration says of itself.
    const ReferenceMotion motion{object.motion.centroid_k, found.T_target_object,
                                 std::hypot(0.02, found.spread_m)};
    result = {true, found.status, motion.T_lidar_t_lidar_k, motion.sigma_m,
              is_moving(motion, T_ego, dt)};
  });
}

std::optional<InstantReference> reference_by_truth(const Truth& truth,
                                                   const InstantRequest& request) {
  const LidarScan& key = request.key;
  const auto T_ego = true_ego_motion(truth, key, request.stamp);
  if (!T_ego) return {};
  const LidarScan& nearest = *request.around.nearest;
  InstantReference reference;
  reference.T_ego = *T_ego;
  reference.by_truth = true;
  reference.interpolated = nearest.stamp != request.stamp;
  for (const int i : in_scope(request.objects, key, *T_ego, request.cameras, request.options)) {
    const ObjectReference& object = request.objects[i];
    const auto box = std::find_if(truth.objects.begin(), truth.objects.end(),
                                  [&](const TrueObject& other) { return other.id == object.id; });
    const auto motion = true_object_motion(truth, *box, key, request.stamp);
    if (!motion) continue;
    reference.indices.push_back(i);
    reference.objects.push_back(object);
    ObjectReference& placed = reference.objects.back();
    placed.motion = {object.motion.centroid_k, *motion, 0};
    placed.moving = box->moves_at(request.stamp);
    if (!box->velocity_at(request.stamp)) placed.excluded = "velocity_unknown";
    placed.speed = velocity_error(placed.motion, *T_ego, seconds_between(key.stamp, request.stamp));
  }
  std::vector<bool> is_judged(request.objects.size(), false);
  for (const int i : reference.indices) is_judged[i] = true;
  for (std::size_t i = 0; i < request.objects.size(); ++i)
    if (!is_judged[i])
      reference.other_points.insert(reference.other_points.end(), request.objects[i].points.begin(),
                                    request.objects[i].points.end());
  reference.scan = brought_to(truth, nearest, request.stamp);
  return reference;
}

std::optional<InstantReference> reference_by_registration(RegisteredMotions& motions,
                                                          const InstantRequest& request,
                                                          const Twist& ego_rate) {
  const auto between = between_scans(motions, request, ego_rate);
  if (!between) return {};
  const LidarScan& nearest = *request.around.nearest;
  const ScanMotions* to_nearest = motions.to(nearest, ego_rate);
  if (to_nearest == nullptr) return {};
  InstantReference reference;
  reference.interpolated = nearest.stamp != request.stamp;
  reference.T_ego = ego_at(*between);
  reference.indices =
      in_scope(request.objects, request.key, reference.T_ego, request.cameras, request.options);
  for (const LidarScan* scan : {between->from_scan, between->to_scan, &nearest})
    if (scan != nullptr) motions.find(*scan, reference.indices);
  const double dt = seconds_between(request.key.stamp, request.stamp);
  for (const int i : reference.indices)
    reference.objects.push_back(referenced(request.objects[i], *between, i, reference.T_ego, dt));
  reference.scan = reference.interpolated
                       ? brought_along(nearest, *to_nearest, reference, request.key, request.stamp)
                       : nearest;
  return reference;
}

}  // namespace lidar_upsampling
