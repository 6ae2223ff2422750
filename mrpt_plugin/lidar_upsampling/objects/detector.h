// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "lidar_upsampling/objects/scene_segments.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// @brief Finds object candidates on an image, whether they move or not.
class Detector {
 public:
  Detector() = default;
  Detector(const Detector&) = delete;
  Detector& operator=(const Detector&) = delete;
  virtual ~Detector() = default;
  virtual std::vector<Detection> detect(const CameraImage& image) = 0;
};

/// Road users by the size of their visible points; an object seen from behind is short.
struct ClusterDetectorOptions {
  int min_points = 10;
  double min_range = 1, max_range = 120;    ///< m, horizontal, of the centroid
  double min_height = 0.5, max_height = 4;  ///< m, of the highest point above the ground
  double max_bottom = 1;  ///< m, of the lowest point above the ground, where nothing hides that
  double min_length = 0.3, max_length = kLongestVehicle_m;  ///< m, the longer side of the footprint
  double max_width = kWidestVehicle_m;                      ///< m, the shorter side
};

/// Any Darknet or ONNX model of the YOLO families (v2-v5, v8, FastestDet) that cv::dnn reads.
struct NetworkDetectorOptions {
  std::string model;    ///< .weights or .onnx
  std::string config;   ///< .cfg, for Darknet
  std::string classes;  ///< file with one class name per line, in the network's order
  std::vector<std::string> wanted = {"car", "truck", "bus", "motorbike", "bicycle", "person"};
  double min_confidence = 0.35;
  double max_overlap = 0.45;  ///< IoU above which the weaker of two boxes goes
  int input_width = 0;        ///< px; 0: what the .cfg says, 640 for ONNX
  int input_height = 0;
};

struct CsvDetectorOptions {
  std::string path;
  double stamp_tolerance_ms = 5;
};

struct DetectorOptions {
  enum class Type { clusters, network, csv };
  Type type = Type::clusters;
  ClusterDetectorOptions clusters;
  NetworkDetectorOptions network;
  CsvDetectorOptions csv;
};

/// @return null for clusters, which no picture is asked for (road_users.h).
/// @throw std::runtime_error, std::invalid_argument a missing or unreadable file, a bad setting.
[[nodiscard]] std::unique_ptr<Detector> make_detector(const DetectorOptions& options);

/// @brief Boxes from a file: `label,stamp,class,score,left,top,right,bottom[,track]`, any order of
/// rows, an optional header; `label` is the image's sensor label. Given out are those at the stamp
/// nearest to the image's own, none outside the tolerance.
/// @throw std::runtime_error no such file, or a bad row, with its line number.
[[nodiscard]] std::unique_ptr<Detector> make_csv_detector(const CsvDetectorOptions& options);

/// @brief Boxes of the wanted classes by a network through cv::dnn, on the processor. Loads the
/// model and runs it once, so that a wrong file or setting shows at start.
/// @throw std::runtime_error a missing or unreadable file, an output of no known layout.
/// @throw std::invalid_argument a setting out of range, a wanted class the network does not know.
[[nodiscard]] std::unique_ptr<Detector> make_network_detector(
    const NetworkDetectorOptions& options);

}  // namespace lidar_upsampling
