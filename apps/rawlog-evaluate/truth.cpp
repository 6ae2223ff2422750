// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "truth.h"

#include <mrpt/poses/CPose3D.h>

#include <stdexcept>

#include "lidar_upsampling/csv_table.h"
#include "lidar_upsampling/io/images.h"

namespace lidar_upsampling {

namespace {

// The simulator writes at every image: further apart, something is missing.
constexpr InterpolationLimits kTruthLimits{0.25, 0};

Stamp stamp_of(const CsvTable& table, std::size_t row) {
  return Stamp(mrpt::Clock::duration(table.integer(row, "stamp")));
}

Pose pose_of(const CsvTable& table, std::size_t row) {
  const auto value = [&](const char* column) { return table.number(row, column); };
  return from_mrpt(mrpt::poses::CPose3D(value("x"), value("y"), value("z"), value("yaw"),
                                        value("pitch"), value("roll")));
}

std::string ego_csv_beside(const std::string& objects_csv) {
  const std::string ending = "_objects.csv";
  const auto at = objects_csv.rfind(ending);
  if (at == std::string::npos || at + ending.size() != objects_csv.size())
    throw std::runtime_error(objects_csv + ": the name must end in " + ending +
                             ", as the ego-motion is looked for in ..._ego.csv beside it");
  return objects_csv.substr(0, at) + "_ego.csv";
}

std::optional<Pose> lidar_in_world(const Truth& truth, const LidarScan& scan, Stamp stamp) {
  const auto vehicle = truth.T_world_vehicle.at(stamp);
  if (!vehicle) return std::nullopt;
  return vehicle->T_world_vehicle * scan.T_vehicle_lidar;
}

}  // namespace

bool TrueObject::moves_at(Stamp stamp) const {
  const auto next = moving.lower_bound(stamp);
  if (next == moving.begin()) return next->second;
  const auto before = std::prev(next);
  if (next == moving.end()) return before->second;
  return next->first - stamp < stamp - before->first ? next->second : before->second;
}

Truth load_truth(const std::string& objects_csv) {
  Truth truth;
  truth.T_world_vehicle = Trajectory(kTruthLimits);
  const CsvTable ego(ego_csv_beside(objects_csv));
  for (std::size_t row = 0; row < ego.num_rows(); ++row)
    truth.T_world_vehicle.add({stamp_of(ego, row), pose_of(ego, row)});

  const CsvTable boxes(objects_csv);
  std::map<std::string, std::size_t> place;
  for (std::size_t row = 0; row < boxes.num_rows(); ++row) {
    const std::string& id = boxes.text(row, "id");
    const auto [found, is_new] = place.emplace(id, truth.objects.size());
    if (is_new) {
      truth.objects.push_back(
          {id,
           boxes.text(row, "class"),
           {boxes.number(row, "length"), boxes.number(row, "width"), boxes.number(row, "height")},
           Trajectory(kTruthLimits),
           {}});
    }
    TrueObject& object = truth.objects[found->second];
    object.T_world_object.add({stamp_of(boxes, row), pose_of(boxes, row)});
    object.moving[stamp_of(boxes, row)] = boxes.integer(row, "moving") != 0;
  }
  return truth;
}

std::optional<Pose> true_ego_motion(const Truth& truth, const LidarScan& key, Stamp stamp) {
  const auto k = lidar_in_world(truth, key, key.stamp), t = lidar_in_world(truth, key, stamp);
  if (!k || !t) return std::nullopt;
  return t->inverse() * *k;
}

std::optional<Pose> true_object_motion(const Truth& truth, const TrueObject& object,
                                       const LidarScan& key, Stamp stamp) {
  const auto k = box_in_scan(truth, object, key);
  const auto at_t = object.T_world_object.at(stamp);
  const auto lidar_t = lidar_in_world(truth, key, stamp);
  if (!k || !at_t || !lidar_t) return std::nullopt;
  return lidar_t->inverse() * at_t->T_world_vehicle * *k;
}

LidarScan brought_to(const Truth& truth, const LidarScan& scan, Stamp stamp) {
  LidarScan moved = scan;
  const auto T_ego = true_ego_motion(truth, scan, stamp);
  if (!T_ego || stamp == scan.stamp) return moved;
  moved.stamp = stamp;
  for (auto& point : moved.points) point = (*T_ego * point.cast<double>()).cast<float>();
  for (const TrueObject& object : truth.objects) {
    const auto T_box_lidar = box_in_scan(truth, object, scan);
    const auto T_object = true_object_motion(truth, object, scan, stamp);
    if (!T_box_lidar || !T_object) continue;
    for (std::size_t i = 0; i < scan.size(); ++i) {
      const Eigen::Vector3d point = scan.points[i].cast<double>();
      if (((*T_box_lidar * point).array().abs() < 0.5 * object.size.array()).all())
        moved.points[i] = (*T_object * point).cast<float>();
    }
  }
  return moved;
}

std::optional<Pose> box_in_scan(const Truth& truth, const TrueObject& object,
                                const LidarScan& key) {
  const auto box = object.T_world_object.at(key.stamp);
  const auto lidar = lidar_in_world(truth, key, key.stamp);
  if (!box || !lidar) return std::nullopt;
  return box->T_world_vehicle.inverse() * *lidar;
}

}  // namespace lidar_upsampling
