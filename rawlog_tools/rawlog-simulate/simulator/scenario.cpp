// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "simulator/scenario.h"

#include <mrpt/config/CConfigFile.h>

#include <filesystem>
#include <limits>
#include <stdexcept>

#include "lidar_upsampling/units.h"
#include "simulator/section_reader.h"
#include "simulator/sensor_sections.h"

namespace lidar_upsampling::sim {

namespace {

void read_scenario(SectionReader section, Scenario& scenario) {
  section.text("name", scenario.name);
  section.number("duration_s", scenario.duration_s, 0, 3600);
  section.count("seed", scenario.seed);
  section.finish();
}

void read_motion(SectionReader& section, MotionProfile& motion) {
  section.number("x_m", motion.x);
  section.number("y_m", motion.y);
  section.number("yaw_deg", motion.yaw, -360, 360, kDegree);
  section.number("speed_mps", motion.speed, 0, 100);
  std::string phases;
  if (section.text("motion", phases)) motion.phases = parse_phases(phases);
}

void read_ego(SectionReader section, EgoSpec& ego) {
  read_motion(section, ego.motion);
  section.number("pitch_sway_deg", ego.pitch_sway, 0, 10, kDegree);
  section.number("roll_sway_deg", ego.roll_sway, 0, 10, kDegree);
  section.number("heave_m", ego.heave, 0, 0.5);
  section.finish();
}

VehicleSpec read_vehicle(SectionReader section, const std::string& name) {
  VehicleSpec vehicle;
  vehicle.name = name;
  section.choice("type", vehicle.type, {"car", "van", "truck", "bus", "pedestrian", "cyclist"});
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

void read_appearance(SectionReader section, AppearanceSpec& appearance) {
  section.number("sun", appearance.sun, 0, 4);
  section.number("sky", appearance.sky, 0, 4);
  section.number("grain", appearance.grain, 0, 2);
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
  section.number("noise_m", poses.noise_m, 0, 100);
  section.number("noise_deg", poses.noise_rad, 0, 90, kDegree);
  section.number("lag_ms", poses.lag_s, -1000, 1000, 1e-3);
  if (poses.noise_m > 0 && (kind == "none" || kind == "odometry"))
    section.refuse("noise_m", "is for kind = pose or gnss");
  if (poses.noise_rad > 0 && kind != "pose") section.refuse("noise_deg", "is for kind = pose");
  section.finish();
}

void read_variation(SectionReader section, VariationSpec& variation) {
  section.number("speed_share", variation.speed_share, 0, 0.9);
  section.number("ego_speed_share", variation.ego_speed_share, 0, 0.9);
  section.number("place_m", variation.place_m, 0, 100);
  section.number("across_m", variation.across_m, 0, 10);
  section.number("type_share", variation.type_share, 0, 1);
  section.number("light_share", variation.light_share, 0, 1);
  section.number("noise_share", variation.noise_share, 0, 1);
  section.number("street_share", variation.street_share, 0, 1);
  section.flag("colors", variation.colors);
  section.finish();
}

void read_log(SectionReader section, Scenario& scenario) {
  std::string format = "observations";
  section.choice("format", format, {"observations", "sensory_frames"});
  scenario.format = format == "observations" ? LogFormat::observations : LogFormat::sensory_frames;
  section.choice("carrier", scenario.carrier, {"auto", "3drangescan", "pointcloud", "velodyne"});
  if (scenario.lidar.depth_camera &&
      (scenario.carrier == "pointcloud" || scenario.carrier == "velodyne")) {
    section.refuse("carrier",
                   "is \"" + scenario.carrier + "\"; a depth camera's pictures are 3drangescan");
  }
  section.finish();
}

}  // namespace

Scenario scenario_from_config(const mrpt::config::CConfigFileBase& config) {
  Scenario scenario;
  read_scenario({config, "scenario"}, scenario);
  read_ego({config, "ego"}, scenario.ego);
  read_lidar({config, "lidar"}, scenario.lidar);
  read_street({config, "static"}, scenario.street);
  read_appearance({config, "appearance"}, scenario.appearance);
  read_ego_poses({config, "ego_poses"}, scenario.ego_poses);
  read_variation({config, "variation"}, scenario.variation);
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
  refuse_other_sections(config, {"scenario", "ego", "lidar", "static", "appearance", "ego_poses",
                                 "variation", "log", "camera.", "vehicle."});
  return scenario;
}

Scenario load_scenario(const std::string& path) {
  if (!std::filesystem::is_regular_file(path)) {
    throw std::runtime_error("scenario " + path + ": there is no such file");
  }
  return scenario_from_config(mrpt::config::CConfigFile(path));
}

}  // namespace lidar_upsampling::sim
