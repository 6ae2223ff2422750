// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "running_time.h"

#include <algorithm>

#include "html.h"
#include "text_table.h"

namespace lidar_upsampling {

namespace {

struct Component {
  const char* name;
  const char* color;
  double published;
  std::vector<const char*> stages;
};

const std::vector<Component>& components() {
  static const std::vector<Component> kComponents{
      {"object detector and tracker", "#0072b2", 27, {"ground and clusters", "candidates"}},
      {"points and KLT", "#56b4e9", 19, {"image pyramid", "point tracking"}},
      {"pose", "#e69f00", 16, {"ego-motion", "object motion", "scan registration"}},
      {"composition", "#009e73", 0, {"composition", "beams", "resampling"}}};
  return kComponents;
}

constexpr double kPublishedTotal = 62;
const char* const kNote =
    "* as published by Rozsa & Sziranyi (2023): KITTI, other machine, Matlab, detector on a GPU; "
    "the other methods on their own machines, for half as many points.";

bool names(const std::vector<const char*>& stages, const std::string& stage) {
  return std::any_of(stages.begin(), stages.end(), [&](const char* name) { return stage == name; });
}

double sum_of(const RunReport& report, const std::vector<const char*>& stages) {
  double sum = 0;
  for (const StageFigures& stage : report.stages)
    if (names(stages, stage.name)) sum += stage.total_ms;
  return sum / report.num_virtual;
}

/// Of stages that no component knows.
double rest_of(const RunReport& report) {
  double sum = 0;
  for (const StageFigures& stage : report.stages) {
    const bool known = names({"reading", "packing", "writing"}, stage.name) ||
                       std::any_of(components().begin(), components().end(),
                                   [&](const Component& c) { return names(c.stages, stage.name); });
    if (!known) sum += stage.total_ms;
  }
  return sum / report.num_virtual;
}

std::string bar_html(const std::string& name, const std::vector<double>& parts, double longest) {
  double sum = 0;
  std::string html = "<div class=\"bar\"><span>" + escaped(name) + "</span><div>";
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Component& component = components()[i];
    html += "<i title=\"" + std::string(component.name) + " " + fixed(parts[i], 1) +
            " ms\" style=\"width:" + fixed(100 * parts[i] / longest, 2) +
            "%;background:" + component.color + "\"></i>";
    sum += parts[i];
  }
  return html + "</div><b>" + fixed(sum, 0) + " ms</b></div>\n";
}

std::string bars_html(const RunningTime& time) {
  std::vector<double> ours, paper;
  double sum_ours = 0;
  for (std::size_t i = 0; i < components().size(); ++i) {
    ours.push_back(time.components[i].ms);
    sum_ours += ours.back();
    paper.push_back(components()[i].published);
  }
  const double longest = std::max({sum_ours, kPublishedTotal, 1.});
  return "<div class=\"bars\">" + bar_html("ours", ours, longest) +
         bar_html("paper *", paper, longest) + "</div>\n";
}

HtmlTable components_table(const RunningTime& time) {
  HtmlTable table{"Running time per virtual scan", {"ours ms", "paper * ms"}, {}, kNote};
  for (std::size_t i = 0; i < time.components.size(); ++i) {
    const TimedComponent& component = time.components[i];
    const bool is_sum = i + 1 == time.components.size();
    const std::string color = i < components().size() ? components()[i].color : "";
    table.rows.push_back(
        {component.name,
         {plain_cell(true, component.ms, 1),
          plain_cell(component.published.has_value(), component.published.value_or(0), 0)},
         color,
         is_sum ? "sum" : "",
         false});
  }
  for (const PublishedTime& other : time.others)
    table.rows.push_back({std::string(other.method) + " *",
                          {text_cell("–"), plain_cell(true, other.ms, 0)},
                          "",
                          "published",
                          false});
  for (const TimedComponent& part : time.log)
    table.rows.push_back(
        {part.name, {plain_cell(true, part.ms, 1), text_cell("–")}, "", "bound", false});
  return table;
}

HtmlTable stages_table(const RunReport& report) {
  HtmlTable table{"Stages of rawlog-densify",
                  {"runs", "median ms", "p95 ms", "total s"},
                  {},
                  "Stages of a real scan run once for each; reading, packing and writing once for "
                  "each entry of the log."};
  for (const StageFigures& stage : report.stages)
    table.rows.push_back(
        {stage.name,
         {count_cell(stage.runs), plain_cell(true, stage.median_ms, 1),
          plain_cell(true, stage.p95_ms, 1), plain_cell(true, 1e-3 * stage.total_ms, 2)},
         "",
         "",
         false});
  return table;
}

std::string line_of(const std::string& name, double ours, std::optional<double> published) {
  return named(name) + cell(true, ours, 1) + (published ? formatted("%12.0f", *published) : "") +
         "\n";
}

std::string load_note(const RunReport& report) {
  constexpr double kOwn = 1.5;  // of the cores, as reading and packing have threads of their own
  if (report.load <= kOwn * report.cores) return {};
  return "Other work shared the machine: its load was " + fixed(report.load, 1) + " on " +
         std::to_string(report.cores) +
         " cores, so that each stage took longer than it does alone.";
}

}  // namespace

RunningTime running_time_of(const RunReport& report) {
  RunningTime time;
  if (report.num_virtual == 0) return time;
  double total = 0;
  const auto add = [&](const char* name, double ms, std::optional<double> published) {
    time.components.push_back({name, ms, published});
    total += ms;
  };
  for (const Component& component : components())
    add(component.name, sum_of(report, component.stages), component.published);
  if (const double rest = rest_of(report); rest > 0) add("other", rest, {});
  time.components.push_back({"total", total, kPublishedTotal});
  time.log = {{"reading the log", sum_of(report, {"reading"}), {}},
              {"packing virtual scans", sum_of(report, {"packing"}), {}},
              {"writing the log, real entries too", sum_of(report, {"writing"}), {}}};
  time.others = {{"PointINet", 726}, {"MoNet (GRU)", 56}};
  return time;
}

std::string to_text(const RunningTime& time) {
  if (time.components.empty()) return {};
  std::string text = "\nrunning time per virtual scan, ms             ours  published *\n";
  for (const TimedComponent& component : time.components)
    text += line_of(component.name, component.ms, component.published);
  for (const TimedComponent& part : time.log) text += line_of(part.name, part.ms, {});
  for (const PublishedTime& other : time.others)
    text += named(std::string(other.method) + ", total") + cell(false, 0) +
            formatted("%12.0f\n", other.ms);
  return text + "  " + kNote + "\n";
}

std::string running_time_html(const RunReport& report) {
  const RunningTime time = running_time_of(report);
  if (time.components.empty()) return paragraph("There are no virtual scans to time.");
  const std::string note = load_note(report);
  return (note.empty() ? "" : paragraph(note)) + bars_html(time) +
         side_by_side({to_html(components_table(time)), to_html(stages_table(report))});
}

}  // namespace lidar_upsampling
