// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/scan/patch_index.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include "lidar_upsampling/scan/outlines.h"

namespace lidar_upsampling {
namespace {

constexpr int kStatic = -1;  // as in VirtualScan::track_id

// Rows of beams, each found from the one before.
class RowSearch {
 public:
  RowSearch(const BeamPattern& pattern, const BeamRow& own)
      : pattern_(pattern),
        origin_height_(own.origin_height),
        slack_(static_cast<int>(std::ceil(2 * pattern.scatter - 0.5F))),
        guess_(pattern.num_rows() / 2) {}

  /// @param inverse_distance at which the tangents were seen.
  /// @return the first row between the two and the one behind the last.
  [[nodiscard]] std::pair<int, int> between(float lowest, float highest, float inverse_distance) {
    const auto tangent = [&](int row) {
      return pattern_.rows[row].tan_elevation +
             (pattern_.rows[row].origin_height - origin_height_) * inverse_distance;
    };
    int row = guess_;
    while (row < pattern_.num_rows() && tangent(row) < lowest) ++row;
    while (row > 0 && tangent(row - 1) >= lowest) --row;
    guess_ = row;
    while (row < pattern_.num_rows() && tangent(row) < highest) ++row;
    return {std::max(0, guess_ - slack_), std::min(pattern_.num_rows(), row + slack_)};
  }

 private:
  const BeamPattern& pattern_;
  float origin_height_;
  int slack_;
  int guess_;
};

// In one piece, or two where it lies across azimuth zero.
// @param usual_size of a row's list.
void add_prints(const std::pair<int, int>& rows, int first, int last, int patch,
                const Columns& columns, std::size_t usual_size, FootprintsOfRow& prints) {
  if (last - first >= columns.number) first = 0, last = columns.number - 1;
  if (first < 0 || first >= columns.number) {
    const int wrapped = (first % columns.number + columns.number) % columns.number;
    last += wrapped - first;
    first = wrapped;
  }
  const int end = columns.number - 1;
  for (int row = rows.first; row < rows.second; ++row) {
    std::vector<Footprint>& on_row = prints.on_row[row];
    if (on_row.empty()) on_row.reserve(usual_size);
    on_row.push_back({patch, first, std::min(last, end)});
    if (last > end) on_row.push_back({patch, 0, last - end - 1});
  }
}

}  // namespace

void PatchMotions::append(const PatchMotions& other) {
  const auto first = static_cast<int>(forth.size());
  forth.insert(forth.end(), other.forth.begin(), other.forth.end());
  back.insert(back.end(), other.back.begin(), other.back.end());
  track_id.insert(track_id.end(), other.track_id.begin(), other.track_id.end());
  for (const int motion : other.of_patch)
    of_patch.push_back(motion == kAbsent ? kAbsent : first + motion);
}

PatchMotions motions_of(const std::vector<int>& position, const VirtualScan& moved) {
  PatchMotions motions;
  motions.of_patch.assign(position.size(), PatchMotions::kAbsent);
  const auto add = [&](const Pose& T, int track_id) {
    motions.forth.emplace_back(T);
    motions.back.emplace_back(T.inverse());
    motions.track_id.push_back(track_id);
  };
  add(moved.T_lidar_t_lidar_k, kStatic);
  std::map<int, int> of_track{{kStatic, 0}};
  for (const ObjectMotion& object : moved.objects) {
    of_track[object.track_id] = static_cast<int>(motions.forth.size());
    add(object.T_lidar_t_lidar_k, object.track_id);
  }
  auto motion = of_track.find(kStatic);
  for (std::size_t k = 0; k < moved.source_index.size(); ++k) {
    if (motion->first != moved.track_id[k]) motion = of_track.find(moved.track_id[k]);
    if (motion == of_track.end())
      throw std::invalid_argument("resampling: points of track " +
                                  std::to_string(moved.track_id[k]) + ", but no such object");
    motions.of_patch[position[moved.source_index[k]]] = motion->second;
  }
  return motions;
}

double largest_motion(const std::vector<Eigen::Vector3f>& points, const PatchMotions& motions) {
  constexpr std::size_t kStep = 8;  // of the static scene, which has points enough
  std::vector<float> sum(motions.forth.size(), 0);
  std::vector<int> count(motions.forth.size(), 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const int motion = motions.of_patch[i];
    if (motion == PatchMotions::kAbsent || (motion == 0 && i % kStep != 0)) continue;
    sum[motion] += (motions.forth[motion] * points[i] - points[i]).norm();
    ++count[motion];
  }
  float largest = 0;
  for (std::size_t m = 0; m < sum.size(); ++m)
    if (count[m] > 0) largest = std::max(largest, sum[m] / static_cast<float>(count[m]));
  return largest;
}

FootprintsOfRow find_footprints(const BeamRow& own, const BeamPattern& pattern,
                                const Columns& columns, const PatchRefs& patches,
                                const PatchMotions& motions, float reach) {
  FootprintsOfRow prints{own.origin(), std::vector<std::vector<Footprint>>(pattern.num_rows())};
  RowSearch rows(pattern, own);
  const std::vector<FourMotions> all_motions(motions.forth.begin(), motions.forth.end());
  for (int i = own.begin; i < own.end; i += 4) {
    std::array<const Patch*, 4> four{};
    std::array<int, 4> motion{};
    for (int lane = 0; lane < 4; ++lane) {
      const int patch = std::min(i + lane, own.end - 1);
      four[lane] = &patches[patch];
      motion[lane] = std::max(0, motions.of_patch[patch]);
    }
    const bool is_one = std::count(motion.begin(), motion.end(), motion[0]) == 4;
    const FourMotions moves = is_one ? all_motions[motion[0]] : FourMotions(all_motions, motion);
    const Covers covers = covers_of(four, moves, own.origin_height, reach);
    for (int lane = 0; lane < std::min(4, own.end - i); ++lane)
      if (covers.is_somewhere[lane] && motions.of_patch[i + lane] >= 0)
        add_prints(
            rows.between(covers.lowest[lane], covers.highest[lane], covers.inverse_distance[lane]),
            columns.at(covers.right[lane]), columns.at(covers.left[lane]), i + lane, columns,
            own.end - own.begin, prints);
  }
  return prints;
}

}  // namespace lidar_upsampling
