// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace lidar_upsampling {

/// A stage's times over a whole densification.
struct StageFigures {
  std::string name;
  int runs = 0;
  double median_ms = 0, p95_ms = 0, total_ms = 0;
};

/// An object that the densification followed.
struct TrackFigures {
  int id = 0;
  std::string class_name;
  int num_images = 0, num_moving = 0;     ///< at which it was met; of them, moved by its own motion
  double mean_speed = 0, last_speed = 0;  ///< m/s over ground, where it moved

  struct Sample {
    double time_s = 0;  ///< since the report's first object
    double speed = 0;
  };
  std::vector<Sample> speeds;  ///< where its motion is known; standing: 0
};

/// One object at one image.
struct ReportedObject {
  std::int64_t stamp = 0;  ///< MRPT ticks
  std::string status;
  int track = -1;                                        ///< -1: not tracked
  int points = 0;                                        ///< of the key scan
  bool moving = false;                                   ///< told to move
  bool in_view = true;                                   ///< on the picture of a camera
  Eigen::Vector3d position = Eigen::Vector3d::Zero();    ///< of its centroid, lidar frame, m
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();      ///< of its box, lidar frame, m
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();    ///< there, over ground, lidar frame, m/s
  double yaw_rate = 0;                                   ///< rad/s about its vertical axis
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of the centroid, m^2; zero: not known
  double sigma = 0;                                      ///< m, worst direction
};

/// What rawlog-densify --report wrote.
struct RunReport {
  std::string path;
  std::string ego_motion, detector, carrier;
  double camera_time_offset_ms = 0;  ///< the log was densified with
  int num_scans = 0, num_images = 0, num_virtual = 0, num_extrapolated = 0;
  double load = 0;  ///< of the machine at the end; 0: not known
  int cores = 0;
  std::vector<StageFigures> stages;
  std::map<std::string, int> object_status, warnings;
  std::vector<TrackFigures> tracks;  ///< by id
  std::vector<ReportedObject> objects, out_of_view;
};

/// @throw std::runtime_error the file cannot be read, or is no such report.
[[nodiscard]] RunReport load_run_report(const std::string& path);

/// Of a report's row.
[[nodiscard]] ReportedObject reported_object(const nlohmann::json& row, bool in_view = true);

}  // namespace lidar_upsampling
