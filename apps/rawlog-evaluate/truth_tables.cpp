// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <mrpt/poses/CPose3D.h>

#include <filesystem>
#include <stdexcept>

#include "lidar_upsampling/csv_table.h"
#include "lidar_upsampling/io/images.h"
#include "lidar_upsampling/metrics/label_velocity.h"
#include "truth.h"

namespace lidar_upsampling {

namespace {

// Labels come at 2 Hz or more; further apart, one is missing.
constexpr InterpolationLimits kTruthLimits{0.6, 0};
// Two labels of a track this far apart are of two objects: nothing on a road drives that fast.
constexpr double kJump_mps = 60, kJump_m = 3;
constexpr double kAboutJump_s = 0.35;      // as far as a velocity is fitted
constexpr double kSlowestMover_mps = 0.5;  // where the table does not tell who moves

Stamp stamp_of(const CsvTable& table, std::size_t row) {
  return Stamp(mrpt::Clock::duration(table.integer(row, "stamp")));
}

double number_or_zero(const CsvTable& table, std::size_t row, const char* column) {
  return table.has(column) ? table.number(row, column) : 0;
}

Pose pose_of(const CsvTable& table, std::size_t row) {
  const auto value = [&](const char* column) { return table.number(row, column); };
  return from_mrpt(mrpt::poses::CPose3D(value("x"), value("y"), value("z"), value("yaw"),
                                        number_or_zero(table, row, "pitch"),
                                        number_or_zero(table, row, "roll")));
}

std::string beside(const std::string& objects_csv, const std::string& what) {
  const std::string ending = "_objects.csv";
  const auto at = objects_csv.rfind(ending);
  if (at == std::string::npos || at + ending.size() != objects_csv.size())
    throw std::runtime_error(objects_csv + ": the name must end in " + ending +
                             ", as the ego-motion is looked for in ..._ego.csv beside it");
  return objects_csv.substr(0, at) + what;
}

TrueObject new_object(const CsvTable& boxes, std::size_t row) {
  TrueObject object{
      boxes.text(row, "id"),
      boxes.text(row, "class"),
      {boxes.number(row, "length"), boxes.number(row, "width"), boxes.number(row, "height")},
      Trajectory(kTruthLimits),
      {},
      {},
      {}};
  if (!(object.size.minCoeff() > 0))
    throw std::runtime_error(boxes.place(row, "length") + ": object " + object.id +
                             " has a box without extent");
  return object;
}

std::optional<Eigen::Vector3d> velocity_of(const CsvTable& boxes, std::size_t row) {
  if (boxes.text(row, "vx").empty()) return {};
  return Eigen::Vector3d(boxes.number(row, "vx"), boxes.number(row, "vy"), boxes.number(row, "vz"));
}

void fit_velocities(const std::vector<std::vector<LabelledPosition>>& tracks, Truth& truth) {
  std::vector<Stamp> stamps;
  for (const auto& track : tracks)
    for (const LabelledPosition& label : track) stamps.push_back(label.stamp);
  const LabelWindow window = label_window(std::move(stamps));
  for (std::size_t i = 0; i < tracks.size(); ++i)
    for (const LabelledPosition& label : tracks[i])
      if (const auto fitted = fit_velocity(tracks[i], label.stamp, window))
        truth.objects[i].velocity[label.stamp] = fitted->velocity;
}

/// A track whose label jumps to something else tells no velocity about the jump.
int drop_jumps(const std::vector<LabelledPosition>& track, TrueObject& object) {
  int jumps = 0;
  for (std::size_t i = 1; i < track.size(); ++i) {
    const double step = (track[i].position - track[i - 1].position).norm();
    const double dt = seconds_between(track[i - 1].stamp, track[i].stamp);
    if (step < kJump_m || step < kJump_mps * dt) continue;
    ++jumps;
    const auto about = [&](Stamp stamp) {
      return seconds_between(track[i - 1].stamp, stamp) > -kAboutJump_s &&
             seconds_between(stamp, track[i].stamp) > -kAboutJump_s;
    };
    for (auto known = object.velocity.begin(); known != object.velocity.end();)
      known = about(known->first) ? object.velocity.erase(known) : std::next(known);
  }
  return jumps;
}

void drop_jumps(const std::vector<std::vector<LabelledPosition>>& tracks, Truth& truth) {
  int jumps = 0, objects = 0;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const int of_object = drop_jumps(tracks[i], truth.objects[i]);
    jumps += of_object;
    objects += of_object > 0 ? 1 : 0;
  }
  if (jumps > 0)
    truth.warnings.push_back("labels of " + std::to_string(objects) + " objects jump " +
                             std::to_string(jumps) +
                             " times, faster than anything drives: no velocity is told there");
}

void read_objects(const CsvTable& boxes, Truth& truth) {
  std::map<std::string, std::size_t> place;
  std::vector<std::vector<LabelledPosition>> tracks;
  for (std::size_t row = 0; row < boxes.num_rows(); ++row) {
    const auto [found, is_new] = place.emplace(boxes.text(row, "id"), truth.objects.size());
    if (is_new) {
      truth.objects.push_back(new_object(boxes, row));
      tracks.emplace_back();
    }
    TrueObject& object = truth.objects[found->second];
    const Stamp stamp = stamp_of(boxes, row);
    const Pose T_world_object = pose_of(boxes, row);
    object.T_world_object.add({stamp, T_world_object});
    tracks[found->second].push_back({stamp, T_world_object.translation()});
    if (boxes.has("moving")) object.moving[stamp] = boxes.integer(row, "moving") != 0;
    if (!boxes.has("vx")) continue;
    if (const auto velocity = velocity_of(boxes, row)) object.velocity[stamp] = *velocity;
    if (boxes.has("yaw_rate") && !boxes.text(row, "yaw_rate").empty())
      object.yaw_rate[stamp] = boxes.number(row, "yaw_rate");
  }
  if (!boxes.has("vx")) fit_velocities(tracks, truth);
  drop_jumps(tracks, truth);
  if (boxes.has("moving")) return;
  for (TrueObject& object : truth.objects)
    for (const auto& [stamp, velocity] : object.velocity)
      object.moving[stamp] = velocity.norm() > kSlowestMover_mps;
}

void read_ignored(const std::string& path, Truth& truth) {
  if (!std::filesystem::exists(path)) return;
  const CsvTable areas(path);
  for (std::size_t row = 0; row < areas.num_rows(); ++row) {
    Box2d box;
    box.left = areas.number(row, "left");
    box.top = areas.number(row, "top");
    box.right = areas.number(row, "right");
    box.bottom = areas.number(row, "bottom");
    truth.ignored.emplace(stamp_of(areas, row), IgnoredArea{areas.text(row, "camera"), box});
  }
}

}  // namespace

std::vector<std::string> truth_tables(const std::string& objects_csv) {
  return {objects_csv, beside(objects_csv, "_ego.csv"), beside(objects_csv, "_ignored.csv")};
}

Truth load_truth(const std::string& objects_csv) {
  Truth truth;
  truth.T_world_vehicle = Trajectory(kTruthLimits);
  const CsvTable ego(beside(objects_csv, "_ego.csv"));
  for (std::size_t row = 0; row < ego.num_rows(); ++row)
    truth.T_world_vehicle.add({stamp_of(ego, row), pose_of(ego, row)});
  if (truth.T_world_vehicle.size() == 0)
    throw std::runtime_error(beside(objects_csv, "_ego.csv") +
                             ": holds no pose, and labels without the vehicle's poses are nowhere "
                             "in the world");
  read_objects(CsvTable(objects_csv), truth);
  if (truth.objects.empty()) throw std::runtime_error(objects_csv + ": holds no labelled object");
  read_ignored(beside(objects_csv, "_ignored.csv"), truth);
  return truth;
}

}  // namespace lidar_upsampling
