// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "coverage.h"

#include <algorithm>
#include <iterator>
#include <limits>

#include "lidar_upsampling/metrics/summary.h"
#include "palette.h"

namespace lidar_upsampling {

namespace {

std::vector<double> gaps_of(const std::vector<Stamp>& stamps) {
  std::vector<double> gaps;
  for (std::size_t i = 1; i < stamps.size(); ++i)
    gaps.push_back(seconds_between(stamps[i - 1], stamps[i]));
  return gaps;
}

StreamCoverage coverage_of(std::string name, std::vector<Stamp> stamps) {
  std::sort(stamps.begin(), stamps.end());
  StreamCoverage coverage;
  coverage.name = std::move(name);
  coverage.stamps = std::move(stamps);
  std::vector<double> gaps = gaps_of(coverage.stamps);
  if (gaps.empty()) return coverage;
  const double span = seconds_between(coverage.stamps.front(), coverage.stamps.back());
  coverage.longest_gap_s = *std::max_element(gaps.begin(), gaps.end());
  coverage.median_gap_s = summarize(std::move(gaps)).median;
  if (span > 0) coverage.rate_hz = static_cast<double>(coverage.stamps.size() - 1) / span;
  return coverage;
}

/// How far the nearest of them is, s.
double to_nearest(const std::vector<Stamp>& stamps, Stamp stamp) {
  const auto next = std::lower_bound(stamps.begin(), stamps.end(), stamp);
  double distance = std::numeric_limits<double>::infinity();
  if (next != stamps.end()) distance = seconds_between(stamp, *next);
  if (next != stamps.begin())
    distance = std::min(distance, seconds_between(*std::prev(next), stamp));
  return distance;
}

Series gap_series(const char* name, const std::string& color, int style, const StreamCoverage& c,
                  Stamp start) {
  Series series{name, color, style, false, {}};
  for (std::size_t i = 1; i < c.stamps.size(); ++i)
    series.points.push_back({seconds_between(start, c.stamps[i]),
                             1e3 * seconds_between(c.stamps[i - 1], c.stamps[i]), 0, 0});
  return series;
}

HtmlTable streams_table(const Coverage& coverage) {
  HtmlTable table{"Scans", {"count", "rate Hz", "median gap ms", "longest gap ms"}, {}, ""};
  for (const StreamCoverage* stream : {&coverage.real, &coverage.virtual_scans, &coverage.both}) {
    const bool known = stream->stamps.size() > 1;
    table.rows.push_back(
        {stream->name,
         {count_cell(static_cast<double>(stream->stamps.size())),
          plain_cell(known, stream->rate_hz, 2), plain_cell(known, 1e3 * stream->median_gap_s, 0),
          plain_cell(known, 1e3 * stream->longest_gap_s, 0)},
         "",
         stream == &coverage.both ? "ours" : "",
         false});
  }
  return table;
}

HtmlTable cameras_table(const Coverage& coverage) {
  HtmlTable table{
      "Images",
      {"count", "with virtual scan", "with real scan", "with neither", "covered %"},
      {},
      "An image has no virtual scan where a real one was taken at its instant, before the "
      "first real scan, or where the last real scan is too old."};
  for (const CameraCoverage& camera : coverage.cameras) {
    const int covered = camera.num_with_virtual + camera.num_with_real;
    table.rows.push_back(
        {camera.label,
         {count_cell(camera.num_images), count_cell(camera.num_with_virtual),
          count_cell(camera.num_with_real), count_cell(camera.num_images - covered),
          plain_cell(camera.num_images > 0, 100. * covered / std::max(1, camera.num_images), 0)},
         "",
         "",
         false});
  }
  return table;
}

}  // namespace

Coverage measure_coverage(const LogIndex& index, const ScanLabels& labels, double tolerance_s) {
  const auto stamps_of = [&](const std::string& label) {
    return index.find(label, StreamKind::lidar)->stamps;
  };
  Coverage coverage;
  coverage.real = coverage_of("real scans, " + labels.real, stamps_of(labels.real));
  coverage.virtual_scans = coverage_of("virtual scans, " + labels.dense, stamps_of(labels.dense));
  std::vector<Stamp> both = coverage.real.stamps;
  both.insert(both.end(), coverage.virtual_scans.stamps.begin(),
              coverage.virtual_scans.stamps.end());
  coverage.both = coverage_of("real and virtual together", std::move(both));
  for (const StreamInfo* camera : index.of_kind(StreamKind::camera)) {
    CameraCoverage figures{camera->label, 0, 0, 0};
    for (const Stamp stamp : camera->stamps) {
      ++figures.num_images;
      const double to_virtual = to_nearest(coverage.virtual_scans.stamps, stamp);
      const double to_real = to_nearest(coverage.real.stamps, stamp);
      if (std::min(to_virtual, to_real) > tolerance_s) continue;
      ++(to_virtual <= to_real ? figures.num_with_virtual : figures.num_with_real);
    }
    coverage.cameras.push_back(std::move(figures));
  }
  return coverage;
}

Plot gap_plot(const Coverage& coverage) {
  Plot plot;
  plot.caption = "Time from each scan to the next";
  plot.kind = Plot::Kind::marked_lines;
  plot.x.label = "time since the first scan, s";
  plot.y.label = "gap, ms";
  const Stamp start = coverage.both.stamps.front();
  double longest = 0;
  for (const StreamCoverage* stream : {&coverage.real, &coverage.both})
    longest = std::max(longest, 1e3 * stream->longest_gap_s);
  plot.y.to = 1.15 * longest;
  for (Series series :
       {gap_series("real scans", color_of(Row::hold), 1, coverage.real, start),
        gap_series("real and virtual", color_of(Row::ours), 0, coverage.both, start)})
    if (!series.points.empty()) plot.series.push_back(std::move(series));
  return plot;
}

std::string coverage_html(const Coverage& coverage, const std::string& gaps) {
  std::string tables =
      "<div>" + to_html(streams_table(coverage)) + to_html(cameras_table(coverage)) + "</div>";
  if (gaps.empty()) return tables;
  return side_by_side({tables, figure(gaps, "Time from each scan to the next")});
}

}  // namespace lidar_upsampling
