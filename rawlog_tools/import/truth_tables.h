// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <ostream>
#include <vector>

#include "import/object_tracks.h"

namespace lidar_upsampling::importing {

/// @brief `stamp,id,class,x,y,z,yaw,pitch,roll,length,width,height,vx,vy,vz,yaw_rate,moving`, in
/// the order of the stamps: world frame, the box's centre, radians, stamps in MRPT's ticks. What
/// rawlog-simulate writes and rawlog-evaluate reads.
void write_objects_table(std::ostream& out, const std::vector<ObjectTrack>& tracks);

/// `stamp,x,y,z,yaw,pitch,roll` of the vehicle in the world.
void write_ego_table(std::ostream& out, const std::vector<PoseSample>& samples);

}  // namespace lidar_upsampling::importing
