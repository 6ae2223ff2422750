// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "report.h"
#include "text_table.h"

namespace lidar_upsampling {

namespace {

std::string object_block(const char* title, const Figures& figures,
                         ObjectFigures RowFigures::*which) {
  std::string block =
      heading(title, {"count", "mean m", "median m", "p95 m", "depth %", "m/s", "yaw deg"});
  for (const Row row : kRows) {
    const ObjectFigures& objects = figures.rows[row].*which;
    const ErrorSummary& position = objects.position_m;
    if (position.count == 0) continue;
    block += named(name_of(row)) + formatted("%9d", position.count) + cell(true, position.mean) +
             cell(true, position.median) + cell(true, position.p95) +
             cell(objects.depth_percent.count > 0, objects.depth_percent.mean, 2) +
             cell(true, objects.velocity_mps.mean, 2) + cell(true, objects.yaw_deg.mean, 2) + "\n";
  }
  return block;
}

std::string scan_block(const char* title, const Figures& figures, ErrorSummary RowFigures::*which) {
  if ((figures.rows[Row::ours].*which).count == 0) return {};
  std::string block = heading(title, {"scans", "mean m", "median m", "p95 m"});
  for (const Row row : kRows) {
    const ErrorSummary& errors = figures.rows[row].*which;
    if (errors.count > 0)
      block += named(name_of(row)) + formatted("%9d", errors.count) + cell(true, errors.mean) +
               cell(true, errors.median) + cell(true, errors.p95) + "\n";
  }
  return block;
}

std::string flow_block(const Figures& figures) {
  if (figures.rows[Row::ours].epe_three_way_m.count == 0) return {};
  std::string block =
      heading("scene flow, mean end point error, m", {"moving", "standing", "rest", "3-way"});
  for (const Row row : kRows) {
    const RowFigures& f = figures.rows[row];
    if (f.epe_three_way_m.count == 0) continue;
    block += named(name_of(row)) + cell(f.epe_dynamic_m.count > 0, f.epe_dynamic_m.mean) +
             cell(f.epe_static_m.count > 0, f.epe_static_m.mean) +
             cell(f.epe_background_m.count > 0, f.epe_background_m.mean) +
             cell(true, f.epe_three_way_m.mean) + "\n";
  }
  return block;
}

std::string chamfer_block(const Figures& figures) {
  std::string block;
  for (const Row row : kRows) {
    const RowFigures& f = figures.rows[row];
    if (f.chamfer_m.count == 0) continue;
    const bool seen = f.view_chamfer_m.count > 0;
    block += named(name_of(row)) + cell(true, f.chamfer_m.mean, 4) +
             cell(true, f.chamfer_m2.mean, 4) + cell(seen, f.view_chamfer_m.mean, 4) +
             cell(seen, f.view_chamfer_m2.mean, 4) + "\n";
  }
  if (block.empty()) return block;
  return heading("Chamfer at full resolution, mean over scans",
                 {"all m", "all m2", "view m", "view m2"}) +
         block;
}

}  // namespace

std::string edges_of(const Bin& bin, const std::string& unit) {
  if (unit == "s") return formatted("%.0f ms", 1e3 * bin.mean_key);
  return edges_of(bin.from, bin.to, unit);
}

namespace {

std::string bin_block(const Binned& binned) {
  if (binned.bins.empty()) return {};
  const std::vector<Row> rows{Row::hold, Row::ego, Row::constant_velocity, Row::paper, Row::ours};
  std::string block = heading(
      std::string(binned.moving ? "moving" : "static") + " objects by " + binned.key + ", mean m",
      {"count", "hold", "ego", "const-v", "paper", "ours"});
  for (const Bin& bin : binned.bins) {
    block += named(edges_of(bin, binned.unit)) + formatted("%9d", bin.rows[Row::ours].count);
    for (const Row row : rows) block += cell(bin.rows[row].count > 0, bin.rows[row].mean);
    block += "\n";
  }
  return block;
}

std::string sampled_line(const std::string& name, const SampledFigures& f) {
  const bool exact = f.exact_emd_m2.mean > 0;
  return named(name) + cell(true, f.chamfer_m2.mean) + cell(true, f.chamfer_m2.spread) +
         cell(true, f.emd_m2.mean, 2) + cell(true, f.emd_m2.spread, 2) +
         cell(true, f.chamfer_m.mean) + cell(true, f.emd_m.mean) +
         cell(exact, f.exact_emd_m2.mean) + "\n";
}

std::string sampled_block(const Figures& figures, const Protocol& protocol) {
  if (figures.rows[Row::ours].sampled.chamfer_m2.num_scans == 0) return {};
  std::string block = heading("protocol " + protocol.name,
                              {"CD m2", "+-", "EMD m2", "+-", "CD m", "EMD m", "exact m2"});
  for (const Row row : kRows) {
    const RowFigures& f = figures.rows[row];
    if (f.sampled.chamfer_m2.num_scans > 0) block += sampled_line(name_of(row), f.sampled);
    if (f.sampled_inliers.chamfer_m2.num_scans > 0)
      block += sampled_line(std::string(name_of(row)) + ", without outliers", f.sampled_inliers);
  }
  for (const Published& row : protocol.published)
    block += named(std::string(row.method) + " *") + cell(true, row.figures[0]) + cell(false, 0) +
             cell(true, row.figures[1], 2) + cell(false, 0) + "\n";
  return block + "  * as published: other frames, machines and horizons\n";
}

std::string trajectory_block(const Figures& figures, const Protocol& protocol) {
  std::string block = heading("protocol " + protocol.name + ": depth error, %",
                              {"count", "hold", "ego", "const-v", "paper", "ours"});
  for (const auto& [id, rows] : figures.depth_by_object) {
    block += formatted("  object %-31s%9d", id.c_str(), rows[Row::ours].count);
    for (const Row row : {Row::hold, Row::ego, Row::constant_velocity, Row::paper, Row::ours})
      block += cell(rows[row].count > 0, rows[row].mean, 2);
    block += "\n";
  }
  block += "  as published, by sequence and object:\n" + formatted("  %-38s", "");
  for (const char* column : protocol.columns) block += formatted(" %8s", column);
  for (const Published& row : protocol.published) {
    block += formatted("\n  %-38s", row.method);
    for (const double figure : row.figures) block += cell(true, figure, 1);
  }
  return block + "\n";
}

std::string reference_line(const LogResult& result, const Figures& figures) {
  if (result.has_truth)
    return formatted("reference: exact, or labels; %d scans brought to another instant\n",
                     figures.num_interpolated);
  return formatted(
      "reference: registered, %d of them between two scans; uncertainty (mean sigma) of moving "
      "objects %.3f m, static %.3f m\n",
      figures.num_interpolated, figures.reference_moving_m.mean, figures.reference_standing_m.mean);
}

}  // namespace

std::string to_csv(const LogResult& result, const Figures& figures) {
  std::string csv = "row,figure,value\n";
  const auto line = [&](Row row, const std::string& name, double value) {
    csv += formatted("%s,%s,%.6g\n", name_of(row), name.c_str(), value);
  };
  const auto errors = [&](Row row, const std::string& name, const ErrorSummary& summary) {
    if (summary.count > 0) line(row, name, summary.mean);
  };
  for (const Row row : kRows) {
    if (result.labels[row])
      for (const auto& [name, value] : named_figures(label_figures(*result.labels[row])))
        line(row, name, value);
    const RowFigures& f = figures.rows[row];
    errors(row, "moving_objects_mean_m", f.moving.position_m);
    errors(row, "static_objects_mean_m", f.standing.position_m);
    errors(row, "moving_points_m", f.moving_points_m);
    errors(row, "static_scene_m", f.static_scene_m);
    errors(row, "chamfer_m", f.chamfer_m);
    errors(row, "chamfer_in_view_m", f.view_chamfer_m);
  }
  return csv;
}

std::string to_table(const LogResult& result, const Figures& figures,
                     const std::optional<Protocol>& protocol) {
  if (result.reference.empty() && result.labels[Row::ego]) {  // by labels alone
    std::string table = to_text(result.labels, result.num_unlabelled);
    for (const std::string& note : result.notes) table += "note: " + note + "\n";
    return table;
  }
  std::string table =
      formatted(
          "%s: %d virtual scans, %zu compared, %d left out: no withheld scan within %.0f ms\n",
          result.virtual_label.c_str(), result.num_virtual, result.scans.size(),
          result.num_unmatched, 1e3 * result.tolerance_s) +
      reference_line(result, figures) + to_text(result.labels, result.num_unlabelled);
  table += object_block("moving objects, position error", figures, &RowFigures::moving);
  table += object_block("static objects, position error", figures, &RowFigures::standing);
  for (const Binned& binned : figures.binned) table += bin_block(binned);
  table += scan_block("points of moving objects", figures, &RowFigures::moving_points_m);
  table += scan_block("static scene", figures, &RowFigures::static_scene_m);
  table += flow_block(figures);
  table += chamfer_block(figures);
  if (protocol) {
    table += protocol->measure == Protocol::Measure::trajectories
                 ? trajectory_block(figures, *protocol)
                 : sampled_block(figures, *protocol);
  }
  table += "\n";
  for (const auto& [reason, count] : figures.left_out)
    table += formatted("objects left out, %s: %d\n", reason.c_str(), count);
  for (const std::string& note : result.notes) table += "note: " + note + "\n";
  for (const std::string& figure : figures.beaten)
    table += "a baseline beats ours: " + figure + "\n";
  return table;
}

}  // namespace lidar_upsampling
