// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "simulator/scenario.h"

#include <mrpt/config/CConfigFile.h>

#include <filesystem>
#include <limits>
#include <stdexcept>

#include "simulator/section_reader.h"

namespace lidar_upsampling::sim {

namespace {

constexpr double kRadian = M_PI / 180;

void read_scenario(SectionReader section, Scenario& scenario) {
  section.text("name", scenario.name);
  section.number("duration_s", scenario.duration_s, 0, 3600);
  section.count("seed", scenario.seed);
  section.finish();
}

void read_motion(SectionReader& section, MotionProfile& motion) {
  section.number("x_m", motion.x);
  section.number("y_m", motion.y);
  section.number("yaw_deg", motion.yaw, -360, 360, kRadian);
  section.number("speed_mps", motion.speed, 0, 100);
  std::string phases;
  if (section.text("motion", phases)) motion.phases = parse_phases(phases);
}

void read_ego(SectionReader section, EgoSpec& ego) {
  read_motion(section, ego.motion);
  section.number("pitch_sway_deg", ego.pitch_sway, 0, 10, kRadian);
  section.number("roll_sway_deg", ego.roll_sway, 0, 10, kRadian);
  section.number("heave_m", ego.heave, 0, 0.5);
  section.finish();
}

// "position_m = x y z" and "orientation_deg = yaw pitch roll", of an x-forward sensor on the
// vehicle.
void read_mounting(SectionReader& section, Pose& T_vehicle_sensor) {
  std::vector<double> values;
  if (section.numbers("position_m", values, 3)) {
    T_vehicle_sensor.translation() << values[0], values[1], values[2];
  }
  if (section.numbers("orientation_deg", values, 3)) {
    T_vehicle_sensor.linear() = (Eigen::AngleAxisd(values[0] * kRadian, Eigen::Vector3d::UnitZ()) *
                                 Eigen::AngleAxisd(values[1] * kRadian, Eigen::Vector3d::UnitY()) *
                                 Eigen::AngleAxisd(values[2] * kRadian, Eigen::Vector3d::UnitX()))
                                    .toRotationMatrix();
  }
}

void read_beams(SectionReader& section, LidarSpec& lidar) {
  unsigned rings = 64;
  double up_deg = 2, down_deg = -24.8;
  section.count("rings", rings, 1, 512);
  const bool given = section.number("fov_up_deg", up_deg, -90, 90);
  const bool given_too = section.number("fov_down_deg", down_deg, -90, up_deg);
  std::vector<double> list;
  if (section.numbers("elevations_deg", list, rings)) {
    for (const double degrees : list) lidar.elevations.push_back(degrees * kRadian);
    std::sort(lidar.elevations.begin(), lidar.elevations.end());
  } else if (rings == 64 && !given && !given_too) {
    lidar.elevations = hdl64_elevations();
  } else {
    for (unsigned i = 0; i < rings; ++i) {
      const double share = rings > 1 ? static_cast<double>(i) / (rings - 1) : 0;
      lidar.elevations.push_back((down_deg + share * (up_deg - down_deg)) * kRadian);
    }
  }
}

void read_lidar(SectionReader section, LidarSpec& lidar) {
  lidar.T_vehicle_lidar.translation().z() = 1.73;
  section.text("label", lidar.label);
  read_beams(section, lidar);
  unsigned columns = lidar.columns;
  section.count("columns", columns, 8, 65535);
  lidar.columns = static_cast<int>(columns);
  section.number("rate_hz", lidar.rate_hz, 0.01, 1000);
  section.number("phase_s", lidar.phase_s, 0, 100);
  section.number("noise_m", lidar.noise_m, 0, 1);
  section.number("dropout", lidar.dropout, 0, 1);
  section.number("min_range_m", lidar.min_range_m, 0, 100);
  section.number("max_range_m", lidar.max_range_m, lidar.min_range_m, 1000);
  read_mounting(section, lidar.T_vehicle_lidar);
  section.finish();
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

CameraSpec read_camera(SectionReader section, const std::string& label) {
  CameraSpec spec;
  spec.camera.label = label;
  section.text("label", spec.camera.label);
  read_lens(section, spec.camera.model);
  section.number("rate_hz", spec.rate_hz, 0.01, 1000);
  section.number("phase_s", spec.phase_s, 0, 100);
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

VehicleSpec read_vehicle(SectionReader section, const std::string& name) {
  VehicleSpec vehicle;
  vehicle.name = name;
  section.choice("type", vehicle.type, {"car", "van", "truck", "bus", "pedestrian"});
  read_motion(section, vehicle.motion);
  std::vector<double> rgb;
  if (section.numbers("color", rgb, 3)) {
    vehicle.color = Eigen::Vector3d(rgb[0], rgb[1], rgb[2]).cast<float>();
  }
  section.finish();
  return vehicle;
}

void read_street(SectionReader section, StreetSpec& street) {
  unsigned lanes = street.lanes_per_direction;
  section.count("lanes_per_direction", lanes, 1, 6);
  street.lanes_per_direction = static_cast<int>(lanes);
  section.number("lane_width_m", street.lane_width, 2, 6);
  section.number("crossing_x_m", street.crossing_x);
  bool crossing = true;
  section.flag("crossing", crossing);
  if (!crossing) street.crossing_x = std::numeric_limits<double>::quiet_NaN();
  section.number("parked_cars", street.parked_cars, 0, 1);
  section.number("trees", street.trees, 0, 1);
  section.number("poles", street.poles, 0, 1);
  section.number("buildings", street.buildings, 0, 1);
  section.number("pedestrians", street.pedestrians, 0, 1);
  section.finish();
}

void read_ego_poses(SectionReader section, EgoPoseSpec& poses) {
  std::string kind = "pose";
  section.choice("kind", kind, {"none", "pose", "odometry", "gnss"});
  poses.kind = kind == "none"       ? EgoPoseKind::none
               : kind == "odometry" ? EgoPoseKind::odometry
               : kind == "gnss"     ? EgoPoseKind::gnss
                                    : EgoPoseKind::pose;
  section.text("label", poses.label);
  section.number("rate_hz", poses.rate_hz, 0.01, 10000);
  section.number("latitude_deg", poses.latitude_deg, -89, 89);
  section.number("longitude_deg", poses.longitude_deg, -180, 180);
  section.finish();
}

void read_log(SectionReader section, Scenario& scenario) {
  std::string format = "observations";
  section.choice("format", format, {"observations", "sensory_frames"});
  scenario.format = format == "observations" ? LogFormat::observations : LogFormat::sensory_frames;
  section.choice("carrier", scenario.carrier, {"auto", "3drangescan", "pointcloud"});
  section.finish();
}

}  // namespace

Scenario scenario_from_config(const mrpt::config::CConfigFileBase& config) {
  Scenario scenario;
  read_scenario({config, "scenario"}, scenario);
  read_ego({config, "ego"}, scenario.ego);
  read_lidar({config, "lidar"}, scenario.lidar);
  read_street({config, "static"}, scenario.street);
  read_ego_poses({config, "ego_poses"}, scenario.ego_poses);
  read_log({config, "log"}, scenario);
  for (const std::string& name : named_sections(config, "camera.")) {
    scenario.cameras.push_back(read_camera({config, "camera." + name}, name));
  }
  if (scenario.cameras.empty()) {
    scenario.cameras.push_back(read_camera({config, "camera.CAM0"}, "CAM0"));
  }
  for (const std::string& name : named_sections(config, "vehicle.")) {
    scenario.vehicles.push_back(read_vehicle({config, "vehicle." + name}, name));
  }
  refuse_other_sections(
      config, {"scenario", "ego", "lidar", "static", "ego_poses", "log", "camera.", "vehicle."});
  return scenario;
}

Scenario load_scenario(const std::string& path) {
  if (!std::filesystem::is_regular_file(path)) {
    throw std::runtime_error("scenario " + path + ": there is no such file");
  }
  return scenario_from_config(mrpt::config::CConfigFile(path));
}

}  // namespace lidar_upsampling::sim
