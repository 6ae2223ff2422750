// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "dgp2rawlog/dgp_calibration.h"

#include <cmath>
#include <stdexcept>

#include "import/json_file.h"

namespace lidar_upsampling::dgp {
namespace {

// Rectified pictures only: the layout's fields for lenses are of several models.
void check_is_pinhole(const std::string& name, const nlohmann::json& intrinsics) {
  for (const char* const field :
       {"skew", "k1", "k2", "k3", "k4", "k5", "k6", "p1", "p2", "s1", "s2", "s3", "s4"}) {
    const double value = intrinsics.value(field, 0.);
    if (std::abs(value) > 1e-6) {
      throw std::invalid_argument("camera " + name + " has " + field + " = " +
                                  std::to_string(value) +
                                  ": pictures must be rectified, without skew");
    }
  }
}

Sensor sensor_from(const std::string& name, const nlohmann::json& extrinsics,
                   const nlohmann::json& intrinsics) {
  check_is_pinhole(name, intrinsics);
  Sensor sensor;
  sensor.T_vehicle_sensor = pose_from(extrinsics);
  sensor.model.fx = intrinsics.at("fx").get<double>();
  sensor.model.fy = intrinsics.at("fy").get<double>();
  sensor.model.cx = intrinsics.at("cx").get<double>();
  sensor.model.cy = intrinsics.at("cy").get<double>();
  return sensor;
}

}  // namespace

Pose pose_from(const nlohmann::json& json) {
  const nlohmann::json &q = json.at("rotation"), &t = json.at("translation");
  const auto number = [](const nlohmann::json& object, const char* name) {
    return object.at(name).get<double>();
  };
  Pose T = Pose::Identity();
  T.linear() =
      importing::rotation_from(number(q, "qw"), number(q, "qx"), number(q, "qy"), number(q, "qz"));
  T.translation() = Eigen::Vector3d(number(t, "x"), number(t, "y"), number(t, "z"));
  return T;
}

Calibration read_calibration(const std::string& path) {
  Calibration calibration;
  importing::with_json(path, [&](const nlohmann::json& json) {
    const nlohmann::json& names = json.at("names");
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto name = names.at(i).get<std::string>();
      calibration[name] =
          sensor_from(name, json.at("extrinsics").at(i), json.at("intrinsics").at(i));
    }
  });
  return calibration;
}

}  // namespace lidar_upsampling::dgp
