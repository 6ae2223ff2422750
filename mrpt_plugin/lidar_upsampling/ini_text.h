// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <map>
#include <string>

namespace lidar_upsampling {

/// @brief A settings file as text, and where its keys stand. MRPT passes over lines that it cannot
/// read; here they are errors, as each is a setting that someone believes to be in force.
struct IniText {
  std::string path, text;
  std::map<std::string, int> line_of;  ///< "[section] key", and "[section]"

  /// What is wrong with a section or a key, as "[klt] window_px: ...", with the file and line
  /// before it where these are known.
  [[nodiscard]] std::string located(const std::string& message) const;
};

/// Whether a section or a key may stand in the file more than once.
enum class IniRepeats { refuse, allow };

/// @brief Reads a settings file.
/// @throw std::runtime_error with path, line and what is wrong: no text (a folder, UTF-16, control
/// characters), no bracket behind a section's name, no `=`, a key before any section, a key or a
/// section for the second time.
[[nodiscard]] IniText read_ini(const std::string& path, IniRepeats repeats = IniRepeats::refuse);

}  // namespace lidar_upsampling
