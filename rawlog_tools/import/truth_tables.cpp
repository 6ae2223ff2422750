// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "import/truth_tables.h"

#include <algorithm>
#include <iomanip>
#include <tuple>

#include "lidar_upsampling/io/images.h"

namespace lidar_upsampling::importing {
namespace {

struct Row {
  Stamp stamp;
  const ObjectTrack* track;
  std::size_t index;
};

std::vector<Row> rows_in_time_order(const std::vector<ObjectTrack>& tracks) {
  std::vector<Row> rows;
  for (const ObjectTrack& track : tracks) {
    for (std::size_t i = 0; i < track.poses.size(); ++i) {
      rows.push_back({track.poses[i].stamp, &track, i});
    }
  }
  std::sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) {
    return std::tie(a.stamp, a.track->id) < std::tie(b.stamp, b.track->id);
  });
  return rows;
}

void write_pose(std::ostream& out, const Pose& T) {
  const mrpt::poses::CPose3D pose = to_mrpt(T);
  out << pose.x() << ',' << pose.y() << ',' << pose.z() << ',' << pose.yaw() << ',' << pose.pitch()
      << ',' << pose.roll();
}

void write_velocity(std::ostream& out, const std::optional<ObjectVelocity>& velocity) {
  if (!velocity) {
    out << ",,,,";
    return;
  }
  const Eigen::Vector3d& v = velocity->linear;
  out << ',' << v.x() << ',' << v.y() << ',' << v.z() << ',' << velocity->yaw_rate;
}

}  // namespace

void write_objects_table(std::ostream& out, const std::vector<ObjectTrack>& tracks) {
  out << "stamp,id,class,x,y,z,yaw,pitch,roll,length,width,height,vx,vy,vz,yaw_rate,moving\n"
      << std::fixed << std::setprecision(6);
  const LabelWindow window = label_window_of(tracks);
  for (const Row& row : rows_in_time_order(tracks)) {
    const ObjectTrack& track = *row.track;
    out << row.stamp.time_since_epoch().count() << ',' << track.id << ',' << track.class_name
        << ',';
    write_pose(out, track.poses[row.index].T_world_object);
    for (const double value : {track.size.x(), track.size.y(), track.size.z()}) out << ',' << value;
    write_velocity(out, velocity_at(track, row.index, window));
    out << ',' << (moves_at(track, row.index, window) ? 1 : 0) << '\n';
  }
}

void write_ego_table(std::ostream& out, const std::vector<PoseSample>& samples) {
  out << "stamp,x,y,z,yaw,pitch,roll\n" << std::fixed << std::setprecision(9);
  for (const PoseSample& sample : samples) {
    out << sample.stamp.time_since_epoch().count() << ',';
    write_pose(out, sample.T_world_vehicle);
    out << '\n';
  }
}

void write_ignored_table(std::ostream& out, const std::vector<IgnoredArea>& areas) {
  out << "stamp,camera,left,top,right,bottom\n" << std::fixed << std::setprecision(2);
  for (const auto& [stamp, camera, area] : areas) {
    out << stamp.time_since_epoch().count() << ',' << camera << ',' << area.left << ',' << area.top
        << ',' << area.right << ',' << area.bottom << '\n';
  }
}

}  // namespace lidar_upsampling::importing
