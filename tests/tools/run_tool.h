// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "lidar_upsampling/io/rawlog_stream.h"

namespace lidar_upsampling {

struct ToolResult {
  int status = -1;
  std::string text;  ///< stdout and stderr
};

inline ToolResult run(const std::string& command) {
  ToolResult result;
  std::FILE* const pipe = popen((command + " 2>&1 </dev/null").c_str(), "r");
  std::array<char, 4096> buffer{};
  for (std::size_t n = 0; (n = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) {
    result.text.append(buffer.data(), n);
  }
  const int status = pclose(pipe);
  result.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return result;
}

/// The same with stderr alone.
inline ToolResult run_for_errors(const std::string& command) {
  return run("( " + command + " 2>&1 >/dev/null )");
}

inline bool has_rawlog_edit() { return run("command -v rawlog-edit").status == 0; }

/// @throw CorruptRawlog as the reader does.
inline std::vector<RawlogEntry> read_log(const std::string& path) {
  std::vector<RawlogEntry> entries;
  RawlogReader reader(path);
  while (auto entry = reader.next()) entries.push_back(std::move(*entry));
  return entries;
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Real data for tests, which skip without it.
inline std::filesystem::path data_folder() {
  const char* const set = std::getenv("LIDAR_UPSAMPLING_DATA");
  return set != nullptr ? set : SHARED_DATA;
}

}  // namespace lidar_upsampling
