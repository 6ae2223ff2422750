// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "import/object_tracks.h"

namespace lidar_upsampling::importing {

/// @brief `stamp,id,class,x,y,z,yaw,pitch,roll,length,width,height,vx,vy,vz,yaw_rate,moving`, in
/// the order of the stamps: world frame, the box's centre, radians, stamps in MRPT's ticks. What
/// rawlog-simulate writes and rawlog-evaluate reads. Where the labels about a row are too few to
/// tell a velocity, its four cells are empty.
void write_objects_table(std::ostream& out, const std::vector<ObjectTrack>& tracks);

/// `stamp,x,y,z,yaw,pitch,roll` of the vehicle in the world.
void write_ego_table(std::ostream& out, const std::vector<PoseSample>& samples);

/// An area of a camera's picture with objects that nobody labelled.
struct IgnoredArea {
  Stamp stamp;         ///< of the scan that the labels are of
  std::string camera;  ///< its label in the log
  Box2d area;
};

/// `stamp,camera,left,top,right,bottom`, pixels.
void write_ignored_table(std::ostream& out, const std::vector<IgnoredArea>& areas);

}  // namespace lidar_upsampling::importing
