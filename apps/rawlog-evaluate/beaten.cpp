// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "beaten.h"

#include <array>
#include <utility>

#include "label_table.h"

namespace lidar_upsampling {

namespace {

/// Why a baseline is better, where that is known.
std::string reason_of(const std::string& figure, Row row) {
  const auto begins = [&](const char* with) { return figure.rfind(with, 0) == 0; };
  if (begins("static") && (row == Row::ego || row == Row::constant_velocity))
    return " (it is given the reference's own ego-motion)";
  if (begins("Chamfer") && row == Row::hold)
    return " (a copy's rings lie where the sensor draws them)";
  return {};
}

struct Statistic {
  const char* name;
  double ErrorSummary::*value;
};
constexpr std::array<Statistic, 3> kStatistics{{{"mean", &ErrorSummary::mean},
                                                {"median", &ErrorSummary::median},
                                                {"p95", &ErrorSummary::p95}}};

/// By labels, copies are no row.
void add_by_labels(const LogResult& result, std::vector<std::string>& beaten) {
  if (!result.labels[Row::ours]) return;
  const ErrorSummary ours = label_figures(*result.labels[Row::ours]).movers_m;
  for (const Row row : {Row::ego, Row::constant_velocity, Row::paper}) {
    if (!result.labels[row]) continue;
    const ErrorSummary rival = label_figures(*result.labels[row]).movers_m;
    for (const Statistic& statistic : kStatistics)
      if (rival.count > 0 && rival.*statistic.value < ours.*statistic.value)
        beaten.push_back(std::string("labelled movers, ") + statistic.name + ": " + name_of(row));
  }
}

}  // namespace

std::vector<std::string> beaten_figures(const LogResult& result, const PerRow<RowFigures>& rows) {
  std::vector<std::string> beaten;
  const auto compare = [&](const std::string& what, auto get) {
    const auto [ours, count] = get(rows[Row::ours]);
    if (count == 0) return;
    for (const Row row : {Row::hold, Row::ego, Row::constant_velocity, Row::paper}) {
      const auto [value, row_count] = get(rows[row]);
      if (row_count == 0 || !(value < ours)) continue;
      beaten.push_back(what + ": " + name_of(row) + reason_of(what, row));
    }
  };
  using Value = std::pair<double, int>;
  const auto mean = [](const ErrorSummary& summary) { return Value{summary.mean, summary.count}; };
  const auto seeded = [](const SeededFigure& f) { return Value{f.mean, f.num_scans}; };
  add_by_labels(result, beaten);
  for (const bool moving : {true, false})
    for (const Statistic& statistic : kStatistics)
      compare(std::string(moving ? "moving" : "static") + " objects, " + statistic.name,
              [&](const RowFigures& r) {
                const ErrorSummary& errors = (moving ? r.moving : r.standing).position_m;
                return Value{errors.*statistic.value, errors.count};
              });
  compare("points of moving objects", [&](const RowFigures& r) { return mean(r.moving_points_m); });
  compare("static scene", [&](const RowFigures& r) { return mean(r.static_scene_m); });
  compare("Chamfer m, all", [&](const RowFigures& r) { return mean(r.chamfer_m); });
  compare("Chamfer m, in view", [&](const RowFigures& r) { return mean(r.view_chamfer_m); });
  compare("sampled CD m2", [&](const RowFigures& r) { return seeded(r.sampled.chamfer_m2); });
  compare("sampled EMD m2", [&](const RowFigures& r) { return seeded(r.sampled.emd_m2); });
  return beaten;
}

}  // namespace lidar_upsampling
