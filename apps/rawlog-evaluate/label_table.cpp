// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "label_table.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <set>

#include "text_table.h"

namespace lidar_upsampling {

namespace {

double rms(const std::vector<double>& values) {
  if (values.empty()) return 0;
  return std::sqrt(std::inner_product(values.begin(), values.end(), values.begin(), 0.) /
                   static_cast<double>(values.size()));
}

double mean_of(const std::vector<double>& values) { return summarize(values).mean; }

std::string mover_line(const std::string& name, const ErrorSummary& error,
                       const ErrorSummary& velocity, double velocity_rms) {
  if (error.count == 0) return {};
  return named(name) + formatted("%9d", error.count) + cell(true, error.mean) +
         cell(true, error.median) + cell(true, error.p95) + cell(true, velocity.mean, 2) +
         cell(true, velocity_rms, 2) + "\n";
}

std::string movers_block(const PerRow<std::optional<LabelFigures>>& rows, bool all) {
  std::string block = heading(all ? "labelled movers, error" : "those that a row tells of",
                              {"count", "mean m", "median m", "p95 m", "m/s", "rms m/s"});
  const std::size_t empty = block.size();
  for (const Row row : kRows)
    if (rows[row])
      block += all ? mover_line(name_of(row), rows[row]->movers_m, rows[row]->velocity_mps,
                                rows[row]->velocity_rms_mps)
                   : mover_line(name_of(row), rows[row]->found_m, rows[row]->found_velocity_mps,
                                rows[row]->found_velocity_rms_mps);
  return block.size() > empty ? block : std::string();
}

std::string false_block(const PerRow<std::optional<LabelFigures>>& rows) {
  std::string block =
      heading("told to move that do not, tracks",
              {"parked", "moved %", "shift m", "false/im", "shift m", "followed", "switches"});
  for (const Row row : kRows) {
    if (!rows[row]) continue;
    const LabelFigures& f = *rows[row];
    block +=
        named(name_of(row)) + formatted("%9d", f.num_parked) +
        (f.num_parked > 0
             ? cell(true, 100. * f.num_parked_told / f.num_parked, 0) + cell(true, f.parked_shift_m)
             : cell(false, 0) + cell(false, 0)) +
        cell(true, f.false_per_image, 2) + cell(true, f.false_shift_m) +
        (f.num_followed > 0 ? formatted("%9d", f.num_followed) + formatted("%9d", f.num_switches)
                            : cell(false, 0) + cell(false, 0)) +
        "\n";
  }
  return block;
}

std::string group_block(const std::string& key, const std::vector<LabelGroup>& groups) {
  if (groups.empty()) return {};
  std::string block = heading("labelled movers by " + key + ", mean m",
                              {"count", "ego", "const-v", "paper", "ours"});
  for (const LabelGroup& group : groups) {
    block += named(group.name) + formatted("%9d", group.count);
    for (const Row row : {Row::ego, Row::constant_velocity, Row::paper, Row::ours})
      block += group.mean_m[row] ? cell(true, *group.mean_m[row]) : cell(false, 0);
    block += "\n";
  }
  return block;
}

using Belongs = std::function<bool(const MoverSight&)>;

void add_group(const LabelScores& scores, const std::string& name, const Belongs& belongs,
               std::vector<LabelGroup>& groups) {
  LabelGroup group{name, 0, {}};
  for (const Row row : kRows) {
    if (!scores[row]) continue;
    std::vector<double> errors;
    for (const MoverSight& mover : scores[row]->movers)
      if (belongs(mover)) errors.push_back(mover.error_m);
    group.count = static_cast<int>(errors.size());
    if (!errors.empty()) group.mean_m[row] = mean_of(errors);
  }
  if (group.count > 0) groups.push_back(std::move(group));
}

std::vector<LabelGroup> binned_movers(const LabelScores& scores, const std::vector<double>& edges,
                                      const char* unit, double MoverSight::*key) {
  std::vector<LabelGroup> groups;
  for (std::size_t i = 0; i + 1 < edges.size(); ++i)
    add_group(
        scores, edges_of(edges[i], edges[i + 1], unit),
        [&](const MoverSight& m) { return m.*key >= edges[i] && m.*key < edges[i + 1]; }, groups);
  return groups;
}

}  // namespace

LabelFigures label_figures(const LabelScore& score) {
  LabelFigures figures;
  figures.num_images = score.num_images;
  std::vector<double> all, found, velocity, found_velocity, shifts;
  for (const MoverSight& mover : score.movers) {
    all.push_back(mover.error_m);
    velocity.push_back(mover.error_mps);
    if (!mover.found) continue;
    found.push_back(mover.error_m);
    found_velocity.push_back(mover.error_mps);
  }
  for (const ParkedSight& parked : score.parked) {
    ++figures.num_parked;
    figures.num_parked_told += parked.told_to_move ? 1 : 0;
    shifts.push_back(parked.shift_m);
  }
  figures.velocity_rms_mps = rms(velocity);
  figures.found_velocity_rms_mps = rms(found_velocity);
  figures.movers_m = summarize(std::move(all));
  figures.found_m = summarize(std::move(found));
  figures.velocity_mps = summarize(std::move(velocity));
  figures.found_velocity_mps = summarize(std::move(found_velocity));
  figures.parked_shift_m = mean_of(shifts);
  figures.false_per_image =
      static_cast<double>(score.false_shifts_m.size()) / std::max(1, score.num_images);
  figures.false_shift_m = mean_of(score.false_shifts_m);
  figures.num_followed = score.num_followed;
  figures.num_switches = score.num_switches;
  return figures;
}

std::map<std::string, std::vector<LabelGroup>> label_groups(const LabelScores& scores) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  std::map<std::string, std::vector<LabelGroup>> groups;
  groups["range"] = binned_movers(scores, range_edges(), "m", &MoverSight::range_m);
  groups["speed"] = binned_movers(scores, {1, 3, 7, 14, 25, kFar}, "m/s", &MoverSight::speed_mps);
  std::set<std::string> classes;
  for (const Row row : kRows)
    if (scores[row])
      for (const MoverSight& mover : scores[row]->movers) classes.insert(mover.class_name);
  for (const std::string& name : classes)
    add_group(
        scores, name, [&](const MoverSight& mover) { return mover.class_name == name; },
        groups["class"]);
  return groups;
}

