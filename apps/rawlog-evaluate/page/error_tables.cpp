// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "error_tables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "palette.h"

namespace lidar_upsampling {

namespace {

constexpr std::array<Row, 5> kRivals{Row::hold, Row::ego, Row::constant_velocity, Row::paper,
                                     Row::ours};

HtmlRow line_of(Row row) {
  const char* css_class = row == Row::ours ? "ours" : is_bound(row) ? "bound" : "";
  return {name_of(row), {}, color_of(row), css_class, !is_bound(row)};
}

Cell mean_cell(const ErrorSummary& errors, int digits = 3) {
  return error_cell(errors.count > 0, errors.mean, digits);
}

Cell seeded_cell(const SeededFigure& figure, int digits) {
  if (figure.num_scans == 0) return error_cell(false, 0);
  Cell cell = error_cell(true, figure.mean, digits);
  cell.text += " ± " + fixed(figure.spread, digits);
  return cell;
}

HtmlTable object_table(const char* caption, const Figures& figures,
                       ObjectFigures RowFigures::*which) {
  HtmlTable table{caption,
                  {"count", "mean m", "median m", "p95 m", "depth %", "velocity m/s", "yaw deg"},
                  {},
                  ""};
  for (const Row row : kRows) {
    const ObjectFigures& objects = figures.rows[row].*which;
    const ErrorSummary& position = objects.position_m;
    if (position.count == 0) continue;
    HtmlRow line = line_of(row);
    line.cells = {count_cell(position.count),          error_cell(true, position.mean),
                  error_cell(true, position.median),   error_cell(true, position.p95),
                  mean_cell(objects.depth_percent, 2), mean_cell(objects.velocity_mps, 2),
                  mean_cell(objects.yaw_deg, 2)};
    table.rows.push_back(std::move(line));
  }
  return table;
}

/// Numbers of points are short, so that a narrow screen has room for all columns.
std::string label_of(const Bin& bin, const Binned& binned) {
  if (binned.key != "points" || std::isinf(bin.to)) return edges_of(bin, binned.unit);
  return fixed(bin.from, 0) + "–" + fixed(bin.to, 0);
}

/// Here a line is a bin, and the rows stand side by side.
HtmlTable binned_table(const Binned& binned) {
  HtmlTable table;
  table.caption = std::string(binned.moving ? "Moving" : "Static") + " objects by " +
                  (binned.key == "points" ? "number of points" : binned.key) + ", mean m";
  table.columns = {"count"};
  table.rank_in_rows = true;
  for (const Row row : kRivals) table.columns.emplace_back(name_of(row));
  for (const Bin& bin : binned.bins) {
    HtmlRow line;
    line.name = label_of(bin, binned);
    line.cells = {count_cell(bin.rows[Row::ours].count)};
    for (const Row row : kRivals)
      line.cells.push_back(error_cell(bin.rows[row].count > 0, bin.rows[row].mean));
    table.rows.push_back(std::move(line));
  }
  return table;
}

struct Column {
  const char* name;
  ErrorSummary RowFigures::*figure;
  int digits = 3;
};

/// Columns of which ours has nothing are left out.
HtmlTable mean_table(const char* caption, const Figures& figures, std::vector<Column> columns) {
  const auto unknown = [&](const Column& column) {
    return (figures.rows[Row::ours].*column.figure).count == 0;
  };
  columns.erase(std::remove_if(columns.begin(), columns.end(), unknown), columns.end());
  HtmlTable table;
  table.caption = caption;
  for (const Column& column : columns) table.columns.emplace_back(column.name);
  for (const Row row : kRows) {
    HtmlRow line = line_of(row);
    bool known = false;
    for (const Column& column : columns) {
      const ErrorSummary& errors = figures.rows[row].*column.figure;
      known = known || errors.count > 0;
      line.cells.push_back(mean_cell(errors, column.digits));
    }
    if (known) table.rows.push_back(std::move(line));
  }
  return table;
}

HtmlRow sampled_line(Row row, const SampledFigures& figures, bool all, bool exact) {
  HtmlRow line = line_of(row);
  if (!all) {
    line.name += ", without outliers";
    line.competes = false;
  }
  line.cells = {seeded_cell(figures.chamfer_m2, 3), seeded_cell(figures.emd_m2, 2),
                error_cell(true, figures.chamfer_m.mean), error_cell(true, figures.emd_m.mean)};
  if (exact) line.cells.push_back(error_cell(true, figures.exact_emd_m2.mean));
  return line;
}

/// With the digits that were printed.
std::string as_printed(double figure) {
  std::ostringstream text;
  text << figure;
  return text.str();
}

HtmlRow published_line(const Published& published) {
  HtmlRow line{std::string(published.method) + " *", {}, "", "published", false};
  for (const double figure : published.figures) line.cells.push_back(text_cell(as_printed(figure)));
  return line;
}

const char* const kPublishedNote =
    "* as published: other frames, other machines, other horizons; to be set beside ours, not "
    "ranked with it.";

HtmlTable sampled_table(const Figures& figures, const Protocol& protocol) {
  HtmlTable table;
  table.caption = "Protocol " + protocol.name + ", mean over scans ± spread over seeds";
  table.columns = {"CD m²", "EMD m²", "CD m", "EMD m"};
  table.note = kPublishedNote;
  const bool exact = figures.rows[Row::ours].sampled.exact_emd_m2.mean > 0;
  if (exact) table.columns.emplace_back("exact EMD m²");
  for (const Row row : kRows) {
    const RowFigures& f = figures.rows[row];
    if (f.sampled.chamfer_m2.num_scans > 0)
      table.rows.push_back(sampled_line(row, f.sampled, true, exact));
    if (f.sampled_inliers.chamfer_m2.num_scans > 0)
      table.rows.push_back(sampled_line(row, f.sampled_inliers, false, exact));
  }
  for (const Published& published : protocol.published) {
    table.rows.push_back(published_line(published));
    table.rows.back().cells.resize(table.columns.size(), text_cell("–"));
  }
  return table;
}

std::vector<HtmlTable> trajectory_tables(const Figures& figures, const Protocol& protocol) {
  HtmlTable ours;
  ours.caption = "Protocol " + protocol.name + ": mean depth error, %";
  ours.columns = {"count"};
  ours.rank_in_rows = true;
  for (const Row row : kRivals) ours.columns.emplace_back(name_of(row));
  for (const auto& [id, rows] : figures.depth_by_object) {
    HtmlRow line;
    line.name = "object " + id;
    line.cells = {count_cell(rows[Row::ours].count)};
    for (const Row row : kRivals)
      line.cells.push_back(error_cell(rows[row].count > 0, rows[row].mean, 2));
    ours.rows.push_back(std::move(line));
  }
  HtmlTable published;
  published.caption = "As published, by sequence and object: depth error, %";
  published.note = kPublishedNote;
  for (const char* column : protocol.columns) published.columns.emplace_back(column);
  for (const Published& row : protocol.published) published.rows.push_back(published_line(row));
  return {ours, published};
}

void add_if_filled(std::vector<HtmlTable>& tables, HtmlTable table) {
  if (!table.rows.empty()) tables.push_back(std::move(table));
}

}  // namespace

std::vector<HtmlTable> object_tables(const Figures& figures) {
  std::vector<HtmlTable> tables;
  add_if_filled(tables,
                object_table("Moving objects, position error", figures, &RowFigures::moving));
  add_if_filled(tables,
                object_table("Static objects, position error", figures, &RowFigures::standing));
  return tables;
}

std::vector<HtmlTable> binned_tables(const Figures& figures) {
  std::vector<HtmlTable> tables;
  for (const char* key : {"horizon", "range", "points"})
    for (const bool moving : {true, false})
      for (const Binned& binned : figures.binned)
        if (binned.key == key && binned.moving == moving)
          add_if_filled(tables, binned_table(binned));
  return tables;
}

std::vector<HtmlTable> scan_tables(const Figures& figures) {
  std::vector<HtmlTable> tables;
  add_if_filled(tables, mean_table("Chamfer distance at full resolution, mean over scans", figures,
                                   {{"all m", &RowFigures::chamfer_m, 4},
                                    {"all m²", &RowFigures::chamfer_m2, 4},
                                    {"in view m", &RowFigures::view_chamfer_m, 4},
                                    {"in view m²", &RowFigures::view_chamfer_m2, 4}}));
  add_if_filled(tables, mean_table("Points, mean over scans", figures,
                                   {{"of moving objects m", &RowFigures::moving_points_m},
                                    {"of the static scene m", &RowFigures::static_scene_m}}));
  if (figures.rows[Row::ours].epe_three_way_m.count > 0)
    tables.push_back(mean_table("Scene flow, mean end point error, m", figures,
                                {{"moving", &RowFigures::epe_dynamic_m},
                                 {"standing", &RowFigures::epe_static_m},
                                 {"ground", &RowFigures::epe_background_m},
                                 {"three-way", &RowFigures::epe_three_way_m}}));
  return tables;
}

std::vector<HtmlTable> protocol_tables(const Figures& figures, const Protocol& protocol) {
  if (protocol.measure == Protocol::Measure::trajectories)
    return trajectory_tables(figures, protocol);
  std::vector<HtmlTable> tables;
  if (figures.rows[Row::ours].sampled.chamfer_m2.num_scans > 0)
    tables.push_back(sampled_table(figures, protocol));
  return tables;
}

}  // namespace lidar_upsampling
