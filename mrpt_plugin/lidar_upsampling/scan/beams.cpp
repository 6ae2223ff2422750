// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/scan/beams.h"

#include <algorithm>
#include <cmath>

namespace lidar_upsampling {
namespace {

constexpr int kSectors = 360;

int sector_of(float azimuth) {
  return std::min(kSectors - 1, static_cast<int>(azimuth / kTurn * kSectors));
}

Eigen::Vector3f direction_at(const BeamRow& row, float azimuth) {
  return Eigen::Vector3f(std::cos(azimuth), std::sin(azimuth), row.tan_elevation).normalized();
}

}  // namespace

std::vector<bool> seen_directions(const BeamPattern& pattern) {
  std::vector<bool> seen(kSectors, false);
  for (const float azimuth : pattern.azimuth) seen[sector_of(azimuth)] = true;
  return seen;
}

std::vector<Beam> find_beams(const LidarScan& scan, const BeamPattern& pattern, int row,
                             const std::vector<bool>& seen) {
  constexpr float kSteps = 2.5F;  // a single missing measurement is no gap
  const BeamRow& own = pattern.rows[row];
  const int size = own.end - own.begin;
  std::vector<Beam> beams;
  beams.reserve(std::max(size, static_cast<int>(kTurn / pattern.azimuth_pitch)) + kSectors);
  for (int k = 0; k < size; ++k) {
    const int after = own.begin + (k + 1 < size ? k + 1 : 0);
    const int point = pattern.order[own.begin + k], next = pattern.order[after];
    const float azimuth = pattern.azimuth[own.begin + k];
    beams.push_back({(scan.points[point] - own.origin()).normalized(), azimuth, point});
    const float gap = pattern.azimuth[after] - azimuth + (k + 1 == size ? kTurn : 0);
    if (gap < kSteps * pattern.azimuth_pitch) continue;
    const int steps = static_cast<int>(std::lround(gap / pattern.azimuth_pitch));
    for (int step = 1; step < steps; ++step) {
      const float share = static_cast<float>(step) / static_cast<float>(steps);
      float between = azimuth + share * gap;
      if (between >= kTurn) between -= kTurn;
      if (seen[sector_of(between)])
        beams.push_back({direction_at(own, between), between, -1, point, next, share});
    }
  }
  // What fills the gap across azimuth zero was put behind the row's last point.
  const auto first = std::find_if(beams.rbegin(), beams.rend(), [&](const Beam& beam) {
    return beam.point >= 0 || beam.azimuth >= pattern.azimuth[own.begin];
  });
  std::rotate(beams.begin(), first.base(), beams.end());
  return beams;
}

std::vector<int> first_of_columns(const std::vector<Beam>& beams, const Columns& columns) {
  std::vector<int> first(columns.number + 1, static_cast<int>(beams.size()));
  int column = 0;
  for (int k = 0; k < static_cast<int>(beams.size()); ++k) {
    const int last = std::min(columns.number - 1, columns.at(beams[k].azimuth));
    while (column <= last) first[column++] = k;
  }
  return first;
}

bool columns_go_left(const LidarScan& scan, const BeamPattern& pattern) {
  int balance = 0;
  if (scan.column.empty()) return true;
  for (const BeamRow& row : pattern.rows)
    for (int k = row.begin; k + 1 < row.end; ++k)
      balance += scan.column[pattern.order[k + 1]] > scan.column[pattern.order[k]] ? 1 : -1;
  return balance >= 0;
}

BeamLabel label_of(const Beam& beam, const LidarScan& scan, bool columns_to_left) {
  const int nearest = beam.point >= 0 ? beam.point : beam.share < 0.5F ? beam.right : beam.left;
  BeamLabel label{scan.ring[nearest]};
  if (!scan.time_s.empty()) label.time_s = scan.time_s[nearest];
  if (scan.column.empty()) return label;
  label.column = scan.column[nearest];
  if (beam.point >= 0 || scan.num_columns <= 0) return label;
  int steps = scan.column[beam.left] - scan.column[beam.right];
  if (columns_to_left && steps <= 0) steps += scan.num_columns;
  if (!columns_to_left && steps >= 0) steps -= scan.num_columns;
  const int column = scan.column[beam.right] +
                     static_cast<int>(std::lround(beam.share * static_cast<float>(steps)));
  label.column =
      static_cast<std::uint16_t>((column % scan.num_columns + scan.num_columns) % scan.num_columns);
  return label;
}

}  // namespace lidar_upsampling
