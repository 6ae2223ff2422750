// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/config/CConfigFileBase.h>

#include <optional>

#include "lidar_upsampling/types.h"
#include "simulator/motion.h"

namespace lidar_upsampling::sim {

/// A vehicle (or pedestrian) with a motion of its own.
struct VehicleSpec {
  std::string name;
  std::string type = "car";  ///< car, van, truck, bus, pedestrian, cyclist
  MotionProfile motion;
  std::optional<Eigen::Vector3f> color;  ///< linear RGB, 0 to 1; none: by the seed
};

/// A straight street along +X of the world, its centre line on y = 0, traffic on the right.
struct StreetSpec {
  int lanes_per_direction = 2;
  double lane_width = 3.4;
  double crossing_x = 45;    ///< where a side street crosses; NaN: nowhere
  double parked_cars = 0.7;  ///< share of the parking places that are taken
  double trees = 0.7;        ///< share of the places for them, as below
  double poles = 1;
  double buildings = 1;
  double pedestrians = 0.3;
};

struct EgoSpec {
  MotionProfile motion;
  double pitch_sway = 0, roll_sway = 0;  ///< amplitudes in rad, of the body on its springs
  double heave = 0;                      ///< m
};

/// Light and surfaces, as factors on those of a clear day.
struct AppearanceSpec {
  double sun = 1;    ///< 0: no shadows either
  double sky = 1;    ///< what it lights, and how bright it is itself
  double grain = 1;  ///< contrast of the surfaces' fine irregular pattern; 0: plain paint
};

struct LidarSpec {
  std::string label = "LIDAR";
  std::vector<double> elevations;  ///< rad, of each ring, the lowest first
  int columns = 1900;
  /// A dense depth picture through a pinhole (+X forward) instead of turning beams: its lowest row
  /// is ring 0.
  std::optional<CameraModel> depth_camera;
  double rate_hz = 10, phase_s = 0;
  /// Turns while it measures, as real ones do, and tells each point's time; else all at the stamp.
  bool sweep = false;
  double noise_m = 0.02;    ///< sigma of the range
  double noise_per_m2 = 0;  ///< times the squared range, added to that sigma
  double dropout = 0.01;    ///< share of the returns that are missing by chance
  double min_range_m = 1, max_range_m = 120;
  Pose T_vehicle_lidar = Pose::Identity();

  [[nodiscard]] int num_rings() const {
    return depth_camera ? depth_camera->height : static_cast<int>(elevations.size());
  }
};

struct CameraSpec {
  Camera camera;
  double rate_hz = 30, phase_s = 0;
  double time_offset_s = 0;                     ///< a picture is taken this long before its stamp
  double time_jitter_s = 0;                     ///< sigma of the stamps about that
  double noise = 1.5;                           ///< sigma of the gray value
  std::vector<std::pair<double, double>> gain;  ///< (t, factor on the light), linear between
  /// How far the mounting that the log tells is from the true one; see told_mounting().
  double calibration_error_rad = 0, calibration_error_m = 0;
};

enum class EgoPoseKind { none, pose, odometry, gnss };

struct EgoPoseSpec {
  EgoPoseKind kind = EgoPoseKind::pose;
  std::string label = "POSE";
  double rate_hz = 100;
  double latitude_deg = 47.4979, longitude_deg = 19.0402;  ///< of the world's origin, for gnss
  double noise_m = 0;    ///< sigma along each axis, of pose and gnss; see told_ego_pose()
  double noise_rad = 0;  ///< sigma about each axis, of pose
  double lag_s = 0;      ///< what a stamp t says is of t - lag
};

/// How far a situation that is drawn (see variation.h) may be from the written one: uniformly, to
/// both sides. The section [variation], whose keys are these names.
struct VariationSpec {
  double speed_share = 0.15;     ///< of each speed; the way stays, and what stands stays standing
  double ego_speed_share = 0.1;  ///< of the ego's
  double place_m = 1;            ///< along the heading at the start
  double across_m = 0.2;         ///< across it
  double type_share = 0.3;       ///< of the cars become vans, and of the vans cars
  double light_share = 0.2;      ///< of sun and of sky
  double noise_share = 0.3;      ///< of the LiDAR's and of each camera's noise
  double street_share = 0.2;     ///< of the shares of parked cars, trees, poles, pedestrians
  bool colors = true;            ///< all are drawn, given ones too
};

enum class LogFormat { observations, sensory_frames };

struct Scenario {
  std::string name = "street";
  double duration_s = 3;
  std::uint32_t seed = 1;
  /// Nothing of the street's own traffic (parked cars, pedestrians) is in anybody's way until then.
  double cleared_s = 0;
  EgoSpec ego;
  LidarSpec lidar;
  std::vector<CameraSpec> cameras;
  std::vector<VehicleSpec> vehicles;
  StreetSpec street;
  AppearanceSpec appearance;
  EgoPoseSpec ego_poses;
  VariationSpec variation;
  LogFormat format = LogFormat::observations;
  std::string carrier = "auto";
};

/// @brief Reads a scenario; what is not given keeps its default, and without any [camera.*] there
/// is one, CAM0.
/// @throw std::invalid_argument naming section and key: unknown, or a value that cannot be.
[[nodiscard]] Scenario scenario_from_config(const mrpt::config::CConfigFileBase& config);
/// @throw std::runtime_error the file cannot be read.
[[nodiscard]] Scenario load_scenario(const std::string& path);

/// The elevations of the rings of a 64-beam spinning scanner with a dense upper and a sparse lower
/// block.
[[nodiscard]] std::vector<double> hdl64_elevations();

/// 2026-01-01 00:00 UTC: where the simulated time starts.
[[nodiscard]] Stamp start_stamp();
/// The stamp of event `index` of a stream, to the nearest tick, without accumulated error.
[[nodiscard]] Stamp stamp_of(int index, double rate_hz, double phase_s);
/// Seconds since the start.
[[nodiscard]] inline double time_of(Stamp stamp) { return seconds_between(start_stamp(), stamp); }
/// Every stamp of a stream within the scenario's duration, both ends included.
[[nodiscard]] std::vector<Stamp> stamps_of(double rate_hz, double phase_s, double duration_s);

}  // namespace lidar_upsampling::sim
