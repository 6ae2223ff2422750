// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "simulator/sensor_sections.h"

#include <algorithm>

#include "lidar_upsampling/units.h"

namespace lidar_upsampling::sim {

namespace {

// "position_m = x y z" and "orientation_deg = yaw pitch roll", of an x-forward sensor on the
// vehicle.
void read_mounting(SectionReader& section, Pose& T_vehicle_sensor) {
  std::vector<double> values;
  if (section.numbers("position_m", values, 3)) {
    T_vehicle_sensor.translation() << values[0], values[1], values[2];
  }
  if (section.numbers("orientation_deg", values, 3)) {
    T_vehicle_sensor.linear() = (Eigen::AngleAxisd(values[0] * kDegree, Eigen::Vector3d::UnitZ()) *
                                 Eigen::AngleAxisd(values[1] * kDegree, Eigen::Vector3d::UnitY()) *
                                 Eigen::AngleAxisd(values[2] * kDegree, Eigen::Vector3d::UnitX()))
                                    .toRotationMatrix();
  }
}

// Rows and columns of a depth picture in place of rings and steps.
CameraModel read_depth_camera(SectionReader& section) {
  unsigned width = 320, height = 240;
  section.count("width", width, 16, 2048);
  section.count("height", height, 16, 2048);
  CameraModel model;
  model.width = static_cast<int>(width);
  model.height = static_cast<int>(height);
  model.fx = 0.87 * width;
  model.cx = 0.5 * (width - 1.);
  model.cy = 0.5 * (height - 1.);
  section.number("fx", model.fx, 1, 1e5);
  model.fy = model.fx;
  section.number("fy", model.fy, 1, 1e5);
  section.number("cx", model.cx, 0, width);
  section.number("cy", model.cy, 0, height);
  return model;
}

void read_beams(SectionReader& section, LidarSpec& lidar) {
  unsigned rings = 64;
  double up_deg = 2, down_deg = -24.8;
  section.count("rings", rings, 1, 512);
  const bool given = section.number("fov_up_deg", up_deg, -90, 90);
  const bool given_too = section.number("fov_down_deg", down_deg, -90, up_deg);
  std::vector<double> list;
  if (section.numbers("elevations_deg", list, rings)) {
    for (const double degrees : list) lidar.elevations.push_back(degrees * kDegree);
    std::sort(lidar.elevations.begin(), lidar.elevations.end());
  } else if (rings == 64 && !given && !given_too) {
    lidar.elevations = hdl64_elevations();
  } else {
    for (unsigned i = 0; i < rings; ++i) {
      const double share = rings > 1 ? static_cast<double>(i) / (rings - 1) : 0;
      lidar.elevations.push_back((down_deg + share * (up_deg - down_deg)) * kDegree);
    }
  }
}

void read_lens(SectionReader& section, CameraModel& model) {
  unsigned width = 1242, height = 375;
  section.count("width", width, 16, 8192);
  section.count("height", height, 16, 8192);
  model.width = static_cast<int>(width);
  model.height = static_cast<int>(height);
  model.fx = 721.5377 * width / 1242;
  model.cx = 609.5593 * width / 1242;
  model.cy = 172.854 * height / 375;
  section.number("fx", model.fx, 1, 1e5);
  model.fy = model.fx;
  section.number("fy", model.fy, 1, 1e5);
  section.number("cx", model.cx, 0, width);
  section.number("cy", model.cy, 0, height);
  std::string kind;
  if (section.choice("distortion_model", kind, {"none", "plumb_bob", "kannala_brandt"})) {
    model.distortion_model = kind == "none"        ? DistortionModel::none
                             : kind == "plumb_bob" ? DistortionModel::plumb_bob
                                                   : DistortionModel::kannala_brandt;
  }
  std::vector<double> distortion;
  if (section.numbers("distortion", distortion, 8)) {
    std::copy(distortion.begin(), distortion.end(), model.distortion.begin());
  }
}

}  // namespace

void read_lidar(SectionReader section, LidarSpec& lidar) {
  lidar.T_vehicle_lidar.translation().z() = 1.73;
  section.text("label", lidar.label);
  std::string type = "spinning";
  section.choice("type", type, {"spinning", "depth_camera"});
  if (type == "depth_camera") {
    lidar.depth_camera = read_depth_camera(section);
    lidar.columns = lidar.depth_camera->width;
    lidar.max_range_m = 10;
    lidar.min_range_m = 0.3;
  } else {
    read_beams(section, lidar);
    unsigned columns = lidar.columns;
    section.count("columns", columns, 8, 65535);
    lidar.columns = static_cast<int>(columns);
    section.flag("sweep", lidar.sweep);
  }
  section.number("rate_hz", lidar.rate_hz, 0.01, 1000);
  section.number("phase_s", lidar.phase_s, 0, 100);
  section.number("noise_m", lidar.noise_m, 0, 1);
  section.number("noise_per_m2", lidar.noise_per_m2, 0, 0.1);
  section.number("dropout", lidar.dropout, 0, 1);
  section.number("min_range_m", lidar.min_range_m, 0, 100);
  // A depth picture's pixels are 16 bits of millimetres.
  const double farthest = lidar.depth_camera ? 65 : 1000;
  section.number("max_range_m", lidar.max_range_m, 0, farthest);
  if (lidar.min_range_m >= lidar.max_range_m)
    section.refuse("max_range_m", "is not above min_range_m");
  read_mounting(section, lidar.T_vehicle_lidar);
  section.finish();
}

CameraSpec read_camera(SectionReader section, const std::string& label) {
  CameraSpec spec;
  spec.camera.label = label;
  section.text("label", spec.camera.label);
  read_lens(section, spec.camera.model);
  section.number("rate_hz", spec.rate_hz, 0.01, 1000);
  section.number("phase_s", spec.phase_s, 0, 100);
  section.number("time_offset_ms", spec.time_offset_s, -1000, 1000, 1e-3);
  section.number("time_jitter_ms", spec.time_jitter_s, 0, 1000, 1e-3);
  section.number("calibration_error_deg", spec.calibration_error_rad, 0, 90, kDegree);
  section.number("calibration_error_m", spec.calibration_error_m, 0, 10);
  section.number("noise", spec.noise, 0, 50);
  std::vector<double> gain;
  section.numbers("gain", gain, 0);
  if (gain.size() % 2 != 0) section.refuse("gain", "needs pairs of time and factor");
  for (std::size_t i = 0; i < gain.size(); i += 2) spec.gain.emplace_back(gain[i], gain[i + 1]);
  Pose T_vehicle_mount = Pose::Identity();
  T_vehicle_mount.translation() << 0.27, 0.06, 1.65;
  read_mounting(section, T_vehicle_mount);
  section.finish();
  Eigen::Matrix3d R_mount_camera;  // camera +Z is the mount's +X, +X its -Y, +Y its -Z
  R_mount_camera << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  spec.camera.T_vehicle_camera = T_vehicle_mount;
  spec.camera.T_vehicle_camera.linear() = T_vehicle_mount.linear() * R_mount_camera;
  return spec;
}

}  // namespace lidar_upsampling::sim
