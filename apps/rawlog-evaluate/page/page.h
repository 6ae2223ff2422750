// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <optional>
#include <string>

#include "coverage.h"
#include "figures.h"
#include "run_report.h"
#include "worst_objects.h"

namespace lidar_upsampling {

/// A comparison with withheld scans or with truth.
struct Comparison {
  LogResult result;
  Figures figures;
  std::optional<Protocol> protocol;
  WorstObjects worst;
};

/// What the page tells of.
struct PageContent {
  std::string input;
  Coverage coverage;
  std::optional<Comparison> comparison;
  std::optional<RunReport> run;
};

/// @brief One page for people, with everything in it: tables, plots and pictures; it needs neither
/// other files nor a network.
/// @throw std::runtime_error gnuplot fails.
[[nodiscard]] std::string to_page(const PageContent& content);

/// One sentence: our mean error on moving objects beside that of the best baseline.
[[nodiscard]] std::string headline(const Figures& figures);

}  // namespace lidar_upsampling
