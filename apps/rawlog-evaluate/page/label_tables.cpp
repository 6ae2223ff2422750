// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "label_tables.h"

#include <utility>

#include "palette.h"

namespace lidar_upsampling {

namespace {

using FiguresByRow = PerRow<std::optional<LabelFigures>>;

FiguresByRow figures_by_row(const LabelScores& scores) {
  FiguresByRow figures;
  for (const Row row : kRows)
    if (scores[row]) figures[row] = label_figures(*scores[row]);
  return figures;
}

HtmlRow label_line(Row row, std::vector<Cell> cells) {
  return {name_of(row), std::move(cells), color_of(row), row == Row::ours ? "ours" : "", true};
}

HtmlTable movers_table(const FiguresByRow& figures, bool all) {
  HtmlTable table{all ? "Labelled movers: those that no row tells of count as left standing"
                      : "Labelled movers that a row tells of",
                  {"count", "mean m", "median m", "p95 m", "velocity m/s", "velocity rms m/s"},
                  {},
                  ""};
  for (const Row row : kRows) {
    if (!figures[row]) continue;
    const LabelFigures& f = *figures[row];
    const ErrorSummary& error = all ? f.movers_m : f.found_m;
    if (error.count == 0) continue;
    const ErrorSummary& velocity = all ? f.velocity_mps : f.found_velocity_mps;
    const double rms = all ? f.velocity_rms_mps : f.found_velocity_rms_mps;
    table.rows.push_back(
        label_line(row, {count_cell(error.count), error_cell(true, error.mean),
                         error_cell(true, error.median), error_cell(true, error.p95),
                         error_cell(true, velocity.mean, 2), error_cell(true, rms, 2)}));
  }
  return table;
}

HtmlTable false_table(const FiguresByRow& figures) {
  HtmlTable table{
      "Told to move that do not, and tracks",
      {"parked", "told to move", "shift m", "false per image", "shift m", "followed", "switches"},
      {},
      "parked: labelled, standing, and told of; false movers: told to move where "
      "nothing is labelled."};
  for (const Row row : kRows) {
    if (!figures[row]) continue;
    const LabelFigures& f = *figures[row];
    const bool parked = f.num_parked > 0, followed = f.num_followed > 0;
    table.rows.push_back(label_line(
        row, {count_cell(f.num_parked), plain_cell(parked, f.num_parked_told, 0),
              plain_cell(parked, f.parked_shift_m, 3), plain_cell(true, f.false_per_image, 2),
              plain_cell(true, f.false_shift_m, 3), plain_cell(followed, f.num_followed, 0),
              plain_cell(followed, f.num_switches, 0)}));
  }
  return table;
}

HtmlTable group_table(const std::string& key, const std::vector<LabelGroup>& groups) {
  HtmlTable table{"Labelled movers by " + key + ", mean m",
                  {"count", "ego", "constant-velocity", "paper", "ours"},
                  {},
                  "",
                  true};
  for (const LabelGroup& group : groups) {
    HtmlRow line{group.name, {count_cell(group.count)}, "", "", true};
    for (const Row row : {Row::ego, Row::constant_velocity, Row::paper, Row::ours})
      line.cells.push_back(
          error_cell(group.mean_m[row].has_value(), group.mean_m[row].value_or(0)));
    table.rows.push_back(std::move(line));
  }
  return table;
}

std::string compared_by(double ratio, const char* other) {
  return ratio >= 1 ? fixed(ratio, 1) + " times nearer than " + other
                    : fixed(1 / ratio, 1) + " times as far as " + other;
}

}  // namespace

std::vector<HtmlTable> label_tables(const LabelScores& scores) {
  if (!scores[Row::ego]) return {};
  const FiguresByRow figures = figures_by_row(scores);
  std::vector<HtmlTable> tables{movers_table(figures, true), movers_table(figures, false),
                                false_table(figures)};
  for (const auto& [key, groups] : label_groups(scores)) tables.push_back(group_table(key, groups));
  return tables;
}

std::string label_headline(const LabelScores& scores) {
  if (!scores[Row::ours]) return {};
  const LabelFigures ours = label_figures(*scores[Row::ours]);
  std::string text = "Moving objects are " + fixed(100 * ours.movers_m.mean, 1) +
                     " cm off on average (95 % of " + std::to_string(ours.movers_m.count) +
                     " by less than " + fixed(100 * ours.movers_m.p95, 1) + " cm)";
  for (const auto& [row, name] : {std::pair(Row::constant_velocity, "with constant velocity"),
                                  std::pair(Row::paper, "by the published method")})
    if (scores[row] && ours.movers_m.mean > 0)
      text +=
          ", " + compared_by(label_figures(*scores[row]).movers_m.mean / ours.movers_m.mean, name);
  return text + "; " + fixed(ours.false_per_image, 2) + " per image are told to move that do not.";
}

}  // namespace lidar_upsampling
