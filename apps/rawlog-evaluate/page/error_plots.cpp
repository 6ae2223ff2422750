// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "error_plots.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "html.h"
#include "palette.h"

namespace lidar_upsampling {

namespace {

constexpr double kLeastDrawn_m = 1e-3;  // on a logarithmic axis nothing is zero
constexpr std::size_t kMaxCurvePoints = 300;
// From left to right within a bin.
constexpr std::array<Row, 5> kShown{Row::hold, Row::ego, Row::constant_velocity, Row::paper,
                                    Row::ours};

/// Marks and dashes; ours is drawn through.
int style_of(std::size_t place) { return static_cast<int>((place + 1) % kShown.size()); }

double drawn(double error) { return std::max(error, kLeastDrawn_m); }

Axis error_axis() {
  return {"position error",
          true,
          0,
          0,
          {{0.001, "1 mm"},
           {0.003, "3 mm"},
           {0.01, "1 cm"},
           {0.03, "3 cm"},
           {0.1, "10 cm"},
           {0.3, "30 cm"},
           {1, "1 m"},
           {3, "3 m"},
           {10, "10 m"}}};
}

/// Wide enough for all points and at least the ticks around them.
void fit_to(Axis& axis, double low, double high) {
  axis.from = axis.ticks.front().first;
  axis.to = axis.ticks.back().first;
  for (const auto& [place, label] : axis.ticks)
    if (place <= low) axis.from = place;
  for (auto tick = axis.ticks.rbegin(); tick != axis.ticks.rend(); ++tick)
    if (tick->first >= high) axis.to = tick->first;
  axis.to = std::max(axis.to, high);
}

/// 3162 as 3.2k: two of them stand side by side below a plot.
std::string short_number(double value) {
  if (value < 1000) return fixed(value, 0);
  const std::string text = fixed(value / 1000, 1);
  return (text.substr(text.size() - 2) == ".0" ? text.substr(0, text.size() - 2) : text) + "k";
}

/// @param with_word for a few bins there is room to say what is counted.
std::string label_of(const Bin& bin, const std::string& unit, bool with_word) {
  const int count = bin.rows[Row::ours].count;
  const std::string objects = "\n" + std::to_string(count) +
                              (!with_word   ? ""
                               : count == 1 ? " object"
                                            : " objects");
  if (unit == "s") return fixed(1e3 * bin.mean_key, 0) + " ms" + objects;
  if (std::isinf(bin.to)) return "≥ " + short_number(bin.from) + objects;
  return short_number(bin.from) + "–" + short_number(bin.to) + objects;
}

const char* kind_of(bool moving) { return moving ? "Moving" : "Static"; }

std::string axis_label(const std::string& key) {
  if (key == "horizon") return "time since the key scan";
  if (key == "range") return "range at the key scan, m";
  return "points in the key scan";
}

Plot binned_plot(const Binned& binned) {
  Plot plot;
  plot.caption = std::string(kind_of(binned.moving)) + " objects by " +
                 (binned.key == "points" ? "number of points" : binned.key);
  plot.kind = Plot::Kind::ranges;
  plot.x = {axis_label(binned.key), false, -0.5, static_cast<double>(binned.bins.size()) - 0.5, {}};
  plot.y = error_axis();
  double low = plot.y.ticks.back().first, high = 0;
  for (std::size_t k = 0; k < kShown.size(); ++k) {
    const Row row = kShown.at(k);
    Series series{name_of(row), color_of(row), style_of(k), row == Row::ours, {}};
    for (std::size_t i = 0; i < binned.bins.size(); ++i) {
      const ErrorSummary& errors = binned.bins[i].rows[row];
      if (errors.count == 0) continue;
      const double place = static_cast<double>(i) + 0.12 * (static_cast<double>(k) - 2);
      series.points.push_back({place, drawn(errors.median), drawn(errors.q1), drawn(errors.q3)});
      low = std::min(low, drawn(errors.q1));
      high = std::max(high, drawn(errors.q3));
    }
    if (!series.points.empty()) plot.series.push_back(std::move(series));
  }
  constexpr std::size_t kFew = 4;
  const bool with_word = binned.bins.size() <= kFew;
  if (!with_word) plot.x.label += "; below, how many objects";
  for (std::size_t i = 0; i < binned.bins.size(); ++i)
    plot.x.ticks.emplace_back(i, label_of(binned.bins[i], binned.unit, with_word));
  fit_to(plot.y, low, high);
  return plot;
}

/// Those of the objects that every row is judged by: ours is known.
std::vector<double> errors_of(const LogResult& result, bool moving, Row row) {
  std::vector<double> errors;
  result.scans.for_each([&](const ScanResult& scan) {
    for (const ObjectResult& object : scan.objects)
      if (object.object.moving == moving && is_counted(object) && object.errors[row])
        errors.push_back(drawn(object.errors[row]->position_m));
  });
  std::sort(errors.begin(), errors.end());
  return errors;
}

Series curve_of(const std::vector<double>& errors, Row row, int style) {
  Series series{name_of(row), color_of(row), style, row == Row::ours, {}};
  const std::size_t step = errors.size() / kMaxCurvePoints + 1;
  for (std::size_t i = step - 1; i < errors.size(); i += step)
    series.points.push_back({errors[i], 100. * static_cast<double>(i + 1) / errors.size(), 0, 0});
  if (!errors.empty() && (series.points.empty() || series.points.back().y < 100))
    series.points.push_back({errors.back(), 100, 0, 0});
  return series;
}

Plot distribution_plot(const LogResult& result, bool moving) {
  Plot plot;
  plot.caption = std::string(kind_of(moving)) + " objects: share with at most this error";
  plot.x = error_axis();
  plot.y = {"share of the objects, %", false, 0, 100, {}};
  double low = plot.x.ticks.back().first, high = 0;
  for (std::size_t k = 0; k < kShown.size(); ++k) {
    const Row row = kShown.at(k);
    const std::vector<double> errors = errors_of(result, moving, row);
    if (errors.empty()) continue;
    plot.series.push_back(curve_of(errors, row, style_of(k)));
    low = std::min(low, errors.front());
    high = std::max(high, errors.back());
  }
  fit_to(plot.x, low, high);
  return plot;
}

}  // namespace

std::vector<Plot> binned_plots(const Figures& figures) {
  std::vector<Plot> plots;
  for (const char* key : {"horizon", "range", "points"})
    for (const bool moving : {true, false})
      for (const Binned& binned : figures.binned)
        if (binned.key == key && binned.moving == moving && !binned.bins.empty())
          plots.push_back(binned_plot(binned));
  return plots;
}

std::vector<Plot> distribution_plots(const LogResult& result) {
  std::vector<Plot> plots;
  for (const bool moving : {true, false}) {
    Plot plot = distribution_plot(result, moving);
    if (!plot.series.empty()) plots.push_back(std::move(plot));
  }
  return plots;
}

}  // namespace lidar_upsampling
