// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "argoverse_layout.h"

#include <cmath>
#include <cstring>
#include <fstream>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "argoverse2rawlog/beams.h"

namespace fs = std::filesystem;

namespace lidar_upsampling {
namespace {

std::string nanoseconds(Stamp stamp) {
  constexpr std::int64_t unix_epoch = 116'444'736'000'000'000;
  return std::to_string((stamp.time_since_epoch().count() - unix_epoch) * 100);
}

nlohmann::json wxyz(const Pose& T) {
  const Eigen::Quaterniond q(T.linear());
  return {q.w(), q.x(), q.y(), q.z()};
}

nlohmann::json xyz(const Pose& T) {
  const Eigen::Vector3d& t = T.translation();
  return {t.x(), t.y(), t.z()};
}

nlohmann::json sensor_pose(const Pose& T) {
  return {{"rotation", {{"coefficients", wxyz(T)}}}, {"translation", xyz(T)}};
}

void write_calibration(const fs::path& folder, const ArgoverseLog& log) {
  const Camera& camera = log.street.camera.camera;
  // The lens's distortion, which the pictures have no more.
  const nlohmann::json value = {{"focal_length_x_px_", camera.model.fx},
                                {"focal_length_y_px_", camera.model.fy},
                                {"focal_center_x_px_", camera.model.cx},
                                {"focal_center_y_px_", camera.model.cy},
                                {"skew_", 0},
                                {"distortion_coefficients_", {-0.17, 0.12, -0.03}},
                                {"vehicle_SE3_camera_", sensor_pose(camera.T_vehicle_camera)}};
  const nlohmann::json front = {{"key", "image_raw_ring_front_center"}, {"value", value}};
  const nlohmann::json all = {{"camera_data_", {front}},
                              {"vehicle_SE3_up_lidar_", sensor_pose(log.T_vehicle_up)},
                              {"vehicle_SE3_down_lidar_", sensor_pose(log.T_vehicle_down)}};
  std::ofstream(folder / "vehicle_calibration_info.json") << all;
}

void add_points(const ArgoverseLog& log, Stamp stamp, bool up, ArgoverseLog::Sweep& sweep) {
  sim::LidarSpec spec = log.street.lidar;
  spec.elevations.clear();
  for (int laser = argoverse::kLasersPerLidar - 1; laser >= 0; --laser) {
    spec.elevations.push_back(argoverse::laser_elevation(laser));
  }
  spec.T_vehicle_lidar = up ? log.T_vehicle_up : log.T_vehicle_down;
  const LidarScan scan = sim::scan_at(log.street.world, spec, stamp, up ? 6 : 7).scan;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    sweep.points.emplace_back(
        (spec.T_vehicle_lidar * scan.points[i].cast<double>()).cast<float>().cast<double>());
    const int laser = argoverse::kLasersPerLidar - 1 - scan.ring[i];
    sweep.beam.push_back(laser + (up ? 0 : argoverse::kLasersPerLidar));
    sweep.intensity.push_back(static_cast<int>(255 * scan.intensity[i]));
  }
}

void write_header(std::ostream& out, const char* format, std::size_t size) {
  out << "ply\nformat " << format << " 1.0\nelement vertex " << size
      << "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar intensity\n"
      << "property ushort laser_number\nend_header\n";
}

void write_sweep(const fs::path& file, const ArgoverseLog::Sweep& sweep, bool binary) {
  std::ofstream out(file, std::ios::binary);
  write_header(out, binary ? "binary_little_endian" : "ascii", sweep.points.size());
  out << std::setprecision(9);
  for (std::size_t i = 0; i < sweep.points.size(); ++i) {
    const Eigen::Vector3f p = sweep.points[i].cast<float>();
    const auto intensity = static_cast<std::uint8_t>(sweep.intensity[i]);
    const auto laser = static_cast<std::uint16_t>(sweep.beam[i] % argoverse::kLasersPerLidar);
    if (binary) {
      out.write(reinterpret_cast<const char*>(p.data()), 12);
      out.write(reinterpret_cast<const char*>(&intensity), 1);
      out.write(reinterpret_cast<const char*>(&laser), 2);
    } else {
      out << p.x() << ' ' << p.y() << ' ' << p.z() << ' ' << int{intensity} << ' ' << laser << '\n';
    }
  }
}

void write_pose(const fs::path& folder, const ArgoverseLog& log, Stamp stamp) {
  const Pose T = log.T_city_world * log.street.T_world_vehicle(stamp);
  std::ofstream(folder / ("city_SE3_egovehicle_" + nanoseconds(stamp) + ".json"))
      << nlohmann::json{{"rotation", wxyz(T)}, {"translation", xyz(T)}};
}

void write_labels(const fs::path& folder, const ArgoverseLog& log, Stamp stamp) {
  nlohmann::json labels = nlohmann::json::array();
  for (const int id : log.street.ids()) {
    const Pose T =
        log.street.T_world_vehicle(stamp).inverse() * log.street.T_world_object(id, stamp);
    const Eigen::Quaterniond q(T.linear());
    const Eigen::Vector3d& center = T.translation();
    const Eigen::Vector3d size = log.street.size_of(id);
    std::string name = log.street.world.objects[static_cast<std::size_t>(id)].class_name;
    for (char& c : name) c = static_cast<char>(std::toupper(c));
    labels.push_back({{"center", {{"x", center.x()}, {"y", center.y()}, {"z", center.z()}}},
                      {"rotation", {{"x", q.x()}, {"y", q.y()}, {"z", q.z()}, {"w", q.w()}}},
                      {"length", size.x()},
                      {"width", size.y()},
                      {"height", size.z()},
                      {"track_label_uuid", "0000-" + std::to_string(id)},
                      {"label_class", name},
                      {"timestamp", std::stoll(nanoseconds(stamp))}});
  }
  std::ofstream(folder / ("tracked_object_labels_" + nanoseconds(stamp) + ".json")) << labels;
}

}  // namespace

