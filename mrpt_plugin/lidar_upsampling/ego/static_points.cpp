// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/ego/static_points.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace lidar_upsampling {

namespace {

constexpr int kColumns = 24, kRows = 8, kPerCell = 3;  // of the grid on the picture
constexpr double kObjectMargin_px = 8;                 // kept from points of object candidates
constexpr double kMinTexture = 1e-4;                   // smaller eigenvalue

void check(const StaticPointQuery& query) {
  const std::size_t size = query.points.size();
  if (query.is_unreliable.size() != size || query.is_candidate.size() != size) {
    throw std::invalid_argument("choose_static_points: " + std::to_string(size) + " points but " +
                                std::to_string(query.is_unreliable.size()) + " and " +
                                std::to_string(query.is_candidate.size()) + " flags");
  }
  if (query.texture.type() != CV_32FC1 || query.texture.size() != query.picture) {
    throw std::invalid_argument("choose_static_points: texture must be CV_32FC1, as the picture");
  }
}

/// Where candidates are, in squares of the margin: a point is near one if its square or one around
/// is taken.
class CandidateMap {
 public:
  explicit CandidateMap(const StaticPointQuery& query) {
    taken_ = cv::Mat1b::zeros(static_cast<int>(query.picture.height / kObjectMargin_px) + 3,
                              static_cast<int>(query.picture.width / kObjectMargin_px) + 3);
    for (std::size_t i = 0; i < query.points.size(); ++i) {
      if (query.is_candidate[i] != 0) {
        const cv::Point square = square_of(query.points[i]);
        taken_(cv::Rect(square.x - 1, square.y - 1, 3, 3)) = 1;
      }
    }
  }
  [[nodiscard]] bool near(const ProjectedPoint& point) const {
    return taken_(square_of(point)) != 0;
  }

 private:
  [[nodiscard]] cv::Point square_of(const ProjectedPoint& point) const {
    const auto square = [](float x, int size) {
      return std::clamp(static_cast<int>(x / kObjectMargin_px) + 1, 1, size - 2);
    };
    return {square(point.u, taken_.cols), square(point.v, taken_.rows)};
  }

  cv::Mat1b taken_;
};

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
  const CandidateMap candidates(query);
  const double width = static_cast<double>(query.picture.width) / kColumns;
  const double height = static_cast<double>(query.picture.height) / kRows;
  std::vector<std::vector<Scored>> cells(static_cast<std::size_t>(kColumns) * kRows);
  for (std::size_t i = 0; i < query.points.size(); ++i) {
    const ProjectedPoint& point = query.points[i];
    const int column = static_cast<int>(std::floor(point.u / width));
    const int row = static_cast<int>(std::floor(point.v / height));
    if (query.is_unreliable[i] != 0 || column < 0 || column >= kColumns || row < 0 ||
        row >= kRows || candidates.near(point)) {
      continue;
    }
    const double score = texture_at(query, point);
    if (score >= kMinTexture) {
      cells[static_cast<std::size_t>(row) * kColumns + column].push_back(
          {static_cast<int>(i), score});
    }
  }
  for (auto& cell : cells) {
    std::stable_sort(cell.begin(), cell.end(),
                     [](const Scored& a, const Scored& b) { return a.score > b.score; });
  }
  return cells;
}

/// The best points of a cell that do not share their patch of the picture.
std::vector<int> spread_out(const std::vector<Scored>& cell, const StaticPointQuery& query) {
  constexpr float kPatch = 10;
  std::vector<int> chosen;
  for (const Scored& candidate : cell) {
    const ProjectedPoint& point = query.points[candidate.index];
    const bool crowded = std::any_of(chosen.begin(), chosen.end(), [&](int i) {
      return std::abs(query.points[i].u - point.u) < kPatch &&
             std::abs(query.points[i].v - point.v) < kPatch;
    });
    if (!crowded) {
      chosen.push_back(candidate.index);
    }
    if (static_cast<int>(chosen.size()) == kPerCell) {
      break;
    }
  }
  return chosen;
}

}  // namespace

std::vector<int> choose_static_points(const StaticPointQuery& query,
                                      const StaticPointOptions& options) {
  check(query);
  std::vector<std::vector<int>> cells;
  for (const auto& cell : sorted_cells(query)) {
    cells.push_back(spread_out(cell, query));
  }
  // Round by round, so that the cap takes from the crowded cells first.
  std::vector<int> chosen;
  for (int round = 0; round < kPerCell; ++round) {
    for (const auto& cell : cells) {
      if (round < static_cast<int>(cell.size()) &&
          static_cast<int>(chosen.size()) < options.max_points) {
        chosen.push_back(cell[round]);
      }
    }
  }
  return chosen;
}

}  // namespace lidar_upsampling
