// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "page.h"

#include <filesystem>

#include "error_plots.h"
#include "error_tables.h"
#include "html.h"
#include "label_tables.h"
#include "running_time.h"
#include "tracks.h"

namespace lidar_upsampling {

namespace {

std::string name_of_file(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

/// Drawn all at once, so that gnuplot starts once.
struct DrawnPlots {
  std::vector<std::string> binned, distributions;
  std::string gaps, speeds;
};

std::string as_figure(const Plot& plot, const std::string& picture) {
  return figure(picture, plot.caption);
}

DrawnPlots draw_plots(const PageContent& content) {
  const auto& comparison = content.comparison;
  const auto distributions =
      comparison ? distribution_plots(comparison->result) : std::vector<Plot>();
  const auto binned = comparison ? binned_plots(comparison->figures) : std::vector<Plot>();
  const auto speeds = content.run ? speed_plot(*content.run) : std::nullopt;
  const Plot gaps = gap_plot(content.coverage);

  std::vector<Plot> all = distributions;
  all.insert(all.end(), binned.begin(), binned.end());
  if (speeds) all.push_back(*speeds);
  if (!gaps.series.empty()) all.push_back(gaps);
  std::vector<std::string> pictures = render_plots(all);

  DrawnPlots drawn;
  auto next = pictures.begin();
  for (const Plot& plot : distributions) drawn.distributions.push_back(as_figure(plot, *next++));
  for (const Plot& plot : binned) drawn.binned.push_back(as_figure(plot, *next++));
  if (speeds) drawn.speeds = *next++;
  if (!gaps.series.empty()) drawn.gaps = *next++;
  return drawn;
}

std::string blocks_of(const std::vector<HtmlTable>& tables) {
  std::vector<std::string> blocks;
  blocks.reserve(tables.size());
  for (const HtmlTable& table : tables) blocks.push_back(to_html(table));
  return side_by_side(blocks);
}

std::string rows_html() {
  return paragraph(
      "The rows: hold copies the key scan, the last real one; ego moves it by the vehicle's "
      "motion; constant-velocity "
      "also moves objects on as between the last two scans; paper is P3P on the picture for each "
      "object, as published; ours is the virtual scan in the log; oracle is the reference motion "
      "itself; floor, in some protocols, is the reference scan sampled twice, which no estimate "
      "beats. Less is better; the least of hold to ours is underlined.",
      "note");
}

std::string left_out_html(const Comparison& comparison) {
  std::string html;
  std::string reasons;
  for (const auto& [reason, count] : comparison.figures.left_out) {
    std::string name = reason;
    for (char& c : name)
      if (c == '_') c = ' ';
    reasons += (reasons.empty() ? "" : ", ") + name + " " + std::to_string(count);
  }
  if (!reasons.empty()) html += paragraph("Objects left out: " + reasons + ".", "note");
  for (const std::string& note : comparison.result.notes)
    html += paragraph("Note: " + note, "note");
  return html;
}

void add_comparison(const Comparison& comparison, const DrawnPlots& plots,
                    std::vector<Section>& sections) {
  const Figures& figures = comparison.figures;
  const auto by_labels = label_tables(comparison.result.labels);
  if (!by_labels.empty()) sections.push_back({"labels", "By labels", blocks_of(by_labels)});
  if (comparison.result.scans.empty()) return;
  sections.push_back({"objects", "Errors of objects",
                      (by_labels.empty() ? "" : paragraph(headline(figures))) +
                          blocks_of(object_tables(figures)) + rows_html() +
                          left_out_html(comparison)});
  sections.push_back({"distribution", "Distribution of position errors",
                      plots.distributions.empty() ? paragraph("No object could be compared.")
                                                  : side_by_side(plots.distributions)});
  sections.push_back(
      {"conditions", "Errors by horizon, range and number of points",
       paragraph("Median and quartiles over objects; errors below 1 mm are drawn at 1 mm.",
                 "note") +
           side_by_side(plots.binned) + blocks_of(binned_tables(figures))});
  sections.push_back({"scans", "Whole scans", blocks_of(scan_tables(figures))});
  if (comparison.protocol) {
    const auto tables = protocol_tables(figures, *comparison.protocol);
    if (!tables.empty())
      sections.push_back({"protocol", "The paper's protocol", blocks_of(tables)});
  }
  sections.push_back(
      {"worst", "Worst objects",
       worst_objects_html(comparison.worst.found(), comparison.result.scans.first_key_stamp())});
}

std::string fact(const std::string& name, const std::string& text) {
  return text.empty() ? "" : "<dt>" + escaped(name) + "</dt><dd>" + escaped(text) + "</dd>\n";
}

std::string compared_text(const LogResult& result) {
  return std::to_string(result.scans.size()) + " of " + std::to_string(result.num_virtual) +
         " virtual scans" +
         (result.num_unmatched > 0
              ? " (" + std::to_string(result.num_unmatched) + " without a withheld scan near)"
              : "");
}

std::string facts_html(const PageContent& content) {
  std::string html = "<dl class=\"facts\">\n" + fact("densified log", content.input);
  if (const auto& comparison = content.comparison) {
    const LogResult& result = comparison->result;
    html += fact("reference", result.reference.empty() ? "labels alone"
                              : result.has_truth
                                  ? result.reference + ", with true or labelled objects"
                                  : result.reference + ", by registration of objects to its scans");
    html += fact("compared", compared_text(result));
    html += fact("protocol", result.protocol);
  } else {
    html += fact("reference", "none: what follows tells of coverage, not of accuracy");
  }
  if (const auto& run = content.run) {
    html += fact("report", run->path);
    html += fact("ego-motion", run->ego_motion);
    html += fact("object candidates", run->detector);
  }
  return html + "</dl>\n";
}

std::string beaten_html(const Figures& figures) {
  if (figures.beaten.empty()) return {};
  std::string html = "<div class=\"beaten\">A baseline beats ours:<ul>\n";
  for (const std::string& figure : figures.beaten) html += "<li>" + escaped(figure) + "</li>\n";
  return html + "</ul></div>\n";
}

std::string warnings_html(const RunReport& run) {
  std::string html;
  for (const auto& [warning, count] : run.warnings)
    html += paragraph("Warning (" + std::to_string(count) + " times): " + warning, "note");
  return html;
}

std::string coverage_headline(const Coverage& coverage) {
  return std::to_string(coverage.virtual_scans.stamps.size()) + " virtual scans raise " +
         std::to_string(coverage.real.stamps.size()) + " real ones from " +
         fixed(coverage.real.rate_hz, 1) + " Hz to " + fixed(coverage.both.rate_hz, 1) + " Hz.";
}

}  // namespace

std::string headline(const Figures& figures) {
  const ErrorSummary& ours = figures.rows[Row::ours].moving.position_m;
  if (ours.count == 0) return "No moving object could be compared.";
  const ErrorSummary* best = nullptr;
  const char* name = "";
  for (const Row row : {Row::hold, Row::ego, Row::constant_velocity, Row::paper}) {
    const ErrorSummary& errors = figures.rows[row].moving.position_m;
    if (errors.count == 0 || (best != nullptr && errors.mean >= best->mean)) continue;
    best = &errors;
    name = name_of(row);
  }
  const std::string start = "Moving objects: mean position error " + fixed(ours.mean, 3) +
                            " m with ours (" + std::to_string(ours.count) + " objects)";
  if (best == nullptr) return start + ".";
  const std::string rival = std::string(name) + " (" + fixed(best->mean, 3) + " m)";
  if (best->mean < ours.mean) return start + "; a baseline beats it: " + rival + ".";
  return start + ", " + fixed(100 * (1 - ours.mean / best->mean), 0) +
         " % less than the best baseline, " + rival + ".";
}

std::string to_page(const PageContent& content) {
  const DrawnPlots plots = draw_plots(content);
  std::string header = facts_html(content);
  std::vector<Section> sections;
  if (const auto& comparison = content.comparison) {
    const std::string by_labels = label_headline(comparison->result.labels);
    // One measure leads: where labels tell of all movers, that by registration comes with its
    // table.
    if (!by_labels.empty())
      header += paragraph(by_labels, "headline");
    else if (!comparison->result.scans.empty())
      header += paragraph(headline(comparison->figures), "headline");
    header += beaten_html(comparison->figures);
    add_comparison(*comparison, plots, sections);
  } else {
    header += paragraph(coverage_headline(content.coverage), "headline");
  }
  sections.push_back({"coverage", "Coverage", coverage_html(content.coverage, plots.gaps)});
  if (content.run) {
    sections.push_back({"tracks", "Tracks and velocities",
                        tracks_html(*content.run, plots.speeds) + warnings_html(*content.run)});
    sections.push_back({"time", "Running time", running_time_html(*content.run)});
  } else {
    header += paragraph("Tracks, velocities and running times come with --report.", "note");
  }
  return html_document("Virtual scans of " + name_of_file(content.input), header, sections);
}

}  // namespace lidar_upsampling
