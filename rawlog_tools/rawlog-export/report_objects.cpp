// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "report_objects.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace lidar_upsampling::exporting {
namespace {

Eigen::Vector3d vector_of(const nlohmann::json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

Pose pose_of(const nlohmann::json& json) {
  const auto q = [&](int k) { return json.at(k).get<double>(); };
  Pose T = Pose::Identity();
  T.translation() = vector_of(json);
  T.linear() = Eigen::Quaterniond(q(6), q(3), q(4), q(5)).normalized().toRotationMatrix();
  return T;
}

ObjectBox box_of(const nlohmann::json& row) {
  const nlohmann::json& json = row.at("box");
  ObjectBox box;
  box.track_id = row.at("track").get<int>();
  box.class_name = row.at("class").get<std::string>();
  box.moving = row.at("moving").get<bool>();
  box.T_lidar_box = pose_of(json.at("pose"));
  box.size = vector_of(json.at("size_m"));
  box.velocity = vector_of(json.at("velocity_m_s"));
  return box;
}

}  // namespace

std::map<Stamp, ObjectsAt> read_report(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path + ": cannot read this report");
  std::map<Stamp, ObjectsAt> objects;
  try {
    const nlohmann::json report = nlohmann::json::parse(file);
    for (const nlohmann::json& row : report.at("objects")) {
      auto& instant = objects[Stamp(Stamp::duration(row.at("stamp").get<std::int64_t>()))];
      instant.T_rest_lidar = pose_of(row.at("T_rest_lidar"));
      if (row.contains("box")) instant.boxes.push_back(box_of(row));
    }
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(path + ": is no report of rawlog-densify --report: " + error.what());
  }
  return objects;
}

}  // namespace lidar_upsampling::exporting
