// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/scene/object_scene.h"

#include <mrpt/img/color_maps.h>
#include <mrpt/opengl/CArrow.h>
#include <mrpt/opengl/CBox.h>
#include <mrpt/opengl/CGridPlaneXY.h>
#include <mrpt/opengl/CPointCloudColoured.h>
#include <mrpt/opengl/CText.h>
#include <mrpt/opengl/stock_objects.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "lidar_upsampling/io/images.h"
#include "lidar_upsampling/objects/sides.h"

namespace lidar_upsampling {
namespace {

constexpr double kMinSpeed_m_s = 1;  // slower, the velocity's direction is noise
constexpr std::size_t kMinPoints = 3;

using Points = std::vector<Eigen::Vector3f>;

// The virtual scan's points of each point of the key scan's.
std::vector<std::vector<int>> points_by_source(const VirtualScan& scan) {
  std::vector<std::vector<int>> by_source;
  for (std::size_t i = 0; i < scan.source_index.size(); ++i) {
    if (scan.source_index[i] < 0) continue;
    const auto source = static_cast<std::size_t>(scan.source_index[i]);
    if (source >= by_source.size()) by_source.resize(source + 1);
    by_source[source].push_back(static_cast<int>(i));
  }
  return by_source;
}

double yaw_of(const ObjectBox& box, const Points& points) {
  if (box.moving && box.velocity.head<2>().norm() > kMinSpeed_m_s)
    return std::atan2(box.velocity.y(), box.velocity.x());
  return yaw_of_sides(points);
}

void fit(ObjectBox& box, const Points& points) {
  const Eigen::Matrix3d R =
      Eigen::AngleAxisd(yaw_of(box, points), Eigen::Vector3d::UnitZ()).toRotationMatrix();
  Eigen::AlignedBox3d extent;
  for (const Eigen::Vector3f& point : points) extent.extend(R.transpose() * point.cast<double>());
  box.T_lidar_box.linear() = R;
  box.T_lidar_box.translation() = R * extent.center();
  box.size = extent.sizes();
}

/// By how much the box's middle goes faster than the object's centroid.
Eigen::Vector3d by_turn(const ObjectMotion& object, const ObjectBox& box) {
  const Eigen::Vector3d centroid = object.T_lidar_t_lidar_k * object.centroid_lidar_k;
  return object.yaw_rate * Eigen::Vector3d::UnitZ().cross(box.T_lidar_box.translation() - centroid);
}

using mrpt::img::TColor;
using mrpt::math::TPoint3D;
using mrpt::opengl::CSetOfObjects;

constexpr double kArrow_s = 0.5;
const TColor kStanding(190, 190, 200);

TColor color_of(const ObjectBox& box) {
  if (!box.moving) return kStanding;
  // The golden angle keeps neighbouring ids apart.
  const float hue = static_cast<float>((box.track_id * 67) % 180) / 180.F;
  float r = 0, g = 0, b = 0;
  mrpt::img::hsv2rgb(hue, 0.8F, 0.9F, r, g, b);
  return {static_cast<std::uint8_t>(255 * r), static_cast<std::uint8_t>(255 * g),
          static_cast<std::uint8_t>(255 * b)};
}

std::string caption(const ObjectBox& box) {
  std::ostringstream text;
  text << box.class_name << (box.class_name.empty() ? "#" : " #") << box.track_id;
  if (box.moving)
    text << ' ' << std::fixed << std::setprecision(1) << box.velocity.norm() << " m/s";
  return text.str();
}

void draw_arrow(const ObjectBox& box, const TColor& color, CSetOfObjects& lidar_frame) {
  const Eigen::Vector3d from = box.T_lidar_box.translation();
  const Eigen::Vector3d to = from + kArrow_s * box.velocity;
  if ((to - from).norm() < 0.05) return;
  auto arrow = mrpt::opengl::CArrow::Create();
  arrow->setArrowEnds(from, to);
  arrow->setSmallRadius(0.06F);
  arrow->setLargeRadius(0.18F);
  arrow->setColor_u8(color);
  lidar_frame.insert(arrow);
}

TColor color_of_point(const LidarScan& scan, std::size_t i) {
  constexpr double kLowest_m = -2, kHighest_m = 4;
  const double share = scan.intensity.empty()
                           ? (scan.points[i].z() - kLowest_m) / (kHighest_m - kLowest_m)
                           : static_cast<double>(scan.intensity[i]);
  // The viewers' background is a darker gray.
  const auto gray = static_cast<std::uint8_t>(std::lround(130 + 125 * std::clamp(share, 0., 1.)));
  return {gray, gray, gray};
}

}  // namespace

std::vector<ObjectBox> object_boxes(const VirtualScan& scan) {
  const auto by_source = points_by_source(scan);
  std::vector<ObjectBox> boxes;
  for (const ObjectMotion& object : scan.objects) {
    Points points;
    for (const int source : object.points)
      if (static_cast<std::size_t>(source) < by_source.size())
        for (const int i : by_source[source]) points.push_back(scan.scan.points[i]);
    if (points.size() < kMinPoints) continue;
    ObjectBox box;
    box.track_id = object.track_id;
    box.class_name = object.class_name;
    box.moving = moves(object);
    if (box.moving) box.velocity = scan.T_lidar_t_lidar_k.linear() * object.velocity_lidar_k;
    fit(box, points);
    if (box.moving) box.velocity += by_turn(object, box);
    boxes.push_back(std::move(box));
  }
  return boxes;
}

bool contains(const ObjectBox& box, const Eigen::Vector3d& point_lidar, double margin) {
  const Eigen::Vector3d in_box = box.T_lidar_box.inverse() * point_lidar;
  return (in_box.cwiseAbs().array() <= box.size.array() / 2 + margin).all();
}

void draw_boxes(const std::vector<ObjectBox>& boxes, CSetOfObjects& lidar_frame) {
  for (const ObjectBox& box : boxes) {
    const TColor color = color_of(box);
    const Eigen::Vector3d half = box.size / 2;
    auto frame = mrpt::opengl::CBox::Create(TPoint3D(-half.x(), -half.y(), -half.z()),
                                            TPoint3D(half.x(), half.y(), half.z()));
    frame->setWireframe(true);
    frame->setLineWidth(box.moving ? 3.F : 1.F);
    frame->setPose(to_mrpt(box.T_lidar_box));
    frame->setColor_u8(color);
    frame->setBoxBorderColor(color);
    frame->setName(caption(box));
    lidar_frame.insert(frame);
    if (box.moving) draw_arrow(box, color, lidar_frame);
    auto text = mrpt::opengl::CText::Create(caption(box));
    const Eigen::Vector3d top =
        box.T_lidar_box.translation() + Eigen::Vector3d(0, 0, half.z() + 0.2);
    text->setLocation(top.x(), top.y(), top.z());
    text->setColor_u8(color);
    lidar_frame.insert(text);
  }
}

void draw_points(const LidarScan& scan, const std::vector<ObjectBox>& boxes, DrawnPoints which,
                 CSetOfObjects& lidar_frame) {
  auto cloud = mrpt::opengl::CPointCloudColoured::Create();
  cloud->setPointSize(2.F);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const Eigen::Vector3f& point = scan.points[i];
    const auto box = std::find_if(boxes.begin(), boxes.end(), [&](const ObjectBox& b) {
      return contains(b, point.cast<double>());
    });
    if (box == boxes.end() && which == DrawnPoints::in_boxes) continue;
    const bool is_moving = box != boxes.end() && box->moving;
    const TColor color = is_moving ? color_of(*box) : color_of_point(scan, i);
    cloud->push_back(point.x(), point.y(), point.z(), static_cast<float>(color.R) / 255.F,
                     static_cast<float>(color.G) / 255.F, static_cast<float>(color.B) / 255.F);
  }
  lidar_frame.insert(cloud);
}

