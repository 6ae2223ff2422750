// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/registration/seen_space.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "lidar_upsampling/azimuth.h"
#include "lidar_upsampling/units.h"

namespace lidar_upsampling {
namespace {

constexpr float kHighest = static_cast<float>(45 * kDegree);
constexpr int kColumns = 720;      // wider than any spinning LiDAR's step
constexpr double kRoom = 1.2;      // so that no row lies between two rings
constexpr float kMargin_m = 0.5F;  // surfaces are inclined, and objects have depth
constexpr double kBlind_deg = 10;  // no beam for as long: the sensor does not look there

/// Whether each column of a circle is empty, and so are at least as many in a row.
std::vector<bool> in_long_runs(const std::vector<bool>& empty, int least) {
  const int size = static_cast<int>(empty.size());
  std::vector<bool> result(size, false);
  const auto first_beam = std::find(empty.begin(), empty.end(), false) - empty.begin();
  if (first_beam == size) return result;
  int run = 0;
  for (int i = 1; i <= size; ++i) {
    const int column = (static_cast<int>(first_beam) + i) % size;
    if (empty[column]) {
      ++run;
      continue;
    }
    for (int back = 1; run >= least && back <= run; ++back)
      result[(column - back + size) % size] = true;
    run = 0;
  }
  return result;
}

}  // namespace

SeenSpace::SeenSpace(const std::vector<Eigen::Vector3f>& points, double vertical_step_deg)
    : per_row_(static_cast<float>(1 / (kRoom * std::max(0.2, vertical_step_deg) * kDegree))),
      per_column_(kColumns / kTurn),
      rows_(static_cast<int>(2 * kHighest * per_row_) + 1),
      columns_(kColumns),
      cells_(static_cast<std::size_t>(rows_) * columns_,
             Reach{std::numeric_limits<float>::infinity(), 0}) {
  struct Beam {
    int cell;  // negative: none
    float range;
  };
  std::vector<Beam> beams(points.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), 4096), [&](const auto& some) {
    for (std::size_t i = some.begin(); i < some.end(); ++i) {
      const int row = row_of(points[i]);
      beams[i] = {row < 0 ? -1 : row * columns_ + column_of(points[i]), points[i].norm()};
    }
  });
  for (const Beam& beam : beams) {
    if (beam.cell < 0) continue;
    Reach& cell = cells_[beam.cell];
    cell.nearest = std::min(cell.nearest, beam.range);
    cell.farthest = std::max(cell.farthest, beam.range);
  }
  std::vector<bool> is_empty(columns_, true);
  for (const Beam& beam : beams)
    if (beam.cell >= 0) is_empty[beam.cell % columns_] = false;
  is_out_of_view_ = in_long_runs(is_empty, static_cast<int>(kColumns * kBlind_deg / 360));
}

int SeenSpace::row_of(const Eigen::Vector3f& place) const {
  const float elevation = elevation_of(place.head<2>().norm(), place.z());
  return std::abs(elevation) >= kHighest ? -1 : static_cast<int>((elevation + kHighest) * per_row_);
}

int SeenSpace::column_of(const Eigen::Vector3f& place) const {
  return std::min(columns_ - 1, static_cast<int>(azimuth_of(place.x(), place.y()) * per_column_));
}

Sight SeenSpace::at(const Eigen::Vector3f& place) const {
  const int row = row_of(place);
  if (row < 0) return Sight::open;
  const int column = column_of(place);
  if (is_out_of_view_[column]) return Sight::hidden;
  const float range = place.norm();
  int behind = 0, before = 0, beams = 0;
  for (int step = -1; step <= 1; ++step) {
    const Reach& cell =
        cells_[static_cast<std::size_t>(row) * columns_ + (column + step + columns_) % columns_];
    if (cell.farthest <= 0) continue;
    ++beams;
    behind += cell.nearest > range + kMargin_m ? 1 : 0;
    before += cell.farthest < range - kMargin_m ? 1 : 0;
  }
  if (beams < 2) return Sight::open;
  if (before == beams) return Sight::hidden;
  return behind == beams ? Sight::seen_through : Sight::open;
}

bool SeenSpace::is_out_of_sight(const Eigen::Vector3f& place) const {
  const int row = row_of(place), column = column_of(place);
  if (is_out_of_view_[column]) return true;
  if (row < 0) return false;
  const Reach& cell = cells_[static_cast<std::size_t>(row) * columns_ + column];
  return cell.farthest > 0 && cell.nearest < place.norm() - kMargin_m;
}

}  // namespace lidar_upsampling
