// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <functional>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "common/heap.h"
#include "common/help_text.h"
#include "lidar_upsampling/io/temporary_names.h"
#include "lidar_upsampling/nearest_word.h"
#include "lidar_upsampling/text.h"

namespace lidar_upsampling {

constexpr int kDone = 0;
constexpr int kFailed = 1;
constexpr int kWrongUsage = 2;

/// Says which option a misspelt one may have been meant for.
inline void tell_what_was_meant(const CLI::App& app) {
  std::vector<std::string> known;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  for (const std::string& word : app.remaining()) {
    const std::string name = word.substr(0, word.find('='));
    if (name.rfind("--", 0) != 0) continue;
    const std::string meant = did_you_mean(name, known);
    if (!meant.empty()) std::cerr << name << ": there is no such option" << meant << "\n";
  }
}

/// What is no number, or none that is finite, passes CLI11's own checks of ranges.
inline void refuse_numbers_that_are_none(CLI::App& app) {
  const CLI::Validator is_number(
      [](const std::string& text) { return number_in(text) ? "" : text + " is no number"; }, "");
  for (CLI::Option* option : app.get_options())
    if (option->get_type_name().find("FLOAT") != std::string::npos) option->check(is_number);
}

/// @brief What every tool's main does: parses, works, and says in one line on stderr what failed; a
/// signal that ends it leaves nothing half done.
/// @return the exit status: 0 done, 1 failed, 2 wrong usage.
inline int run_tool(CLI::App& app, int argc, char** argv, const std::function<void()>& work) {
  refuse_numbers_that_are_none(app);
  app.formatter(std::make_shared<HelpText>());
  app.set_version_flag("--version", app.get_name() + " " + LIDAR_UPSAMPLING_VERSION);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (app.exit(error) == 0) return kDone;
    tell_what_was_meant(app);
    return kWrongUsage;
  }
  remove_temporaries_on_signals();
  keep_heap_in_large_pages();
  try {
    work();
    if (!std::cout.flush()) throw std::runtime_error("cannot write to the standard output");
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

/// Percents, their rate and the time left: on a terminal in place, elsewhere a line a minute.
class Progress {
 public:
  explicit Progress(std::string what) : what_(std::move(what)) {}
  ~Progress() {
    if (on_terminal_ && percent_ >= 0) std::fputs("\r\033[K", stderr);
  }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// @param share 0 to 1.
  void operator()(double share) {
    constexpr double kLine_s = 60;
    const int percent = static_cast<int>(std::floor(100. * share));
    const double since_s = seconds_since(begin_);
    if (on_terminal_ ? percent == percent_ : since_s < told_s_ + kLine_s) return;
    percent_ = percent;
    told_s_ = since_s;
    std::fprintf(stderr, on_terminal_ ? "\r\033[K%s %3d %%%s" : "%s %3d %%%s\n", what_.c_str(),
                 percent, rate_and_left(share, since_s).c_str());
  }

 private:
  using Clock = std::chrono::steady_clock;
  static double seconds_since(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
  }
  /// Nothing before it can be told.
  static std::string rate_and_left(double share, double since_s) {
    constexpr double kLeastShare = 0.02, kLeast_s = 2;
    if (share < kLeastShare || since_s < kLeast_s) return {};
    const auto left_s = static_cast<long>(since_s * (1 - share) / share);
    std::array<char, 32> rate{};
    std::snprintf(rate.data(), rate.size(), ", %.2g %%/s, ", 100 * share / since_s);
    return rate.data() +
           (left_s < 120 ? std::to_string(left_s) + " s" : std::to_string(left_s / 60) + " min") +
           " left";
  }

  std::string what_;
  bool on_terminal_ = isatty(STDERR_FILENO) != 0;
  Clock::time_point begin_ = Clock::now();
  double told_s_ = 0;
  int percent_ = -1;
};

}  // namespace lidar_upsampling
