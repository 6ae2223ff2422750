// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <exception>
#include <functional>
#include <iostream>
#include <string>
#include <utility>

#include "lidar_upsampling/io/temporary_names.h"
#include "lidar_upsampling/text.h"

namespace lidar_upsampling {

constexpr int kDone = 0;
constexpr int kFailed = 1;
constexpr int kWrongUsage = 2;

/// @brief What every tool's main does: parses, works, and says in one line on stderr what failed; a
/// signal that ends it leaves nothing half done.
/// @return the exit status: 0 done, 1 failed, 2 wrong usage.
inline int run_tool(CLI::App& app, int argc, char** argv, const std::function<void()>& work) {
  app.set_version_flag("--version", app.get_name() + " " + LIDAR_UPSAMPLING_VERSION);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kDone : kWrongUsage;
  }
  remove_temporaries_on_signals();
  try {
    work();
    return kDone;
  } catch (const std::exception& error) {
    std::cerr << app.get_name() << ": " << one_line(error) << "\n";
    return kFailed;
  }
}

/// @brief Says in one line on stderr what is worth knowing of work that is done nevertheless.
inline void warn(const std::string& tool, const std::string& text) {
  std::cerr << tool << ": warning: " << text << "\n";
}

/// Percents on a terminal, nothing in a pipe.
class Progress {
 public:
  explicit Progress(std::string what) : what_(std::move(what)) {}
  ~Progress() {
    if (percent_ >= 0) std::fputs("\r\033[K", stderr);
  }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// @param share 0 to 1.
  void operator()(double share) {
    const int percent = static_cast<int>(std::floor(100. * share));
    if (!on_terminal_ || percent == percent_) return;
    percent_ = percent;
    std::fprintf(stderr, "\r%s %3d %%", what_.c_str(), percent);
  }

 private:
  std::string what_;
  bool on_terminal_ = isatty(STDERR_FILENO) != 0;
  int percent_ = -1;
};

}  // namespace lidar_upsampling
