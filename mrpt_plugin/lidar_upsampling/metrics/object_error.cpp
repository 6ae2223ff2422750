// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/metrics/object_error.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "lidar_upsampling/metrics/scan_motion.h"

namespace lidar_upsampling {

bool is_moving(const ReferenceMotion& object, const Pose& T_lidar_t_lidar_k_ego, double dt) {
  constexpr double kMinSpeed_m_s = 0.5, kMinSigmas = 3;
  return velocity_error(object, T_lidar_t_lidar_k_ego, dt) > kMinSpeed_m_s &&
         position_error(object, T_lidar_t_lidar_k_ego) > kMinSigmas * object.sigma_m;
}

double position_error(const ReferenceMotion& object, const Pose& T_lidar_t_lidar_k) {
  return (object.T_lidar_t_lidar_k * object.centroid_k - T_lidar_t_lidar_k * object.centroid_k)
      .norm();
}

std::optional<double> depth_error(const ReferenceMotion& object, const Pose& T_lidar_t_lidar_k,
                                  const Pose& T_camera_lidar_t) {
  const double truth = (T_camera_lidar_t * object.T_lidar_t_lidar_k * object.centroid_k).z();
  if (!(truth > 0)) {
    return std::nullopt;
  }
  return std::abs((T_camera_lidar_t * T_lidar_t_lidar_k * object.centroid_k).z() - truth) / truth;
}

double yaw_error(const ReferenceMotion& object, const Pose& T_lidar_t_lidar_k) {
  const Eigen::Matrix3d R =
      T_lidar_t_lidar_k.linear() * object.T_lidar_t_lidar_k.linear().transpose();
  return std::abs(std::atan2(R(1, 0) - R(0, 1), R(0, 0) + R(1, 1)));
}

double velocity_error(const ReferenceMotion& object, const Pose& T_lidar_t_lidar_k, double dt) {
  if (!(dt > 0)) {
    throw std::invalid_argument("object error: the reference must lie after the key scan, dt is " +
                                std::to_string(dt) + " s");
  }
  return position_error(object, T_lidar_t_lidar_k) / dt;
}

std::optional<Pose> recover_motion(const LidarScan& key, const LidarScan& virtual_scan,
                                   const std::vector<int>& object, const std::vector<int>& matches,
                                   const Surface& surface, const std::vector<Pose>& guesses) {
  std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> pairs;
  std::vector<Eigen::Vector3f> points;
  for (const int i : object) {
    points.push_back(key.points[i]);
    if (!matches.empty() && matches[i] >= 0) {
      pairs.emplace_back(key.points[i].cast<double>(),
                         virtual_scan.points[matches[i]].cast<double>());
    }
  }
  // Fewer pairs say little about the object: the others went by occlusion or another carrier.
  if (pairs.size() >= 10 && 4 * pairs.size() >= object.size()) {
    if (const auto fit = fit_rigid(pairs)) return fit;
  }
  const ObjectRegistration found = register_object(points, surface, guesses);
  return found.status == RegistrationStatus::reliable ? std::make_optional(found.T_target_object)
                                                      : std::nullopt;
}

}  // namespace lidar_upsampling
