// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/scan/patch_index.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>

namespace lidar_upsampling {
namespace {

constexpr int kStatic = -1;  // as in VirtualScan::track_id

constexpr float kNearest = 0.1F;  // metres from the axis: nearer places have no azimuth to speak of

// The corners of a patch, lidar frame.
struct Outline {
  Eigen::Array4f x, y, z;
};

Outline outline_of(const Patch& patch, float origin_height, float reach) {
  const Eigen::Array4f edge = reach / patch.inverse_reach;
  const Eigen::Array4f x(edge[0], edge[0], edge[1], edge[1]), y(edge[2], edge[3], edge[2], edge[3]);
  const Eigen::Array4f plane = patch.in_frame(patch.frame.row(0));
  // A steep patch would reach to infinity.
  const Eigen::Array4f depth = 1 / (plane[1] + plane[2] * x + plane[3] * y).max(0.25F * plane[1]);
  const Eigen::Matrix<float, 4, 3>& axes = patch.frame;
  return {(axes(1, 0) + axes(2, 0) * x + axes(3, 0) * y) * depth,
          (axes(1, 1) + axes(2, 1) * x + axes(3, 1) * y) * depth,
          (axes(1, 2) + axes(2, 2) * x + axes(3, 2) * y) * depth + origin_height};
}

Outline moved(const Outline& o, const Eigen::Isometry3f& T) {
  return {T(0, 0) * o.x + T(0, 1) * o.y + T(0, 2) * o.z + T(0, 3),
          T(1, 0) * o.x + T(1, 1) * o.y + T(1, 2) * o.z + T(1, 3),
          T(2, 0) * o.x + T(2, 1) * o.y + T(2, 2) * o.z + T(2, 3)};
}

// Rows from `first` to before `end`, azimuths from `right` to `left`.
struct Cover {
  int first = 0, end = 0;
  float right = 0, left = 0;
};

// Finds what an outline covers, from what the one before did.
class Coverage {
 public:
  Coverage(const BeamPattern& pattern, const BeamRow& own)
      : pattern_(pattern),
        origin_height_(own.origin_height),
        slack_(static_cast<int>(std::ceil(2 * pattern.scatter - 0.5F))),
        guess_(pattern.num_rows() / 2) {}

  [[nodiscard]] Cover of(const Outline& outline) {
    const float x = 0.25F * outline.x.sum(), y = 0.25F * outline.y.sum();
    const float sq_distance = x * x + y * y;
    if (!(sq_distance > kNearest * kNearest) || !std::isfinite(sq_distance)) return {};
    const Eigen::Array4f ahead = (outline.x * x + outline.y * y).max(0.1F * sq_distance);
    const Eigen::Array4f sideways = (outline.y * x - outline.x * y) / ahead;
    const Eigen::Array4f inverse_distance =
        1 / (outline.x * outline.x + outline.y * outline.y).sqrt();
    const Eigen::Array4f tangent = (outline.z - origin_height_) * inverse_distance;
    const float azimuth = azimuth_of(x, y);
    Cover cover = rows_between(tangent.minCoeff(), tangent.maxCoeff(), inverse_distance[0]);
    cover.right = azimuth + sideways.minCoeff();  // an angle's tangent is the larger one
    cover.left = azimuth + sideways.maxCoeff();
    return cover;
  }

 private:
  // @param inverse_distance at which the tangents were seen.
  [[nodiscard]] Cover rows_between(float lowest, float highest, float inverse_distance) {
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

  const BeamPattern& pattern_;
  float origin_height_;
  int slack_;
  int guess_;
};

// In one piece, or two where it lies across azimuth zero.
void add_prints(const Cover& cover, int patch, const Columns& columns, FootprintsOfRow& prints) {
  int first = columns.at(cover.right), last = columns.at(cover.left);
  if (last - first >= columns.number) first = 0, last = columns.number - 1;
  const int wrapped = (first % columns.number + columns.number) % columns.number;
  last += wrapped - first;
  first = wrapped;
  const int end = columns.number - 1;
  for (int row = cover.first; row < cover.end; ++row) {
    prints.on_row[row].push_back({patch, first, std::min(last, end)});
    if (last > end) prints.on_row[row].push_back({patch, 0, last - end - 1});
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
  Coverage coverage(pattern, own);
  for (int i = own.begin; i < own.end; ++i) {
    if (motions.of_patch[i] < 0) continue;
    const Outline outline = outline_of(patches[i], own.origin_height, reach);
    const Outline now = moved(outline, motions.forth[motions.of_patch[i]]);
    add_prints(coverage.of(now), i, columns, prints);
  }
  return prints;
}

}  // namespace lidar_upsampling
