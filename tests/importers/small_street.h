// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "simulator/camera.h"
#include "simulator/lidar.h"

namespace lidar_upsampling {

constexpr int kNumFrames = 4;

/// Scans at 10 Hz of a street with a car ahead, an oncoming and a turning one, two at the kerb, and
/// the camera's view of it. The vehicle sways, so that roll and pitch matter.
struct SmallStreet {
  SmallStreet();

  sim::World world;
  sim::LidarSpec lidar;
  sim::CameraSpec camera;

  [[nodiscard]] Pose T_world_vehicle(Stamp stamp) const;
  /// Of the middle of an object's box.
  [[nodiscard]] Pose T_world_object(int id, Stamp stamp) const;
  [[nodiscard]] Eigen::Vector3d size_of(int id) const;
  /// Of the traffic participants.
  [[nodiscard]] std::vector<int> ids() const;
  [[nodiscard]] LidarScan scan(Stamp stamp) const;
  /// Made once.
  [[nodiscard]] const sim::RenderedImage& picture(Stamp stamp) const;

 private:
  mutable std::map<Stamp, sim::RenderedImage> pictures_;
};

/// Of frame i, 0.5 s after the simulation's start so that the sway is under way.
[[nodiscard]] Stamp frame_stamp(int frame);

/// Seconds with nine decimals, from the stamp's ticks.
[[nodiscard]] std::string seconds_text(Stamp stamp, Stamp from);

/// "000042" and the like.
[[nodiscard]] std::string padded(int number, int digits);

/// The rows of a truth table, by stamp (ticks) and id (-1 where there is none): column to value.
using TruthRows = std::map<std::pair<long long, int>, std::map<std::string, std::string>>;
[[nodiscard]] TruthRows read_truth_table(const std::string& path);

/// The pose in a row of a truth table.
[[nodiscard]] Pose pose_in(const std::map<std::string, std::string>& row);

/// Checks boxes against the rendered pictures: what is seen of an object lies in its box, which is
/// not much larger where nothing hides it.
void expect_boxes_fit(const std::string& boxes_csv, const SmallStreet& street,
                      const std::vector<Stamp>& rendered, const std::vector<Stamp>& logged,
                      const std::string& label, const std::map<int, int>& track_of_object);

/// Checks the objects table at a frame: poses by `T_log_world`, sizes, velocities, who moves.
void expect_objects_true(const TruthRows& rows, const SmallStreet& street, Stamp stamp,
                         Stamp logged, const Pose& T_log_world,
                         const std::map<int, int>& track_of_object);

}  // namespace lidar_upsampling
