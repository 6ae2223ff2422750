// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <ostream>

#include "simulator/camera.h"

namespace lidar_upsampling::sim {

/// The box on a picture about what is seen of a traffic participant.
struct TrueBox {
  int object = -1;  ///< place in World::objects
  std::string class_name;
  Box2d box;          ///< of the visible part, whole pixels
  double hidden = 0;  ///< share of it, within the picture, that lies behind others
};

/// Boxes of all that are at most `most_hidden` hidden and show at least `fewest_pixels`.
[[nodiscard]] std::vector<TrueBox> true_boxes(const World& world, const CameraRenderer& renderer,
                                              const RenderedImage& picture,
                                              double most_hidden = 0.8, int fewest_pixels = 60);

/// `stamp,id,class,x,y,z,yaw,pitch,roll,length,width,height,vx,vy,vz,yaw_rate,moving`: world frame,
/// the box's centre, radians, stamps in MRPT's ticks.
void write_objects_header(std::ostream& out);
void write_objects(std::ostream& out, const World& world, Stamp stamp);

/// `stamp,x,y,z,yaw,pitch,roll` of the vehicle in the world.
void write_ego_header(std::ostream& out);
void write_ego(std::ostream& out, const World& world, Stamp stamp);

/// `label,stamp,class,score,left,top,right,bottom,track`: what a perfect detector and tracker would
/// say.
void write_boxes_header(std::ostream& out);
void write_boxes(std::ostream& out, const CameraImage& image, const std::vector<TrueBox>& boxes);

}  // namespace lidar_upsampling::sim
