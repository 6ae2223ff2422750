// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "argoverse2rawlog/argoverse_calibration.h"

#include <cmath>
#include <stdexcept>

#include "import/json_file.h"

namespace lidar_upsampling::argoverse {
namespace {

const std::string kCameraPrefix = "image_raw_";

Camera camera_from(const std::string& name, const nlohmann::json& value) {
  Camera camera;
  camera.label = name;
  camera.model.fx = value.at("focal_length_x_px_").get<double>();
  camera.model.fy = value.at("focal_length_y_px_").get<double>();
  camera.model.cx = value.at("focal_center_x_px_").get<double>();
  camera.model.cy = value.at("focal_center_y_px_").get<double>();
  const double skew = value.value("skew_", 0.);
  if (std::abs(skew) > 1e-3) {
    throw std::invalid_argument("camera " + name + " has skew_ " + std::to_string(skew) +
                                ", which no camera model here knows");
  }
  camera.T_vehicle_camera = importing::pose_from_json(value.at("vehicle_SE3_camera_"));
  return camera;
}

}  // namespace

Calibration read_calibration(const std::string& path) {
  Calibration calibration;
  importing::with_json(path, [&](const nlohmann::json& json) {
    calibration.T_vehicle_up_lidar = importing::pose_from_json(json.at("vehicle_SE3_up_lidar_"));
    calibration.T_vehicle_down_lidar =
        importing::pose_from_json(json.at("vehicle_SE3_down_lidar_"));
    for (const nlohmann::json& camera : json.at("camera_data_")) {
      const auto key = camera.at("key").get<std::string>();
      if (key.rfind(kCameraPrefix, 0) != 0) continue;
      const std::string name = key.substr(kCameraPrefix.size());
      calibration.cameras[name] = camera_from(name, camera.at("value"));
    }
  });
  return calibration;
}

}  // namespace lidar_upsampling::argoverse
