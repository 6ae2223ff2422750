// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "protocol.h"

#include <algorithm>
#include <stdexcept>

namespace lidar_upsampling {

namespace {

std::vector<Protocol> all_protocols() {
  using Measure = Protocol::Measure;
  const std::vector<const char*> cloud{"CD m2", "EMD m2"};
  return {
      {"kitti-odometry",
       Measure::scene,
       16384,
       false,
       cloud,
       {{"MoNet (LSTM)", {0.573, 91.79}},
        {"MoNet (GRU)", {0.554, 91.97}},
        {"SPINet (offline)", {0.465, 40.69}},
        {"PointINet (offline)", {0.457, 39.46}},
        {"Rozsa & Sziranyi 2023", {0.471, 33.98}}}},
      {"kitti-vehicles",
       Measure::vehicles,
       16384,
       true,
       cloud,
       {{"SPF2 (points)", {2.37, 211.47}},
        {"SPF2 (range map)", {0.92, 128.81}},
        {"Rozsa & Sziranyi 2023, with outliers", {0.63, 31.03}},
        {"Rozsa & Sziranyi 2023, without", {0.42, 1.91}}}},
      {"kitti-raw-trajectories",
       Measure::trajectories,
       0,
       false,
       {"04/1 %", "04/2 %", "04/3 %", "04/6 %", "47/0 %", "47/4 %", "47/9 %", "47/12 %", "56/0 %",
        "mean %"},
       {{"one camera (Song, Chandraker 2015)", {6.0, 5.6, 4.9, 5.9, 5.9, 12.5, 7.0, 8.2, 6.0, 6.8}},
        {"one camera (IEEE 8708251)", {5.1, 11.1, 1.8, 2.5, 9.3, 3.8, 6.6, 2.8, 0.8, 4.9}},
        {"Rozsa & Sziranyi 2023", {1.3, 1.1, 0.9, 1.5, 6.2, 1.7, 0.6, 1.6, 0.8, 1.7}}}},
      {"argoverse",
       Measure::scene,
       16384,
       false,
       cloud,
       {{"MoNet (LSTM)", {2.105, 368.21}},
        {"MoNet (GRU)", {2.069, 364.14}},
        {"Rozsa & Sziranyi 2023", {1.990, 208.33}}}},
      {"argoverse-vehicles",
       Measure::vehicles,
       2048,
       true,
       cloud,
       {{"SPCM-Net", {1.345, 2.30}},
        {"Rozsa & Sziranyi 2023, with outliers", {0.814, 4.43}},
        {"Rozsa & Sziranyi 2023, without", {0.801, 0.94}}}},
  };
}

}  // namespace

std::vector<std::string> protocol_names() {
  std::vector<std::string> names;
  for (const Protocol& protocol : all_protocols()) names.push_back(protocol.name);
  return names;
}

Protocol find_protocol(const std::string& name) {
  std::string known;
  for (Protocol& protocol : all_protocols()) {
    if (protocol.name == name) return protocol;
    known += (known.empty() ? "" : ", ") + protocol.name;
  }
  throw std::invalid_argument("--protocol " + name + ": unknown; there are " + known);
}

bool is_vehicle(const std::string& class_name) {
  std::string lower = class_name;
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) {
    return static_cast<char>(c >= 'A' && c <= 'Z' ? c + ('a' - 'A') : c);
  });
  for (const char* other : {"pedestrian", "person", "cyclist", "bicycl", "animal", "stroller"})
    if (lower.find(other) != std::string::npos) return false;
  return true;
}

}  // namespace lidar_upsampling
