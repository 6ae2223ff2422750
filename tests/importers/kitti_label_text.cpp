// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <cctype>
#include <cmath>
#include <cstdio>

#include "kitti_layouts.h"

namespace lidar_upsampling {
namespace {

// Of one object; the format knows no roll and pitch, and the point at the bottom is below the
// middle along the camera's axis.
std::string label_row(const SmallStreet& street, int id, int track, int frame) {
  const Stamp stamp = frame_stamp(frame);
  const Pose T_world_lidar = street.T_world_vehicle(stamp) * street.lidar.T_vehicle_lidar;
  const Pose T =
      T_camera_0_lidar(street) * T_world_lidar.inverse() * street.T_world_object(id, stamp);
  const Eigen::Vector3d size = street.size_of(id), forward = T.linear().col(0);
  std::string type = street.world.objects[static_cast<std::size_t>(id)].class_name;
  type[0] = static_cast<char>(std::toupper(type[0]));
  char row[400];
  std::snprintf(row, sizeof row, "%d %d %s 0 0 -1.5 1 2 3 4 %.9f %.9f %.9f %.9f %.9f %.9f %.9f\n",
                frame, track, type.c_str(), size.z(), size.y(), size.x(), T.translation().x(),
                T.translation().y() + 0.5 * size.z(), T.translation().z(),
                std::atan2(-forward.z(), forward.x()));
  return row;
}

}  // namespace

std::string label_02_text(const SmallStreet& street) {
  const std::vector<int> ids = street.ids();
  std::string text;
  for (int i = 0; i < kNumFrames; ++i) {
    if (i % 2 == 0) {
      text += std::to_string(i) +
              " -1 DontCare -1 -1 -10 10.5 20 30 40.25 -1000 -1000 -1000 -10 -1 -1 -1\n";
    }
    for (std::size_t n = 0; n < ids.size(); ++n) {
      text += label_row(street, ids[n], kFirstLabelTrack + static_cast<int>(n), i);
    }
  }
  return text;
}

}  // namespace lidar_upsampling