compat::Scene::Ptr scene_around_vehicle(const CSetOfObjects::Ptr& lidar_frame,
                                        const Pose& T_vehicle_lidar) {
  auto scene = compat::Scene::Create();
  auto grid = mrpt::opengl::CGridPlaneXY::Create(-20.F, 80.F, -40.F, 40.F, 0.F, 10.F);
  grid->setColor_u8(TColor(90, 90, 90));
  scene->insert(grid);
  scene->insert(mrpt::opengl::stock_objects::CornerXYZSimple(1.F, 2.F));
  lidar_frame->setPose(to_mrpt(T_vehicle_lidar));
  scene->insert(lidar_frame);
  return scene;
}

mrpt::obs::CObservation3DScene::Ptr observation_of_objects(const VirtualScan& scan,
                                                           const std::string& label) {
  const std::vector<ObjectBox> boxes = object_boxes(scan);
  auto lidar_frame = CSetOfObjects::Create();
  draw_points(scan.scan, boxes, DrawnPoints::in_boxes, *lidar_frame);
  draw_boxes(boxes, *lidar_frame);
  auto observation = mrpt::obs::CObservation3DScene::Create();
  observation->timestamp = scan.scan.stamp;
  observation->sensorLabel = label;
  observation->scene = scene_around_vehicle(lidar_frame, scan.scan.T_vehicle_lidar);
  return observation;
}

}  // namespace lidar_upsampling