ArgoverseLog::ArgoverseLog(const fs::path& folder) {
  T_vehicle_up = Eigen::Translation3d(1.35, 0, 1.64) *
                 Eigen::AngleAxisd(0.03, Eigen::Vector3d(0.1, 0.1, 1).normalized());
  // Upside down: half a turn about an axis that is nearly the forward one.
  T_vehicle_down = Eigen::Translation3d(1.352, 0.002, 1.55) *
                   Eigen::AngleAxisd(M_PI, Eigen::Vector3d(0.994, 0.107, 0).normalized());
  T_city_world =
      Eigen::Translation3d(1200, -800, 20) * Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ());
  street.camera.camera.label = "ring_front_center";
  for (const char* const name :
       {"lidar", "poses", "ring_front_center", "per_sweep_annotations_amodal"}) {
    fs::create_directories(folder / name);
  }
  write_calibration(folder, *this);
  for (int i = 0; i < kNumFrames; ++i) {
    const Stamp stamp = frame_stamp(i);
    Sweep& sweep = sweeps.emplace_back();
    add_points(*this, stamp, false, sweep);
    add_points(*this, stamp, true, sweep);
    write_sweep(folder / "lidar" / ("PC_" + nanoseconds(stamp) + ".ply"), sweep, i != 1);
    write_pose(folder / "poses", *this, stamp);
    write_labels(folder / "per_sweep_annotations_amodal", *this, stamp);
  }
  for (int i = 0; i < 3 * (kNumFrames - 1); ++i) {
    const Stamp stamp = shifted(frame_stamp(0), 0.004 + i / 30.);
    pictures.push_back(stamp);
    cv::imwrite(
        (folder / "ring_front_center" / ("ring_front_center_" + nanoseconds(stamp) + ".jpg"))
            .string(),
        street.picture(stamp).image.bgr);
    write_pose(folder / "poses", *this, stamp);
  }
}

double mounted_elevation(int beam) {
  const double own = argoverse::laser_elevation(beam % argoverse::kLasersPerLidar);
  return beam < argoverse::kLasersPerLidar ? own : -own;
}

}  // namespace lidar_upsampling
