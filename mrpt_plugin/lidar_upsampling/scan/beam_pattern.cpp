// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/scan/beam_pattern.h"

#include <tbb/parallel_for.h>

#include <limits>
#include <utility>

namespace lidar_upsampling {
namespace {

constexpr std::size_t kMaxRings = 256;  // more are the rows of a depth picture
constexpr std::size_t kEnough = 300;    // of a ring's points, to tell what is the same for all

// One ring's points and what they say about its laser.
struct Ring {
  std::vector<int> points;
  std::vector<float> azimuth;
  BeamRow row;
  float scatter = 0;  // median deviation of the elevation's tangent
  float pitch = 0;
};

std::vector<Ring> split_by_ring(const LidarScan& scan) {
  std::vector<Ring> rings;
  for (int i = 0; i < static_cast<int>(scan.size()); ++i) {
    if (scan.ring[i] >= rings.size()) rings.resize(scan.ring[i] + std::size_t{1});
    rings[scan.ring[i]].points.push_back(i);
  }
  const auto is_empty = [](const Ring& ring) { return ring.points.empty(); };
  rings.erase(std::remove_if(rings.begin(), rings.end(), is_empty), rings.end());
  return rings;
}

// Most sensors turn steadily: their rows are in order but for the way round and the beginning.
void turn_into_order(std::vector<std::pair<float, int>>& row) {
  std::size_t falls = 0;
  for (std::size_t k = 1; k < row.size(); ++k) falls += row[k].first < row[k - 1].first ? 1 : 0;
  if (2 * falls > row.size()) std::reverse(row.begin(), row.end());
  std::rotate(row.begin(), std::min_element(row.begin(), row.end()), row.end());
}

void sort_by_azimuth(const LidarScan& scan, Ring& ring) {
  std::vector<std::pair<float, int>> sorted;
  sorted.reserve(ring.points.size());
  for (const int i : ring.points)
    sorted.emplace_back(azimuth_of(scan.points[i].x(), scan.points[i].y()), i);
  turn_into_order(sorted);
  if (!std::is_sorted(sorted.begin(), sorted.end())) std::sort(sorted.begin(), sorted.end());
  ring.azimuth.resize(sorted.size());
  for (std::size_t k = 0; k < sorted.size(); ++k) {
    ring.points[k] = sorted[k].second;
    ring.azimuth[k] = sorted[k].first;
  }
  std::vector<float> steps;
  for (std::size_t k = 1; k < sorted.size(); k += sorted.size() / kEnough + 1)
    steps.push_back(sorted[k].first - sorted[k - 1].first);
  if (!steps.empty()) ring.pitch = median(std::move(steps));
}

// height / distance = tan(elevation) + origin_height / distance: a line, fitted again without what
// is far off it.
void fit_laser(const LidarScan& scan, Ring& ring) {
  constexpr double kSmallest = 1e-4;               // spread of 1 / distance that tells a height
  constexpr double kTallest = 0.5;                 // metres, of a unit's optics
  std::vector<std::pair<double, double>> samples;  // 1 / distance, height / distance
  for (std::size_t k = 0; k < ring.points.size(); k += ring.points.size() / kEnough + 1) {
    const Eigen::Vector3f& p = scan.points[ring.points[k]];
    const double distance = std::max(0.1F, p.head<2>().norm());
    samples.emplace_back(1 / distance, p.z() / distance);
  }
  double height = 0, tangent = 0, limit = std::numeric_limits<double>::infinity();
  for (int round = 0; round < 3; ++round) {
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (const auto& [x, y] : samples) {
      if (std::abs(y - tangent - x * height) > limit) continue;
      n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
    }
    height = (sxy - sx * sy / n) / (sxx - sx * sx / n + n * kSmallest * kSmallest);
    if (std::abs(height) > kTallest) height = 0;
    tangent = (sy - height * sx) / n;
    std::vector<float> residuals;
    residuals.reserve(samples.size());
    for (const auto& [x, y] : samples)
      residuals.push_back(static_cast<float>(std::abs(y - tangent - x * height)));
    ring.scatter = median(std::move(residuals));
    limit = 3 * static_cast<double>(ring.scatter) + 1e-6;
  }
  ring.row.origin_height = static_cast<float>(height);
  ring.row.tan_elevation = static_cast<float>(tangent);
}

// Whether rings lie on planes through the y axis rather than cones: rows of a depth camera's
// picture.
bool are_picture_rows(const LidarScan& scan, const std::vector<Ring>& rings) {
  std::vector<float> as_plane, as_cone;
  for (const Ring& ring : rings) {
    std::vector<float> slopes;
    for (const int i : ring.points) {
      const Eigen::Vector3f& p = scan.points[i];
      if (p.x() <= 0) return false;
      slopes.push_back(p.z() / p.x());
    }
    const float slope = median(slopes);
    for (float& value : slopes) value = std::abs(value - slope);
    as_plane.push_back(median(std::move(slopes)));
    as_cone.push_back(ring.scatter);
  }
  return median(std::move(as_plane)) < 0.5F * median(std::move(as_cone));
}

// Walks along a row beside a walk along another one, both in order of azimuth.
class NearestInRow {
 public:
  NearestInRow(const BeamPattern& pattern, int row) : azimuth_(pattern.azimuth.data()) {
    if (row < 0 || row >= pattern.num_rows()) return;
    begin_ = next_ = pattern.rows[row].begin;
    end_ = pattern.rows[row].end;
  }

