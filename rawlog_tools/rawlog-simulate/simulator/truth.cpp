// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "simulator/truth.h"

#include <cmath>
#include <iomanip>
#include <map>

#include "simulator/scene.h"

namespace lidar_upsampling::sim {

namespace {

/// What the picture shows of one object.
struct Visible {
  cv::Rect extent;
  int num_pixels = 0;
};

std::map<int, Visible> visible_objects(const cv::Mat& object) {
  std::map<int, Visible> found;
  for (int v = 0; v < object.rows; ++v) {
    const int* row = object.ptr<int>(v);
    for (int u = 0; u < object.cols; ++u) {
      if (row[u] < 0) continue;
      Visible& seen = found[row[u]];
      seen.extent |= cv::Rect(u, v, 1, 1);
      ++seen.num_pixels;
    }
  }
  return found;
}

// Counts, on a grid of pixels, how many show the object and how many would if it stood alone.
double hidden_share(const CameraRenderer& renderer, const cv::Mat& object, const View& view,
                    const Pose& T_world_camera, const Eigen::AngleAxisd& cone, int id, int step) {
  const Eigen::Vector3d axis_in_camera = T_world_camera.linear().transpose() * cone.axis();
  const auto candidates = view.candidates({}, id);
  const double cosine = std::cos(cone.angle());
  int num_alone = 0, num_seen = 0;
  for (int v = step / 2; v < object.rows; v += step) {
    for (int u = step / 2; u < object.cols; u += step) {
      const Eigen::Vector2d ray =
          0.5 * (renderer.corner_ray(u, v) + renderer.corner_ray(u + 1, v + 1));
      const Eigen::Vector3d direction = ray.homogeneous().normalized();
      if (direction.dot(axis_in_camera) < cosine) continue;
      if (!view.cast(T_world_camera.linear() * direction, candidates).any()) continue;
      ++num_alone;
      num_seen += object.at<int>(v, u) == id ? 1 : 0;
    }
  }
  return num_alone == 0 ? 0 : 1 - static_cast<double>(num_seen) / num_alone;
}

// Direction and angular radius of a vehicle from a point.
Eigen::AngleAxisd cone_about(const Object& object, const Pose& T_world_object,
                             const Eigen::Vector3d& from) {
  const VehicleShape& s = object.shape;
  const Eigen::Vector3d to = T_world_object * Eigen::Vector3d(0, 0, 0.5 * s.height) - from;
  const double radius = 0.5 * Eigen::Vector3d(s.length, s.width, s.height).norm() + 0.3;
  const double distance = to.norm();
  return {distance > radius ? std::asin(radius / distance) : M_PI, to / distance};
}

/// Yaw, pitch, roll of a rotation, as in mrpt::poses::CPose3D.
Eigen::Vector3d angles_of(const Eigen::Matrix3d& R) {
  return {std::atan2(R(1, 0), R(0, 0)), std::atan2(-R(2, 0), std::hypot(R(0, 0), R(1, 0))),
          std::atan2(R(2, 1), R(2, 2))};
}

}  // namespace

std::vector<TrueBox> true_boxes(const World& world, const CameraRenderer& renderer,
                                const RenderedImage& picture, double most_hidden,
                                int fewest_pixels) {
  const double t = picture.taken_at;
  const Scene scene = scene_at(world, t);
  const Pose T_world_camera = world.T_world_vehicle(t) * renderer.spec().camera.T_vehicle_camera;
  const View view(scene, T_world_camera.translation());
  std::vector<TrueBox> boxes;
  for (const auto& [id, seen] : visible_objects(picture.object)) {
    const Object& object = world.objects[id];
    if (object.class_name.empty() || seen.num_pixels < fewest_pixels) continue;
    const int step = std::clamp(static_cast<int>(std::sqrt(seen.num_pixels) / 25), 1, 8);
    const auto cone = cone_about(object, scene.T_world_object[id], T_world_camera.translation());
    const double hidden =
        hidden_share(renderer, picture.object, view, T_world_camera, cone, id, step);
    if (hidden > most_hidden) continue;
    const cv::Rect& r = seen.extent;
    boxes.push_back({id,
                     object.class_name,
                     {static_cast<double>(r.x), static_cast<double>(r.y),
                      static_cast<double>(r.br().x), static_cast<double>(r.br().y)},
                     hidden});
  }
  return boxes;
}

void write_objects_header(std::ostream& out) {
  out << "stamp,id,class,x,y,z,yaw,pitch,roll,length,width,height,vx,vy,vz,yaw_rate,moving\n";
}

void write_objects(std::ostream& out, const World& world, Stamp stamp) {
  const double t = time_of(stamp);
  out << std::fixed << std::setprecision(6);
  for (const Object& object : world.objects) {
    if (object.class_name.empty()) continue;
    const MotionState state = state_at(object.motion, t);
    const VehicleShape& s = object.shape;
    const Eigen::Vector3d v = state.velocity();
    const double yaw = std::remainder(state.yaw, 2 * M_PI);
    out << stamp.time_since_epoch().count() << ',' << object.id << ',' << object.class_name << ','
        << state.x << ',' << state.y << ',' << state.z + 0.5 * s.height << ',' << yaw << ",0,0,"
        << s.length << ',' << s.width << ',' << s.height << ',' << v.x() << ',' << v.y() << ','
        << v.z() << ',' << state.yaw_rate << ',' << (object.moves() ? 1 : 0) << '\n';
  }
}

void write_ego_header(std::ostream& out) { out << "stamp,x,y,z,yaw,pitch,roll\n"; }

void write_ego(std::ostream& out, const World& world, Stamp stamp) {
  const Pose T = world.T_world_vehicle(time_of(stamp));
  const Eigen::Vector3d p = T.translation(), angles = angles_of(T.linear());
  out << std::fixed << std::setprecision(9) << stamp.time_since_epoch().count() << ',' << p.x()
      << ',' << p.y() << ',' << p.z() << ',' << angles[0] << ',' << angles[1] << ',' << angles[2]
      << '\n';
}

void write_boxes_header(std::ostream& out) {
  out << "label,stamp,class,score,left,top,right,bottom,track\n";
}

void write_boxes(std::ostream& out, const CameraImage& image, const std::vector<TrueBox>& boxes) {
  out << std::defaultfloat;
  for (const TrueBox& b : boxes) {
    out << image.camera.label << ',' << image.stamp.time_since_epoch().count() << ','
        << b.class_name << ",1," << b.box.left << ',' << b.box.top << ',' << b.box.right << ','
        << b.box.bottom << ',' << b.object << '\n';
  }
}

}  // namespace lidar_upsampling::sim
