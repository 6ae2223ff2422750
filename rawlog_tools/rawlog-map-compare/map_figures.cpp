// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "map_figures.h"

#include <algorithm>

#include "known_scans.h"
#include "lidar_upsampling/virtual_label.h"

namespace lidar_upsampling::maps {
namespace {

// Noise and mirrors stand out of the boxes; the road below them does not belong to the object.
constexpr double kMargin_m = 0.2, kAboveRoad_m = 0.15;

FilledBox filled_box(const Pose& T_world_box, const Eigen::Vector3d& size) {
  Eigen::Vector3d half = 0.5 * size + Eigen::Vector3d(kMargin_m, kMargin_m, 0);
  half.z() += 0.5 * (kMargin_m - kAboveRoad_m);
  const Eigen::Vector3d raised(0, 0, 0.5 * (kMargin_m + kAboveRoad_m));
  return {(T_world_box * Eigen::Translation3d(raised)).inverse(), half};
}

std::vector<FilledBox> boxes_at(const Truth& truth, Stamp stamp) {
  std::vector<FilledBox> boxes;
  for (const TrueObject& object : truth.objects) {
    if (object.moving.empty() || !object.moves_at(stamp)) continue;
    if (const auto box = object.T_world_object.at(stamp))
      boxes.push_back(filled_box(box->T_world_vehicle, object.size));
  }
  return boxes;
}

std::vector<FilledBox> boxes_of_all_times(const Truth& truth) {
  std::vector<FilledBox> boxes;
  for (const TrueObject& object : truth.objects)
    for (const auto& [stamp, moves] : object.moving) {
      if (!moves) continue;
      if (const auto box = object.T_world_object.at(stamp))
        boxes.push_back(filled_box(box->T_world_vehicle, object.size));
    }
  return boxes;
}

bool any_holds(const std::vector<FilledBox>& boxes, const Eigen::Vector3d& point) {
  return std::any_of(boxes.begin(), boxes.end(),
                     [&](const FilledBox& box) { return box.holds(point); });
}

template <typename Use>
void for_each_point(const LidarScan& scan, const Trajectory& T_world_vehicle, double max_range_m,
                    const Use& use) {
  const auto vehicle = T_world_vehicle.at(scan.stamp);
  if (!vehicle) return;
  const Pose T_world_lidar = vehicle->T_world_vehicle * scan.T_vehicle_lidar;
  for (const Eigen::Vector3f& point : scan.points)
    if (point.norm() < max_range_m) use(T_world_lidar * point.cast<double>());
}

}  // namespace

bool FilledBox::holds(const Eigen::Vector3d& point_in_world) const {
  return ((T_box_world * point_in_world).array().abs() < half_size.array()).all();
}

Reference make_reference(const LogFile& log, const std::optional<Truth>& truth,
                         const MapOptions& options) {
  Reference reference{truth ? truth->T_world_vehicle : trajectory_of(log),
                      VoxelSet(options.voxel_m),
                      truth ? boxes_of_all_times(*truth) : std::vector<FilledBox>(),
                      {}};
  reference.warnings = for_each_scan(log, [&](const LidarScan& scan) {
    const auto moving = truth ? boxes_at(*truth, scan.stamp) : std::vector<FilledBox>();
    for_each_point(scan, reference.T_world_vehicle, options.max_range_m,
                   [&](const Eigen::Vector3d& point) {
                     if (!any_holds(moving, point)) reference.at_rest.insert(point);
                   });
  });
  return reference;
}

MapFigures compare_map(const LogFile& log, const Reference& reference, const MapOptions& options) {
  MapFigures figures;
  VoxelSet map(options.voxel_m);
  figures.warnings = for_each_scan(log, [&](const LidarScan& scan) {
    ++(is_virtual_label(scan.label) ? figures.num_virtual : figures.num_real);
    for_each_point(scan, reference.T_world_vehicle, options.max_range_m,
                   [&](const Eigen::Vector3d& point) { map.insert(point); });
  });
  figures.num_voxels = map.size();
  std::size_t num_seen = 0;
  map.for_each_center([&](const Eigen::Vector3d& center) {
    if (reference.at_rest.contains(center))
      ++num_seen;
    else if (!reference.at_rest.has_near(center))
      ++(any_holds(reference.swept, center) ? figures.num_ghosts : figures.num_others);
  });
  figures.coverage = static_cast<double>(num_seen) /
                     static_cast<double>(std::max<std::size_t>(1, reference.at_rest.size()));
  return figures;
}

}  // namespace lidar_upsampling::maps