std::string to_text(const LabelScores& scores, int num_unlabelled) {
  if (!scores[Row::ego]) return {};
  PerRow<std::optional<LabelFigures>> rows;
  for (const Row row : kRows)
    if (scores[row]) rows[row] = label_figures(*scores[row]);
  std::string text = "by labels: " + std::to_string(scores[Row::ego]->num_images) +
                     " virtual scans, " + std::to_string(num_unlabelled) +
                     " more beyond the labels or at a real scan\n";
  if (!rows[Row::ours]) text += "note: no row `ours` by labels without --report\n";
  text += movers_block(rows, true) + movers_block(rows, false) + false_block(rows);
  for (const auto& [key, groups] : label_groups(scores)) text += group_block(key, groups);
  return text + "\n";
}

std::vector<std::pair<std::string, double>> named_figures(const LabelFigures& f) {
  return {{"images", f.num_images},
          {"movers", f.movers_m.count},
          {"movers_mean_m", f.movers_m.mean},
          {"movers_median_m", f.movers_m.median},
          {"movers_p95_m", f.movers_m.p95},
          {"velocity_mean_m_s", f.velocity_mps.mean},
          {"velocity_rms_m_s", f.velocity_rms_mps},
          {"found", f.found_m.count},
          {"found_mean_m", f.found_m.mean},
          {"found_median_m", f.found_m.median},
          {"found_p95_m", f.found_m.p95},
          {"found_velocity_mean_m_s", f.found_velocity_mps.mean},
          {"found_velocity_rms_m_s", f.found_velocity_rms_mps},
          {"parked", f.num_parked},
          {"parked_told_to_move", f.num_parked_told},
          {"parked_shift_m", f.parked_shift_m},
          {"false_movers_per_image", f.false_per_image},
          {"false_mover_shift_m", f.false_shift_m},
          {"objects_followed", f.num_followed},
          {"identity_switches", f.num_switches}};
}

}  // namespace lidar_upsampling
