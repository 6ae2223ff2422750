// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "label_score.h"

#include <Eigen/LU>
#include <algorithm>
#include <set>
#include <utility>

#include "lidar_upsampling/vision/projection.h"

namespace lidar_upsampling {

namespace {

using RowsAt = std::multimap<std::int64_t, const ReportedObject*>;
using TracksOf = std::map<std::string, int>;  // the last track of each labelled object

/// @param place of it, at the instant.
Eigen::Vector3d at_key(const Eigen::Vector3d& place, const ReportedObject& row,
                       const LabelledInstant& instant) {
  return instant.T_lidar_k_lidar_t * (place - instant.dt * row.velocity);
}

/// Of the points' centroid, which goes another way than the middle in a turn.
Eigen::Vector3d centroid_at_key(const ReportedObject& row, const LabelledInstant& instant) {
  const Eigen::Vector3d by_turn =
      row.yaw_rate * Eigen::Vector3d::UnitZ().cross(row.middle - row.position);
  return at_key(row.position + instant.dt * by_turn, row, instant);
}

bool is_ignored(const ReportedObject& row, const LabelledInstant& instant, double grown) {
  return std::any_of(instant.ignored.begin(), instant.ignored.end(), [&](const auto& area) {
    const auto& [camera, box] = area;
    const Pose T_camera_lidar = camera.T_vehicle_camera.inverse() * instant.T_vehicle_lidar;
    const auto pixel = project(camera.model, T_camera_lidar * row.position);
    return pixel && pixel->x() >= box.left - grown && pixel->x() <= box.right + grown &&
           pixel->y() >= box.top - grown && pixel->y() <= box.bottom + grown;
  });
}

/// Of the labelled object at the place on it that the row tells of; without a row, at its centre.
Eigen::Vector3d true_velocity(const LabelledBox& box, const ReportedObject* row,
                              const LabelledInstant& instant) {
  if (row == nullptr) return box.velocity;
  const Eigen::Vector3d centre_k = box.T_box_lidar.inverse().translation();
  const Eigen::AngleAxisd halfway(0.5 * instant.dt * box.yaw_rate, Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d arm = halfway * (instant.T_lidar_k_lidar_t.linear().transpose() *
                                         (at_key(row->middle, *row, instant) - centre_k));
  return box.velocity + box.yaw_rate * Eigen::Vector3d::UnitZ().cross(arm);
}

void judge_box(const LabelledBox& box, const ReportedObject* row, const LabelledInstant& instant,
               const LabelScoreOptions& options, LabelScore& score) {
  if (!box.counts) return;
  if (box.speed_mps > options.mover_mps) {
    const Eigen::Vector3d told = row != nullptr ? row->velocity : Eigen::Vector3d::Zero();
    const double error = (told - true_velocity(box, row, instant)).head<2>().norm();
    score.movers.push_back({box.id, box.class_name, box.range_m, box.speed_mps, row != nullptr,
                            error * instant.dt, error});
  } else if (box.speed_mps < options.parked_mps && row != nullptr) {
    score.parked.push_back({row->moving, row->moving ? row->velocity.norm() * instant.dt : 0});
  }
}

/// @param place_k of the row, lidar frame at the key scan.
void judge_covariance(const LabelledBox& box, const ReportedObject& row,
                      const Eigen::Vector3d& place_k, LabelScore& score) {
  if (!box.counts || !box.T_lidar_t_lidar_k || row.covariance.isZero() || !holds(box, place_k, 0))
    return;
  const Eigen::Vector3d error = row.position - *box.T_lidar_t_lidar_k * place_k;
  score.rows.push_back(
      {row.status, error.dot(row.covariance.inverse() * error), row.sigma, error.norm()});
}

void follow(const LabelledBox& box, const ReportedObject* row, TracksOf& tracks,
            LabelScore& score) {
  if (row == nullptr || row->track < 0) return;
  const auto [last, is_new] = tracks.emplace(box.id, row->track);
  score.num_followed += is_new ? 1 : 0;
  if (last->second == row->track) return;
  ++score.num_switches;
  last->second = row->track;
}

void judge_instant(const LabelledInstant& instant, const RowsAt& rows,
                   const LabelScoreOptions& options, TracksOf& tracks, LabelScore& score) {
  const auto [first, last] = rows.equal_range(instant.told_at);
  std::set<const ReportedObject*> claimed;
  for (const LabelledBox& box : instant.boxes) {
    const bool stands = box.velocity_known && box.speed_mps < options.parked_mps;
    const ReportedObject* mine = nullptr;
    std::pair<bool, int> best;  // a post beside a walker is not the walker
    for (auto it = first; it != last; ++it) {
      const ReportedObject& row = *it->second;
      if (!row.in_view && !box.counts) continue;
      const Eigen::Vector3d place = centroid_at_key(row, instant);
      if (!holds(box, place, options.grown_m)) continue;
      judge_covariance(box, row, place, score);
      if (!stands) claimed.insert(&row);
      const std::pair<bool, int> rank(holds(box, place, 0), row.points);
      if (mine != nullptr && rank <= best) continue;
      mine = &row;
      best = rank;
    }
    if (mine != nullptr) claimed.insert(mine);
    judge_box(box, mine, instant, options, score);
    follow(box, mine, tracks, score);
  }
  for (auto row = first; row != last; ++row)
    if (row->second->moving && (row->second->in_view || options.all_around) &&
        claimed.count(row->second) == 0 && !is_ignored(*row->second, instant, options.ignored_px))
      score.false_shifts_m.push_back(row->second->velocity.norm() * instant.dt);
  ++score.num_images;
}

/// Any corner, or the centre: a label is there for what the picture cuts off, too.
bool box_in_view(const Pose& T_vehicle_box, const Eigen::Vector3d& size,
                 const std::vector<Camera>& cameras) {
  if (cameras.empty()) return true;
  for (const Camera& camera : cameras) {
    const Pose T_camera_box = camera.T_vehicle_camera.inverse() * T_vehicle_box;
    for (int corner = 0; corner <= 8; ++corner) {
      Eigen::Vector3d point = Eigen::Vector3d::Zero();
      if (corner < 8)
        point = 0.5 * Eigen::Vector3d((corner & 1) != 0 ? size.x() : -size.x(),
                                      (corner & 2) != 0 ? size.y() : -size.y(),
                                      (corner & 4) != 0 ? size.z() : -size.z());
      if (project(camera.model, T_camera_box * point)) return true;
    }
  }
  return false;
}

bool is_hit(const LabelledBox& box, const LidarScan& key, int min_points) {
  const Eigen::Vector3d centre = box.T_box_lidar.inverse().translation();
  const double reach_sq = 0.25 * box.size.squaredNorm();
  int count = 0;
  for (const Eigen::Vector3f& point_f : key.points) {
    const Eigen::Vector3d point = point_f.cast<double>();
    if ((point - centre).squaredNorm() > reach_sq || !holds(box, point, 0)) continue;
    if (++count >= min_points) return true;
  }
  return count >= min_points;
}

std::optional<LabelledBox> labelled_box(const Truth& truth, const TrueObject& object,
                                        const LidarScan& key, Stamp stamp,
                                        const Pose& T_world_lidar_t) {
  const auto T_box_lidar = box_in_scan(truth, object, key);
  if (!T_box_lidar) return {};
  const Stamp halfway = shifted(key.stamp, 0.5 * seconds_between(key.stamp, stamp));
  const auto velocity = object.velocity_at(halfway);
  LabelledBox box;
  box.id = object.id;
  box.class_name = object.class_name;
  box.T_box_lidar = *T_box_lidar;
  box.size = object.size;
  box.velocity_known = velocity.has_value();
  if (velocity) {
    box.speed_mps = velocity->norm();
    box.velocity = T_world_lidar_t.linear().transpose() * *velocity;
    box.yaw_rate = object.yaw_rate_at(halfway);
  }
  box.range_m = T_box_lidar->inverse().translation().head<2>().norm();
  return box;
}

void add_ignored(const Truth& truth, const std::vector<Camera>& cameras, Stamp stamp,
                 LabelledInstant& instant) {
  const auto near = [&](auto area) { return std::abs(seconds_between(area->first, stamp)); };
  auto nearest = truth.ignored.lower_bound(stamp);
  if (nearest != truth.ignored.begin() &&
      (nearest == truth.ignored.end() || near(std::prev(nearest)) < near(nearest)))
    nearest = std::prev(nearest);
  constexpr double kSamePicture_s = 0.06;
  if (nearest == truth.ignored.end() || near(nearest) > kSamePicture_s) return;
  const auto [first, last] = truth.ignored.equal_range(nearest->first);
  for (auto area = first; area != last; ++area)
    for (const Camera& camera : cameras)
      if (camera.label == area->second.camera)
        instant.ignored.emplace_back(camera, area->second.box);
}

}  // namespace

bool holds(const LabelledBox& box, const Eigen::Vector3d& point_k, double grown) {
  return ((box.T_box_lidar * point_k).array().abs() < 0.5 * box.size.array() + grown).all();
}

std::optional<LabelledInstant> labelled_instant(const Truth& truth, const LidarScan& key,
                                                Stamp stamp, const std::vector<Camera>& cameras,
                                                const LabelScoreOptions& options) {
  const auto vehicle_k = truth.T_world_vehicle.at(key.stamp);
  const auto vehicle_t = truth.T_world_vehicle.at(stamp);
  if (!vehicle_k || !vehicle_t) return {};
  const Pose T_world_lidar_k = vehicle_k->T_world_vehicle * key.T_vehicle_lidar;
  const Pose T_world_lidar_t = vehicle_t->T_world_vehicle * key.T_vehicle_lidar;
  LabelledInstant instant;
  instant.told_at = stamp.time_since_epoch().count();
  instant.dt = seconds_between(key.stamp, stamp);
  instant.T_lidar_k_lidar_t = T_world_lidar_k.inverse() * T_world_lidar_t;
  instant.T_vehicle_lidar = key.T_vehicle_lidar;
  for (const TrueObject& object : truth.objects) {
    auto box = labelled_box(truth, object, key, stamp, T_world_lidar_t);
    if (!box) continue;
    const auto at_t = object.T_world_object.at(stamp);
    const Pose T_world_box =
        at_t ? at_t->T_world_vehicle : T_world_lidar_k * box->T_box_lidar.inverse();
    if (at_t) box->T_lidar_t_lidar_k = T_world_lidar_t.inverse() * T_world_box * box->T_box_lidar;
    box->counts =
        box->velocity_known && box->range_m <= options.max_range_m &&
        (options.all_around ||
         box_in_view(vehicle_t->T_world_vehicle.inverse() * T_world_box, box->size, cameras)) &&
        is_hit(*box, key, options.min_points);
    instant.boxes.push_back(std::move(*box));
  }
  add_ignored(truth, cameras, stamp, instant);
  return instant;
}

LabelScore score_labels(const std::vector<LabelledInstant>& instants,
                        const std::vector<ReportedObject>& told, const LabelScoreOptions& options) {
  RowsAt rows;
  for (const ReportedObject& row : told) rows.emplace(row.stamp, &row);
  LabelScore score;
  TracksOf tracks;
  for (const LabelledInstant& instant : instants)
    judge_instant(instant, rows, options, tracks, score);
  return score;
}

void append(LabelScore& total, const LabelScore& score) {
  const auto add = [](auto& to, const auto& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  total.num_images += score.num_images;
  add(total.movers, score.movers);
  add(total.parked, score.parked);
  add(total.false_shifts_m, score.false_shifts_m);
  add(total.rows, score.rows);
  total.num_followed += score.num_followed;
  total.num_switches += score.num_switches;
}

}  // namespace lidar_upsampling
