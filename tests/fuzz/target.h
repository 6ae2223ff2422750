// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "fuzz/random.h"

namespace lidar_upsampling::fuzz {

/// What an input must not bring about, though nothing throws: said in a line.
struct Finding : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// One kind of input.
struct Target {
  std::string name;
  /// Makes one and goes with it through the library. What a tool would tell its user is thrown.
  std::function<void(Random&)> run;
  /// The same with one that nothing is wrong with, which throws nothing.
  std::function<void()> run_whole;
  std::uint64_t num_in_test = 250;  ///< inputs that the test has time for
};

/// Logs of every carrier, through densification to a log again.
[[nodiscard]] std::vector<Target> log_targets();
/// Settings, tables, poses, reports.
[[nodiscard]] std::vector<Target> text_targets();
/// Files of data sets.
[[nodiscard]] std::vector<Target> data_set_targets();

[[nodiscard]] const std::vector<Target>& all_targets();

/// @brief Runs a target with the input of this seed. @return what is wrong with how it went; none:
/// it went well, or was refused as wrong input is.
[[nodiscard]] std::optional<std::string> failure_of(const Target& target, std::uint64_t seed);

/// The target and the seed that are at work, for whoever reports the end of the process.
[[nodiscard]] const char* at_work();

/// Says on stderr which input it was that ends the process: by a signal, a sanitizer or exit().
void tell_of_ends();

}  // namespace lidar_upsampling::fuzz
