// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/point_tracks.h"

#include <algorithm>
#include <cmath>

namespace lidar_upsampling {

std::vector<int> choose_spread(const std::vector<ProjectedPoint>& candidates,
                               const cv::Mat& texture, int max_count, int border_px) {
  Box2d bounds = Box2d::around_nothing();
  std::vector<int> inside;
  for (int i = 0; i < static_cast<int>(candidates.size()); ++i) {
    const ProjectedPoint& point = candidates[i];
    if (point.u < border_px || point.v < border_px || point.u >= texture.cols - border_px ||
        point.v >= texture.rows - border_px)
      continue;
    inside.push_back(i);
    bounds.extend(point.u, point.v);
    bounds.extend(point.u + 1e-3, point.v + 1e-3);
  }
  if (static_cast<int>(inside.size()) <= max_count) return inside;

  // Square cells, as many as points are wanted.
  const double cell = std::max(1., std::sqrt(bounds.area() / max_count));
  const int columns = static_cast<int>(std::ceil(bounds.width() / cell));
  const int rows = static_cast<int>(std::ceil(bounds.height() / cell));
  std::vector<int> best(static_cast<std::size_t>(columns) * rows, -1);
  const auto texture_at = [&](int i) {
    return texture.at<float>(static_cast<int>(candidates[i].v), static_cast<int>(candidates[i].u));
  };
  for (const int i : inside) {
    const int column = static_cast<int>((candidates[i].u - bounds.left) / cell);
    const int row = static_cast<int>((candidates[i].v - bounds.top) / cell);
    int& holder = best[static_cast<std::size_t>(row) * columns + column];
    if (holder < 0 || texture_at(i) > texture_at(holder)) holder = i;
  }
  best.erase(std::remove(best.begin(), best.end(), -1), best.end());
  // Sparse cells leave room: rounding up the grid can still give more than wanted.
  if (static_cast<int>(best.size()) > max_count) {
    std::stable_sort(best.begin(), best.end(),
                     [&](int a, int b) { return texture_at(a) > texture_at(b); });
    best.resize(max_count);
  }
  std::sort(best.begin(), best.end());
  return best;
}

void add_points(PointTracks& tracks, const std::vector<ProjectedPoint>& projected,
                const std::vector<int>& chosen, const LidarScan& key_scan, int owner) {
  for (const int i : chosen) {
    const ProjectedPoint& point = projected[i];
    tracks.point.emplace_back(key_scan.points[point.index].cast<double>());
    tracks.owner.push_back(owner);
    tracks.anchor_px.emplace_back(point.u, point.v);
    tracks.last_px.emplace_back(point.u, point.v);
    tracks.found.push_back(1);
    tracks.residual.push_back(0);
    tracks.covariance.emplace_back(Eigen::Matrix2f::Zero());
    tracks.reference.emplace_back();
  }
}

PointLabels labels_of(const PointTracks& tracks, const std::vector<std::size_t>& which) {
  PointLabels labels{tracks.surfaces, {}};
  for (const std::size_t i : which)
    labels.of_point.push_back(tracks.owner[i] == kStaticOwner
                                  ? SurfaceMap::kUnknown
                                  : static_cast<std::int16_t>(tracks.owner[i]));
  return labels;
}

std::vector<Correspondence> correspondences_of(const PointTracks& tracks, int owner) {
  std::vector<Correspondence> pairs;
  for (std::size_t i = 0; i < tracks.size(); ++i)
    if (tracks.owner[i] == owner && tracks.found[i] != 0)
      pairs.push_back({tracks.point[i],
                       {tracks.last_px[i].x, tracks.last_px[i].y},
                       tracks.covariance[i].cast<double>()});
  return pairs;
}

}  // namespace lidar_upsampling
