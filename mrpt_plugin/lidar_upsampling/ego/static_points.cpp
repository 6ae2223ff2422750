// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/ego/static_points.h"

#include <algorithm>
#include <cmath>

namespace lidar_upsampling {

namespace {

constexpr int kColumns = 24, kRows = 8;  // of the grid on the picture
constexpr std::size_t kPerCell = 3;
constexpr double kObjectMargin_px = 8;  // kept from points of object candidates
constexpr double kMinTexture = 1e-4;    // smaller eigenvalue

/// The square of the margin's size that a point is in; there is one more around the picture.
cv::Point square_of(const ProjectedPoint& point, const cv::Mat1b& squares) {
  const auto at = [](float x, int size) {
    return std::clamp(static_cast<int>(x / kObjectMargin_px) + 1, 1, size - 2);
  };
  return {at(point.u, squares.cols), at(point.v, squares.rows)};
}

/// The squares that candidates are in, and those around them.
cv::Mat1b squares_of_candidates(const StaticPointQuery& query) {
  cv::Mat1b taken = cv::Mat1b::zeros(static_cast<int>(query.picture.height / kObjectMargin_px) + 3,
                                     static_cast<int>(query.picture.width / kObjectMargin_px) + 3);
  for (std::size_t i = 0; i < query.points.size(); ++i) {
    if (query.is_candidate[i] == 0) continue;
    const cv::Point square = square_of(query.points[i], taken);
    taken(cv::Rect(square.x - 1, square.y - 1, 3, 3)) = 1;
  }
  return taken;
}

struct Scored {
  int index;
  double score;
};

double texture_at(const StaticPointQuery& query, const ProjectedPoint& point) {
  const int u = std::clamp(cvRound(point.u), 0, query.picture.width - 1);
  const int v = std::clamp(cvRound(point.v), 0, query.picture.height - 1);
  return query.texture.at<float>(v, u);
}

/// The usable points of each cell, the best first.
std::vector<std::vector<Scored>> sorted_cells(const StaticPointQuery& query) {
  const cv::Mat1b candidates = squares_of_candidates(query);
  const double width = static_cast<double>(query.picture.width) / kColumns;
  const double height = static_cast<double>(query.picture.height) / kRows;
  std::vector<std::vector<Scored>> cells(static_cast<std::size_t>(kColumns) * kRows);
  for (std::size_t i = 0; i < query.points.size(); ++i) {
    const ProjectedPoint& point = query.points[i];
    const cv::Point cell(cvFloor(point.u / width), cvFloor(point.v / height));
    const double score = texture_at(query, point);
    if (query.is_unreliable[i] == 0 && cell.inside({0, 0, kColumns, kRows}) &&
        candidates(square_of(point, candidates)) == 0 && score >= kMinTexture)
      cells[cell.y * kColumns + cell.x].push_back({static_cast<int>(i), score});
  }
  for (auto& cell : cells)
    std::stable_sort(cell.begin(), cell.end(),
                     [](const Scored& a, const Scored& b) { return a.score > b.score; });
  return cells;
}

/// The best points of a cell that do not share their patch of the picture.
std::vector<int> spread_out(const std::vector<Scored>& cell, const StaticPointQuery& query) {
  constexpr float kPatch = 10;
  std::vector<int> chosen;
  for (const Scored& candidate : cell) {
    if (chosen.size() == kPerCell) break;
    const ProjectedPoint& point = query.points[candidate.index];
    const bool crowded = std::any_of(chosen.begin(), chosen.end(), [&](int i) {
      return std::abs(query.points[i].u - point.u) < kPatch &&
             std::abs(query.points[i].v - point.v) < kPatch;
    });
    if (!crowded) chosen.push_back(candidate.index);
  }
  return chosen;
}

}  // namespace

std::vector<int> choose_static_points(const StaticPointQuery& query,
                                      const StaticPointOptions& options) {
  std::vector<std::vector<int>> cells;
  for (const auto& cell : sorted_cells(query)) cells.push_back(spread_out(cell, query));
  // Round by round, so that the cap takes from the crowded cells first.
  std::vector<int> chosen;
  for (std::size_t round = 0; round < kPerCell; ++round)
    for (const auto& cell : cells)
      if (round < cell.size() && static_cast<int>(chosen.size()) < options.max_points)
        chosen.push_back(cell[round]);
  return chosen;
}

}  // namespace lidar_upsampling
