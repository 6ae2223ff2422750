// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/obs/CObservation3DScene.h>
#include <mrpt/opengl/CSetOfObjects.h>

#include <string>
#include <vector>

#include "lidar_upsampling/compat/mrpt.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// A tracked object as it is shown: the upright box around its points.
struct ObjectBox {
  int track_id = -1;
  std::string class_name;
  bool moving = false;
  Pose T_lidar_box = Pose::Identity();                 ///< centre, +X along `size.x()`
  Eigen::Vector3d size = Eigen::Vector3d::Zero();      ///< m
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< of the centre, lidar frame, over
                                                       ///< ground, m/s
};

/// @brief The boxes of a virtual scan's objects at the image's instant: along the velocity of what
/// moves, else along its sides (`yaw_of_sides`). Objects without points left in the scan have none.
[[nodiscard]] std::vector<ObjectBox> object_boxes(const VirtualScan& scan);

/// Whether a point lies in the box or at most `margin` (m) outside.
[[nodiscard]] bool contains(const ObjectBox& box, const Eigen::Vector3d& point_lidar,
                            double margin = 0.05);

/// @brief Draws objects as wireframe boxes with class, track and speed; what moves has its track's
/// colour and an arrow as long as its way in half a second.
void draw_boxes(const std::vector<ObjectBox>& boxes, mrpt::opengl::CSetOfObjects& lidar_frame);

/// What of a scan is drawn.
enum class DrawnPoints { all, in_boxes };

/// @brief Draws a scan's points, gray by intensity (by height without); those in a moving box in
/// its colour.
void draw_points(const LidarScan& scan, const std::vector<ObjectBox>& boxes, DrawnPoints which,
                 mrpt::opengl::CSetOfObjects& lidar_frame);

/// @brief A scene in the vehicle frame, with a grid on the vehicle's ground and the vehicle's axes.
/// @param lidar_frame what lies in the LiDAR's frame.
[[nodiscard]] compat::Scene::Ptr scene_around_vehicle(
    const mrpt::opengl::CSetOfObjects::Ptr& lidar_frame, const Pose& T_vehicle_lidar);

/// @brief The objects of a virtual scan and their points as a stock observation, which
/// RawLogViewer shows; with the scan's stamp. MRPT 2.5.8 does not write this class's label.
[[nodiscard]] mrpt::obs::CObservation3DScene::Ptr observation_of_objects(const VirtualScan& scan,
                                                                         const std::string& label);

}  // namespace lidar_upsampling
