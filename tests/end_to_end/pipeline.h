// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <gtest/gtest.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/test_folder.h"
#include "lidar_upsampling/io/sensory_frame.h"
#include "lidar_upsampling/types.h"
#include "simulated_logs.h"
#include "tools/run_tool.h"

namespace lidar_upsampling {

/// A small rig's LiDAR.
inline constexpr const char* kSmallLidar = R"(
[lidar]
rings = 32
columns = 600
)";

/// A street seen by a small rig: a car ahead that drives off, an oncoming one, parked ones.
inline constexpr const char* kSmallStreet = R"(
[scenario]
duration_s = 0.4
seed = 3
[ego]
y_m = -5.1
speed_mps = 8
[camera.CAM0]
width = 414
height = 125
[static]
pedestrians = 0
[vehicle.lead]
x_m = 12
y_m = -5.1
speed_mps = 10
[vehicle.oncoming]
x_m = 25
y_m = 1.7
yaw_deg = 180
speed_mps = 9
)";

/// What densify() makes of it: 5 scans and 13 images, of which 5 are at a scan's instant.
inline constexpr int kVirtualScans = 8;

[[nodiscard]] inline int count_of(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size())
    ++count;
  return count;
}

/// Makes in.rawlog, in_*.csv and truth.rawlog in the folder.
/// @param changes further INI text; sections may be given again.
/// @param lidar its section.
inline void simulate(const TestFolder& folder, const std::string& changes = {},
                     const std::string& lidar = kSmallLidar) {
  simulate_in(folder.path(), kSmallStreet + lidar + changes);
}

inline std::string densify_command(const std::string& input, const std::string& output,
                                   const std::string& more = "") {
  return std::string(RAWLOG_DENSIFY) + " --config " CONFIG_FOLDER "/default.ini --input " + input +
         " --output " + output + " " + more;
}

/// in.rawlog to out.rawlog, with the shipped settings.
inline void densify(const TestFolder& folder, const std::string& more = "") {
  expect_done(densify_command(folder / "in.rawlog", folder / "out.rawlog", more));
}

/// out.rawlog against a reference, what rawlog-evaluate finds.
inline nlohmann::json evaluate(const TestFolder& folder, const std::string& reference,
                               const std::string& more = "") {
  expect_done(std::string(RAWLOG_EVALUATE) + " --reference " + folder / reference + " --input " +
              folder / "out.rawlog" + " --json " + folder / "errors.json " + more);
  std::ifstream file(folder / "errors.json");
  return nlohmann::json::parse(file, nullptr, false);
}

/// The same against the simulator's truth: the mean figures of our virtual scans.
inline nlohmann::json errors_to_truth(const TestFolder& folder) {
  return evaluate(folder, "truth.rawlog",
                  "--truth-objects " + folder / "in_objects.csv")["summary"]["ours"];
}

/// One observation, wherever it stands in the log.
struct Logged {
  mrpt::obs::CObservation::Ptr observation;
  std::vector<std::uint8_t> bytes;

  [[nodiscard]] const std::string& label() const { return observation->sensorLabel; }
  [[nodiscard]] Stamp stamp() const { return observation->timestamp; }
};

inline std::vector<Logged> observations_of(const std::string& path) {
  std::vector<Logged> all;
  const auto add = [&](RawlogEntry entry) {
    if (auto observation = std::dynamic_pointer_cast<mrpt::obs::CObservation>(entry.object))
      all.push_back({std::move(observation), std::move(entry.bytes)});
  };
  for (RawlogEntry& entry : read_log(path)) {
    if (dynamic_cast<mrpt::obs::CSensoryFrame*>(entry.object.get()) == nullptr)
      add(std::move(entry));
    else
      for (RawlogEntry& part : split_frame(entry)) add(std::move(part));
  }
  return all;
}

inline std::vector<Logged> with_label(const std::vector<Logged>& all, const std::string& label) {
  std::vector<Logged> found;
  std::copy_if(all.begin(), all.end(), std::back_inserter(found),
               [&](const Logged& logged) { return logged.label() == label; });
  return found;
}

inline std::vector<Logged> without_label(const std::vector<Logged>& all, const std::string& label) {
  std::vector<Logged> found;
  std::copy_if(all.begin(), all.end(), std::back_inserter(found),
               [&](const Logged& logged) { return logged.label() != label; });
  return found;
}

/// Of a log with pictures. MRPT 2.14.7 and 2.15.14 count what --remove-label and --keep-label take
/// out, and write it all the same.
inline bool rawlog_edit_removes_labels(const std::string& log, const std::string& copy) {
  expect_done("rawlog-edit --keep-label CAM0 -i " + log + " -o " + copy);
  return without_label(observations_of(copy), "CAM0").empty();
}

[[nodiscard]] inline std::vector<Stamp> stamps_of(const std::vector<Logged>& all) {
  std::vector<Stamp> stamps;
  stamps.reserve(all.size());
  for (const Logged& logged : all) stamps.push_back(logged.stamp());
  return stamps;
}

}  // namespace lidar_upsampling
