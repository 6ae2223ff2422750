// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace lidar_upsampling {

struct PlotPoint {
  double x = 0, y = 0;
  double low = 0, high = 0;  ///< of a plot of ranges
};

struct Series {
  std::string name;
  std::string color;  ///< "#rrggbb"
  int style = 0;      ///< of its marks and dashes, so that colour alone does not tell
  bool thick = false;
  std::vector<PlotPoint> points;
};

using Ticks = std::vector<std::pair<double, std::string>>;

struct Axis {
  std::string label;
  bool logarithmic = false;
  double from = 0, to = 0;  ///< equal: as the points ask for
  Ticks ticks;              ///< empty: as the program chooses
};

struct Plot {
  enum class Kind {
    lines,
    marked_lines,
    ranges  ///< a mark, and a bar from low to high
  };
  std::string caption;
  Kind kind = Kind::lines;
  Axis x, y;
  std::vector<Series> series;
};

/// @brief Whether there is a program to draw plots with.
[[nodiscard]] bool has_gnuplot();

/// @brief Draws plots with gnuplot.
/// @return an `svg` element for each, fit to stand beside others in one HTML page.
/// @throw std::runtime_error gnuplot is not there or fails, or a temporary file cannot be made.
[[nodiscard]] std::vector<std::string> render_plots(const std::vector<Plot>& plots);

}  // namespace lidar_upsampling
