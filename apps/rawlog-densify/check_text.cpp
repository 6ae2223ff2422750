// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <cmath>
#include <sstream>

#include "check.h"
#include "lidar_upsampling/units.h"

namespace lidar_upsampling {
namespace {

std::string fixed(double value, int digits) {
  std::ostringstream text;
  text.setf(std::ios::fixed);
  text.precision(digits);
  text << value;
  return text.str();
}

std::string place_of(const Pose& T_vehicle_sensor) {
  const Eigen::Vector3d p = T_vehicle_sensor.translation();
  return "at " + fixed(p.x(), 2) + " " + fixed(p.y(), 2) + " " + fixed(p.z(), 2) +
         " m on the vehicle";
}

// Where a sensor looks, from the vehicle's forward axis to the left and up.
std::string direction_of(const Eigen::Vector3d& axis) {
  return "looking " + fixed(std::atan2(axis.y(), axis.x()) / kDegree, 1) + " deg to the left, " +
         fixed(std::asin(axis.z()) / kDegree, 1) + " deg up";
}

std::string lens_of(const CameraModel& m) {
  const char* model = m.distortion_model == DistortionModel::none        ? "no distortion"
                      : m.distortion_model == DistortionModel::plumb_bob ? "plumb bob distortion"
                                                                         : "Kannala-Brandt lens";
  return std::to_string(m.width) + " x " + std::to_string(m.height) + " px, f " + fixed(m.fx, 1) +
         " " + fixed(m.fy, 1) + ", centre " + fixed(m.cx, 1) + " " + fixed(m.cy, 1) + ", " + model;
}

std::string time_offset_of(const CameraCheck& camera, double in_force_ms) {
  if (!camera.time_offset)
    return "cannot be told: it takes a vehicle that drives, past poles, cars and corners, and some "
           "ten pictures of that";
  const TimeOffset& t = *camera.time_offset;
  const double ms = 1e3 * t.offset_s;
  if (t.sigma_s > TimeOffsetOptions().max_sigma_s)
    return "cannot be told well: " + fixed(ms, 1) + " ms, give or take " +
           fixed(1e3 * t.sigma_s, 1) + "; a faster drive tells more";
  return "pictures are taken " + fixed(std::abs(ms), 1) + " ms " + (ms < 0 ? "after" : "before") +
         " their stamps, give or take " + fixed(1e3 * t.sigma_s, 1) + " (" +
         std::to_string(t.num_pictures) + " pictures): " +
         (offset_to_set_ms(camera, in_force_ms) ? "camera_time_offset_ms = " + fixed(ms, 1)
                                                : "no other than the one in force");
}

}  // namespace

std::string to_text(const LogCheck& check) {
  std::ostringstream text;
  text << "log           " << check.index.path << ", " << check.index.num_objects << " entries"
       << (check.index.has_frames ? " with sensory frames" : "") << '\n';
  if (check.index.corruption) text << "broken        " << *check.index.corruption << '\n';
  for (const auto& count : check.unused) text << "not used      " << to_text(count) << '\n';
  std::istringstream streams(describe(check.index));
  for (std::string line; std::getline(streams, line);) text << "stream        " << line << '\n';
  text << "ego-motion    " << check.ego_source
       << (check.ego_source == "camera" ? ": the log holds none; here, by registration of scans"
                                        : "")
       << '\n'
       << "lidar         " << check.lidar_label << ' ' << place_of(check.T_vehicle_lidar) << ", "
       << direction_of(check.T_vehicle_lidar.linear().col(0)) << '\n'
       << "scan          " << fixed(check.mean_points, 0) << " points, "
       << (check.num_rings > 0 ? std::to_string(check.num_rings) : std::string("unknown"))
       << " rings, times of points " << (check.has_point_times ? "known" : "not known")
       << (check.has_point_times && !check.uses_point_times ? ", not used" : "") << '\n';
  for (const CameraCheck& camera : check.cameras) {
    const std::string& label = camera.camera.label;
    text << "camera        " << label << ' ' << place_of(camera.camera.T_vehicle_camera) << ", "
         << direction_of(camera.camera.T_vehicle_camera.linear().col(2)) << '\n'
         << "lens          " << label << ' ' << lens_of(camera.camera.model) << '\n'
         << "in view       " << label << " sees " << fixed(100 * camera.share_in_view, 1)
         << " % of a scan's points (" << camera.num_compared << " pictures beside scans)\n"
         << "time offset   " << label << ' '
         << time_offset_of(camera, check.time_offset_in_force_ms)
         << " (in force: " << fixed(check.time_offset_in_force_ms, 1) << ")\n";
    if (!camera.overlay.empty()) text << "overlay       " << camera.overlay << '\n';
  }
  text << "verdict       " << verdict_of(check) << '\n';
  return text.str();
}

}  // namespace lidar_upsampling
