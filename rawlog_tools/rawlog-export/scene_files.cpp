// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "scene_files.h"

#include <mrpt/opengl/CSetOfLines.h>

#include "lidar_upsampling/io/images.h"
#include "lidar_upsampling/io/rawlog_stream.h"
#include "lidar_upsampling/scene/object_scene.h"

namespace lidar_upsampling::exporting {
namespace {

using mrpt::opengl::CSetOfObjects;

void save(const std::string& path, const CSetOfObjects::Ptr& lidar_frame, const Pose& T) {
  RawlogWriter file(path, true);  // SceneViewer3D's files are a packed object, too
  file.write(*scene_around_vehicle(lidar_frame, T));
  file.commit();
}

const ObjectBox* box_of(int track, const ObjectsAt& objects) {
  for (const ObjectBox& box : objects.boxes)
    if (box.track_id == track) return &box;
  return nullptr;
}

}  // namespace

void write_scene(const std::string& path, const LidarScan& scan, const ObjectsAt& objects) {
  auto lidar_frame = CSetOfObjects::Create();
  draw_points(scan, objects.boxes, DrawnPoints::all, *lidar_frame);
  draw_boxes(objects.boxes, *lidar_frame);
  save(path, lidar_frame, scan.T_vehicle_lidar);
}

void write_trail(const std::string& path, int track, const std::map<Stamp, ObjectsAt>& objects,
                 const LidarScan& scan) {
  auto at_rest = CSetOfObjects::Create();
  auto line = mrpt::opengl::CSetOfLines::Create();
  line->setLineWidth(2.F);
  line->setColor_u8(mrpt::img::TColor(230, 120, 20));
  std::vector<Eigen::Vector3d> centers;
  for (const auto& [stamp, instant] : objects) {
    const ObjectBox* const box = box_of(track, instant);
    if (box == nullptr) continue;
    auto lidar_frame = CSetOfObjects::Create();
    draw_boxes({*box}, *lidar_frame);
    if (stamp == scan.stamp) draw_points(scan, {*box}, DrawnPoints::all, *lidar_frame);
    lidar_frame->setPose(to_mrpt(instant.T_rest_lidar));
    at_rest->insert(lidar_frame);
    centers.push_back(instant.T_rest_lidar * box->T_lidar_box.translation());
  }
  for (std::size_t i = 1; i < centers.size(); ++i)
    line->appendLine(centers[i - 1].x(), centers[i - 1].y(), centers[i - 1].z(), centers[i].x(),
                     centers[i].y(), centers[i].z());
  at_rest->insert(line);
  save(path, at_rest, scan.T_vehicle_lidar);
}

std::vector<Stamp> instants_of(int track, const std::map<Stamp, ObjectsAt>& objects) {
  std::vector<Stamp> stamps;
  for (const auto& [stamp, instant] : objects)
    if (box_of(track, instant) != nullptr) stamps.push_back(stamp);
  return stamps;
}

}  // namespace lidar_upsampling::exporting
