// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// What a paper printed; figures of other programs on other machines.
struct Published {
  const char* method;
  std::vector<double> figures;  ///< in the order of the protocol's columns
};

/// @brief How one table of the paper ("Virtually increasing the measurement frequency of LIDAR
/// sensor utilizing a single RGB camera", section Evaluation) cuts clouds to size.
struct Protocol {
  enum class Measure { scene, vehicles, trajectories };
  std::string name;
  Measure measure = Measure::scene;
  std::size_t num_points = 16384;  ///< of each cloud at most, drawn at random
  bool crop_to_road = false;       ///< x within 32 m, y within 8 m, z below 2 m, vehicle frame
  std::vector<const char*> columns;
  std::vector<Published> published;
};

/// The names that find_protocol() knows.
[[nodiscard]] std::vector<std::string> protocol_names();

/// @throw std::invalid_argument with the names there are.
[[nodiscard]] Protocol find_protocol(const std::string& name);

/// Whether objects of this class are vehicles; clusters may be.
[[nodiscard]] bool is_vehicle(const std::string& class_name);

}  // namespace lidar_upsampling
