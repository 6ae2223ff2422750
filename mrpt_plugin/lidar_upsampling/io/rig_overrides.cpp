// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/io/rig_overrides.h"

#include <mrpt/poses/CPose3D.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "lidar_upsampling/io/images.h"
#include "lidar_upsampling/text.h"
#include "lidar_upsampling/units.h"

namespace lidar_upsampling {
namespace {

using mrpt::config::CConfigFileBase;

// One key of one section, and how to complain about it.
struct Setting {
  std::string section;
  std::string key;
  std::string value;

  [[noreturn]] void fail(const std::string& expected) const {
    throw std::invalid_argument("[" + section + "] " + key + " = '" + value + "': " + expected);
  }

  [[nodiscard]] std::vector<double> numbers(std::size_t least, std::size_t most) const {
    std::istringstream in(value);
    std::vector<double> all;
    for (double number = 0; in >> number;) all.push_back(number);
    const bool finite =
        std::all_of(all.begin(), all.end(), [](double x) { return std::isfinite(x); });
    if (!in.eof() || !finite || all.size() < least || all.size() > most) {
      fail("expected " + std::to_string(least) +
           (most > least ? " to " + std::to_string(most) : std::string()) + " numbers");
    }
    return all;
  }

  [[nodiscard]] double number() const { return numbers(1, 1).front(); }

  [[nodiscard]] int size_px() const {
    const double size = number();
    if (size < 1 || size > 1e6 || size != std::floor(size)) fail("expected a number of pixels");
    return static_cast<int>(size);
  }

  [[nodiscard]] Pose pose() const {
    const std::vector<double> v = numbers(6, 6);
    return from_mrpt(
        mrpt::poses::CPose3D(v[0], v[1], v[2], v[3] * kDegree, v[4] * kDegree, v[5] * kDegree));
  }

  [[nodiscard]] DistortionModel distortion_model() const {
    if (value == "none") return DistortionModel::none;
    if (value == "plumb_bob") return DistortionModel::plumb_bob;
    if (value == "kannala_brandt") return DistortionModel::kannala_brandt;
    fail("choose none, plumb_bob or kannala_brandt");
  }

  [[nodiscard]] std::array<double, 8> distortion() const {
    const std::vector<double> given = numbers(4, 8);
    std::array<double, 8> all{};
    std::copy(given.begin(), given.end(), all.begin());
    return all;
  }
};

void set(const Setting& setting, CameraOverride& camera) {
  using Number = std::optional<double>;
  const std::map<std::string, Number*> numbers{
      {"fx_px", &camera.fx}, {"fy_px", &camera.fy}, {"cx_px", &camera.cx}, {"cy_px", &camera.cy}};
  if (const auto found = numbers.find(setting.key); found != numbers.end())
    *found->second = setting.number();
  else if (setting.key == "width_px")
    camera.width = setting.size_px();
  else if (setting.key == "height_px")
    camera.height = setting.size_px();
  else if (setting.key == "distortion_model")
    camera.distortion_model = setting.distortion_model();
  else if (setting.key == "distortion")
    camera.distortion = setting.distortion();
  else if (setting.key == "pose")
    camera.T_vehicle_camera = setting.pose();
  else
    setting.fail(
        "no such key; there are fx_px, fy_px, cx_px, cy_px, width_px, height_px, distortion_model, "
        "distortion, pose");
}

std::vector<Setting> settings_of(const CConfigFileBase& config, const std::string& section) {
  std::vector<std::string> keys;
  config.getAllKeys(section, keys);
  std::vector<Setting> settings;
  for (const std::string& key : keys) {
    const std::string value = config.read_string(section, key, "");
    // MRPT leaves comments in.
    settings.push_back({section, key, trimmed(value.substr(0, value.find(';')))});
  }
  return settings;
}

}  // namespace

RigOverrides load_rig_overrides(const CConfigFileBase& config) {
  const std::string camera_prefix = "camera.";
  const std::string lidar_prefix = "lidar.";
  std::vector<std::string> sections;
  config.getAllSections(sections);
  RigOverrides overrides;
  for (const std::string& section : sections) {
    if (section.rfind(camera_prefix, 0) == 0) {
      CameraOverride& camera = overrides.cameras[section.substr(camera_prefix.size())];
      for (const Setting& setting : settings_of(config, section)) set(setting, camera);
    } else if (section.rfind(lidar_prefix, 0) == 0) {
      for (const Setting& setting : settings_of(config, section)) {
        if (setting.key != "pose") setting.fail("no such key; there is only pose");
        overrides.T_vehicle_lidar[section.substr(lidar_prefix.size())] = setting.pose();
      }
    }
  }
  return overrides;
}

void apply(const RigOverrides& overrides, Camera& camera) {
  const auto it = overrides.cameras.find(camera.label);
  if (it == overrides.cameras.end()) return;
  const CameraOverride& given = it->second;
  CameraModel& model = camera.model;
  const int width = model.width;
  const int height = model.height;
  model.fx = given.fx.value_or(model.fx);
  model.fy = given.fy.value_or(model.fy);
  model.cx = given.cx.value_or(model.cx);
  model.cy = given.cy.value_or(model.cy);
  model.width = given.width.value_or(model.width);
  model.height = given.height.value_or(model.height);
  model.distortion_model = given.distortion_model.value_or(model.distortion_model);
  model.distortion = given.distortion.value_or(model.distortion);
  camera.T_vehicle_camera = given.T_vehicle_camera.value_or(camera.T_vehicle_camera);
  if (width > 0 && height > 0) model = scaled(model, width, height);
}

void apply(const RigOverrides& overrides, LidarScan& scan) {
  const auto it = overrides.T_vehicle_lidar.find(scan.label);
  if (it != overrides.T_vehicle_lidar.end()) scan.T_vehicle_lidar = it->second;
}

}  // namespace lidar_upsampling
