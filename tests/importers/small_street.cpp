// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "small_street.h"

#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/poses/CPose3D.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>

#include "lidar_upsampling/io/images.h"
#include "lidar_upsampling/objects/detector.h"
#include "simulator/truth.h"

namespace lidar_upsampling {
namespace {

constexpr const char* kStreet = R"(
[scenario]
duration_s = 2
seed = 5
[ego]
y_m = -5.1
speed_mps = 8
[camera.CAM2]
width = 248
height = 75
[lidar]
columns = 300
[static]
pedestrians = 0
[vehicle.lead]
x_m = 14
y_m = -5.1
speed_mps = 10
[vehicle.oncoming]
x_m = 34
y_m = 1.7
yaw_deg = 180
speed_mps = 9
[vehicle.turning]
x_m = 13
y_m = -1.7
speed_mps = 9
motion = 0 0 -8
)";

constexpr double kStart = 0.5;

double number(const std::map<std::string, std::string>& row, const std::string& column) {
  return std::stod(row.at(column));
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

double yaw_of(const Pose& T) { return std::atan2(T.linear()(1, 0), T.linear()(0, 0)); }

// Of its visible part, against the box about all of it.
void expect_box_about(const sim::TrueBox& seen, const std::vector<Detection>& boxes, int track,
                      int width) {
  const auto found = std::find_if(boxes.begin(), boxes.end(), [&](const Detection& box) {
    return box.external_track == track;
  });
  ASSERT_NE(found, boxes.end()) << "object " << seen.object;
  EXPECT_EQ(found->class_name, seen.class_name);
  const Box2d& box = found->box;
  EXPECT_LE(box.left, seen.box.left + 1) << "object " << seen.object;
  EXPECT_LE(box.top, seen.box.top + 1) << "object " << seen.object;
  EXPECT_GE(box.right, seen.box.right - 2) << "object " << seen.object;
  EXPECT_GE(box.bottom, seen.box.bottom - 2) << "object " << seen.object;
  // At the border there may be just a car's nose, far lower than its box.
  if (seen.hidden > 0.01 || seen.box.left <= 0 || seen.box.right >= width) return;
  EXPECT_LT(box.area(), 1.5 * seen.box.area() + 40) << "object " << seen.object;
}

}  // namespace

SmallStreet::SmallStreet() {
  const sim::Scenario scenario =
      sim::scenario_from_config(mrpt::config::CConfigFileMemory(std::string(kStreet)));
  world = sim::build_world(scenario);
  world.ego.pitch_sway = 0.01;
  world.ego.roll_sway = 0.02;
  world.ego.heave = 0.05;
  lidar = scenario.lidar;
  camera = scenario.cameras.at(0);
}

Pose SmallStreet::T_world_vehicle(Stamp stamp) const {
  return world.T_world_vehicle(sim::time_of(stamp));
}

Pose SmallStreet::T_world_object(int id, Stamp stamp) const {
  return world.T_world_object(id, sim::time_of(stamp)) *
         Eigen::Translation3d(0, 0, 0.5 * size_of(id).z());
}

Eigen::Vector3d SmallStreet::size_of(int id) const {
  const sim::VehicleShape& shape = world.objects[static_cast<std::size_t>(id)].shape;
  return {shape.length, shape.width, shape.height};
}

std::vector<int> SmallStreet::ids() const {
  std::vector<int> ids;
  for (const sim::Object& object : world.objects) {
    const bool near = std::abs(object.motion.x - 20) < 30;
    if (!object.class_name.empty() && (object.moves() || near)) ids.push_back(object.id);
  }
  return ids;
}

LidarScan SmallStreet::scan(Stamp stamp) const { return scan_at(world, lidar, stamp, 5).scan; }

const sim::RenderedImage& SmallStreet::picture(Stamp stamp) const {
  const auto [place, is_new] = pictures_.try_emplace(stamp);
  if (is_new) place->second = sim::CameraRenderer(camera).render(world, stamp, 5);
  return place->second;
}

Stamp frame_stamp(int frame) { return shifted(sim::start_stamp(), kStart + 0.1 * frame); }

std::string seconds_text(Stamp stamp, Stamp from) {
  const long long ticks = (stamp - from).count();
  char text[48];
  std::snprintf(text, sizeof text, "%02lld.%07lld00", ticks / 10'000'000, ticks % 10'000'000);
  return text;
}

std::string padded(int number, int digits) {
  char text[24];
  std::snprintf(text, sizeof text, "%0*d", digits, number);
  return text;
}

TruthRows read_truth_table(const std::string& path) {
  std::ifstream in(path);
  std::string line;
  std::getline(in, line);
  const auto names = cells_of(line);
  TruthRows rows;
  while (std::getline(in, line)) {
    const auto cells = cells_of(line);
    EXPECT_EQ(cells.size(), names.size()) << line;
    std::map<std::string, std::string> row;
    for (std::size_t i = 0; i < cells.size(); ++i) row[names[i]] = cells[i];
    const int id = row.count("id") > 0 ? std::stoi(row["id"]) : -1;
    rows[{std::stoll(row["stamp"]), id}] = row;
  }
  return rows;
}

Pose pose_in(const std::map<std::string, std::string>& row) {
  return from_mrpt(mrpt::poses::CPose3D(number(row, "x"), number(row, "y"), number(row, "z"),
                                        number(row, "yaw"), number(row, "pitch"),
                                        number(row, "roll")));
}

void expect_boxes_fit(const std::string& boxes_csv, const SmallStreet& street,
                      const std::vector<Stamp>& rendered, const std::vector<Stamp>& logged,
                      const std::string& label, const std::map<int, int>& track_of_object) {
  CsvDetectorOptions options;
  options.path = boxes_csv;
  options.stamp_tolerance_ms = 0.001;
  const auto detector = make_csv_detector(options);
  const sim::CameraRenderer renderer(street.camera);
  std::size_t num_checked = 0;
  for (std::size_t i = 0; i < rendered.size(); ++i) {
    CameraImage image;
    image.stamp = logged[i];
    image.camera.label = label;
    const std::vector<Detection> boxes = detector->detect(image);
    for (const Detection& box : boxes) {
      EXPECT_GE(box.box.left, 0);
      EXPECT_GE(box.box.top, 0);
      EXPECT_LE(box.box.right, street.camera.camera.model.width);
      EXPECT_LE(box.box.bottom, street.camera.camera.model.height);
    }
    for (const auto& seen :
         sim::true_boxes(street.world, renderer, street.picture(rendered[i]), 0.5)) {
      const auto track = track_of_object.find(seen.object);
      if (track == track_of_object.end()) continue;
      SCOPED_TRACE("picture " + std::to_string(i));
      expect_box_about(seen, boxes, track->second, street.camera.camera.model.width);
      ++num_checked;
    }
  }
  EXPECT_GE(num_checked, 2 * rendered.size());
}

void expect_objects_true(const TruthRows& rows, const SmallStreet& street, Stamp stamp,
                         Stamp logged, const Pose& T_log_world,
                         const std::map<int, int>& track_of_object) {
  for (const auto& [id, track] : track_of_object) {
    SCOPED_TRACE("object " + std::to_string(id));
    const auto found = rows.find({logged.time_since_epoch().count(), track});
    ASSERT_NE(found, rows.end());
    const auto& row = found->second;
    const Pose expected = T_log_world * street.T_world_object(id, stamp), pose = pose_in(row);
    EXPECT_LT((pose.translation() - expected.translation()).norm(), 5e-3);
    EXPECT_LT(std::abs(std::remainder(yaw_of(pose) - yaw_of(expected), 2 * M_PI)), 1e-3);
    const Eigen::Vector3d size(number(row, "length"), number(row, "width"), number(row, "height"));
    EXPECT_LT((size - street.size_of(id)).norm(), 1e-5);
    const sim::Object& object = street.world.objects[static_cast<std::size_t>(id)];
    EXPECT_EQ(row.at("class"), object.class_name);
    EXPECT_EQ(row.at("moving"), object.moves() ? "1" : "0");
    const sim::MotionState state = sim::state_at(object.motion, sim::time_of(stamp));
    const Eigen::Vector3d velocity(number(row, "vx"), number(row, "vy"), number(row, "vz"));
    // By straight lines, which at the log's ends are those of one who turned 0.15 s off.
    EXPECT_LT((velocity - T_log_world.linear() * state.velocity()).norm(), 0.2);
    EXPECT_NEAR(number(row, "yaw_rate"), state.yaw_rate, 0.01);
  }
}

}  // namespace lidar_upsampling