  // The point nearest in azimuth, at most `reach` away; -1: none. Azimuths must not fall.
  int operator()(float azimuth, float reach) {
    if (begin_ == end_) return -1;
    while (next_ < end_ && azimuth_[next_] < azimuth) ++next_;
    const int after = next_ < end_ ? next_ : begin_, before = (next_ > begin_ ? next_ : end_) - 1;
    const float to_after = azimuth_[after] - azimuth + (next_ < end_ ? 0 : kTurn);
    const float to_before = azimuth - azimuth_[before] + (next_ > begin_ ? 0 : kTurn);
    if (std::min(to_after, to_before) > reach) return -1;
    return to_before <= to_after ? before : after;
  }

 private:
  const float* azimuth_;
  int begin_ = 0, end_ = 0, next_ = 0;
};

// The rings, upwards, as rows of the pattern.
BeamPattern joined(std::vector<Ring> rings, std::size_t num_points) {
  std::stable_sort(rings.begin(), rings.end(), [](const Ring& a, const Ring& b) {
    return a.row.tan_elevation < b.row.tan_elevation;
  });
  BeamPattern pattern;
  pattern.order.reserve(num_points);
  pattern.azimuth.reserve(num_points);
  std::vector<float> pitches, scatters, gaps;
  for (Ring& ring : rings) {
    if (!pattern.rows.empty())
      gaps.push_back(ring.row.tan_elevation - pattern.rows.back().tan_elevation);
    if (ring.pitch > 0) pitches.push_back(ring.pitch);
    scatters.push_back(ring.scatter);
    ring.row.begin = static_cast<int>(pattern.order.size());
    pattern.order.insert(pattern.order.end(), ring.points.begin(), ring.points.end());
    ring.row.end = static_cast<int>(pattern.order.size());
    pattern.rows.push_back(ring.row);
    pattern.azimuth.insert(pattern.azimuth.end(), ring.azimuth.begin(), ring.azimuth.end());
  }
  if (!pitches.empty()) pattern.azimuth_pitch = median(std::move(pitches));
  pattern.scatter = median(std::move(scatters)) / std::max(1e-6F, median(std::move(gaps)));
  return pattern;
}

}  // namespace

std::optional<BeamPattern> find_beam_pattern(const LidarScan& scan) {
  constexpr float kMaxScatter = 1;
  constexpr float kLeastPitch = kTurn / 65536;  // numbers of columns have 16 bits
  if (scan.ring.size() != scan.size() || scan.size() == 0) return {};
  std::vector<Ring> rings = split_by_ring(scan);
  if (rings.size() < 2 || rings.size() > kMaxRings) return {};
  tbb::parallel_for(std::size_t{0}, rings.size(), [&](std::size_t i) {
    sort_by_azimuth(scan, rings[i]);
    fit_laser(scan, rings[i]);
  });
  if (are_picture_rows(scan, rings)) return {};
  BeamPattern pattern = joined(std::move(rings), scan.size());
  if (!(pattern.azimuth_pitch >= kLeastPitch) || pattern.scatter > kMaxScatter) return {};
  return pattern;
}

void find_neighbours(const BeamPattern& pattern, int row, std::vector<BeamNeighbours>& neighbours) {
  const float along = 2.5F * pattern.azimuth_pitch, across = 1.5F * pattern.azimuth_pitch;
  const int begin = pattern.rows[row].begin, end = pattern.rows[row].end;
  NearestInRow below(pattern, row - 1), above(pattern, row + 1);
  const auto after = [&](int k) { return k + 1 < end ? k + 1 : begin; };
  const auto is_next = [&](int k, int next) {
    const float turn = pattern.azimuth[next] - pattern.azimuth[k] + (next > k ? 0 : kTurn);
    return turn > 0 && turn <= along;
  };
  int right = is_next(end - 1, begin) ? end - 1 : -1;
  for (int k = begin; k < end; ++k) {
    const float azimuth = pattern.azimuth[k];
    const int left = is_next(k, after(k)) ? after(k) : -1;
    neighbours[k] = {right, left, below(azimuth, across), above(azimuth, across)};
    right = left < 0 ? -1 : k;
  }
}

}  // namespace lidar_upsampling
