// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <string>
#include <vector>

namespace lidar_upsampling::argoverse {

/// The vertices of a PLY file, property by property.
struct PlyVertices {
  std::string path;
  std::vector<std::string> names;
  std::vector<std::vector<double>> values;  ///< of each name, one per vertex

  /// @throw std::runtime_error there is no such property.
  [[nodiscard]] const std::vector<double>& property(const std::string& name) const;
};

/// @brief Reads the `vertex` element, which must be the first; ascii or binary_little_endian, any
/// number types, no lists.
/// @throw std::runtime_error with the file: unreadable, of another kind, or cut short.
[[nodiscard]] PlyVertices read_ply(const std::string& path);

}  // namespace lidar_upsampling::argoverse
