// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "tracks.h"

#include <algorithm>
#include <array>

#include "html.h"

namespace lidar_upsampling {

namespace {

constexpr std::size_t kMaxCurves = 12;
constexpr std::size_t kMaxLines = 40;
constexpr int kLeastSamples = 2;  // one makes no curve

/// The longest followed first; those that never moved last.
std::vector<TrackFigures> ordered(std::vector<TrackFigures> tracks) {
  std::stable_sort(tracks.begin(), tracks.end(), [](const auto& a, const auto& b) {
    const bool a_moves = a.num_moving > 0, b_moves = b.num_moving > 0;
    return a_moves != b_moves ? a_moves : a.num_images > b.num_images;
  });
  return tracks;
}

HtmlTable status_table(const RunReport& report) {
  HtmlTable table{"What became of the objects", {"objects × images", "share %"}, {}, ""};
  int sum = 0;
  for (const auto& [status, count] : report.object_status) sum += count;
  for (const auto& [status, count] : report.object_status) {
    std::string name = status;
    std::replace(name.begin(), name.end(), '_', ' ');
    table.rows.push_back(
        {name, {count_cell(count), plain_cell(true, 100. * count / sum, 0)}, "", "", false});
  }
  return table;
}

HtmlTable track_table(const std::vector<TrackFigures>& tracks) {
  HtmlTable table{
      "Tracks",
      {"class", "images", "moving", "mean speed m/s", "last speed m/s"},
      {},
      "images: at which the object was met; moving: of them, those where it was moved by "
      "a motion of its own; speeds over ground, where it moved."};
  for (std::size_t i = 0; i < std::min(tracks.size(), kMaxLines); ++i) {
    const TrackFigures& track = tracks[i];
    const bool moves = track.num_moving > 0;
    table.rows.push_back(
        {"track " + std::to_string(track.id),
         {text_cell(track.class_name), count_cell(track.num_images), count_cell(track.num_moving),
          plain_cell(moves, track.mean_speed, 1), plain_cell(moves, track.last_speed, 1)},
         "",
         "",
         false});
  }
  if (tracks.size() > kMaxLines)
    table.note = "The first " + std::to_string(kMaxLines) + " of " + std::to_string(tracks.size()) +
                 " tracks. " + table.note;
  return table;
}

}  // namespace

std::optional<Plot> speed_plot(const RunReport& report) {
  constexpr std::array<const char*, 6> kColors{"#0072b2", "#d55e00", "#009e73",
                                               "#cc79a7", "#e69f00", "#56b4e9"};
  Plot plot;
  plot.caption = "Speed over ground of the moving objects followed longest";
  plot.kind = Plot::Kind::marked_lines;
  plot.x.label = "time since the first object, s";
  plot.y.label = "speed, m/s";
  double fastest = 1;
  for (const TrackFigures& track : ordered(report.tracks)) {
    if (track.num_moving < kLeastSamples) continue;
    if (plot.series.size() == kMaxCurves) break;
    const std::size_t number = plot.series.size();
    Series series{"track " + std::to_string(track.id),
                  kColors.at(number % kColors.size()),
                  static_cast<int>(number % kColors.size() + number / kColors.size()),
                  false,
                  {}};
    for (const TrackFigures::Sample& sample : track.speeds) {
      series.points.push_back({sample.time_s, sample.speed, 0, 0});
      fastest = std::max(fastest, sample.speed);
    }
    plot.series.push_back(std::move(series));
  }
  if (plot.series.empty()) return {};
  plot.y.to = 1.1 * fastest;
  return plot;
}

std::string tracks_html(const RunReport& report, const std::string& speeds) {
  const std::vector<TrackFigures> tracks = ordered(report.tracks);
  const auto num_moving = std::count_if(tracks.begin(), tracks.end(),
                                        [](const auto& track) { return track.num_moving > 0; });
  std::string html = paragraph(std::to_string(tracks.size()) + " tracks, of them " +
                               std::to_string(num_moving) + " moving at one image at least.");
  if (tracks.empty()) return html;
  std::string left = to_html(status_table(report));
  if (!speeds.empty())
    left = figure(speeds, "Speed over ground of the moving objects followed longest") + left;
  return html + side_by_side({"<div>" + left + "</div>", to_html(track_table(tracks))});
}

}  // namespace lidar_upsampling
