// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "import/json_file.h"

#include <stdexcept>

#include "import/input_file.h"

namespace lidar_upsampling::importing {

void with_json(const std::string& path, const std::function<void(const nlohmann::json&)>& use) {
  std::ifstream in = open_file(path);
  if (!in) throw std::runtime_error("cannot read " + path);
  try {
    use(nlohmann::json::parse(in));
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(path + ": " + error.what());
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(path + ": " + error.what());
  }
}

Eigen::Matrix3d rotation_from(double w, double x, double y, double z) {
  const Eigen::Quaterniond q(w, x, y, z);
  if (!(std::abs(q.norm() - 1) < 0.1)) {
    throw std::invalid_argument("a rotation's quaternion has length " + std::to_string(q.norm()));
  }
  return q.normalized().toRotationMatrix();
}

Pose pose_from_json(const nlohmann::json& json) {
  const nlohmann::json& rotation = json.at("rotation");
  const nlohmann::json& q = rotation.is_array() ? rotation : rotation.at("coefficients");
  const nlohmann::json& t = json.at("translation");
  const auto number = [](const nlohmann::json& list, std::size_t i) {
    return list.at(i).get<double>();
  };
  Pose T = Pose::Identity();
  T.linear() = rotation_from(number(q, 0), number(q, 1), number(q, 2), number(q, 3));
  T.translation() = Eigen::Vector3d(number(t, 0), number(t, 1), number(t, 2));
  return T;
}

}  // namespace lidar_upsampling::importing
