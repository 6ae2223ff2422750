// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/view_ways.h"

#include <algorithm>

#include "lidar_upsampling/vision/projection.h"

namespace lidar_upsampling {
namespace {

constexpr double kFarOutside = -1e4;

cv::Point2f pixel_of(const CameraView& view, std::size_t i, const Pose& T_camera_t_lidar_k,
                     const Pose& T_mov) {
  const auto pixel =
      project(view.camera.model, T_camera_t_lidar_k * (T_mov * view.points.point[i]), kFarOutside);
  return pixel ? cv::Point2f(static_cast<float>(pixel->x()), static_cast<float>(pixel->y()))
               : view.points.last_px[i];
}

/// Follows some points once more; each owner keeps what looks more like it.
void follow_again(CameraView& view, const Picture& picture, const std::vector<std::size_t>& which,
                  const std::vector<cv::Point2f>& guesses, std::size_t num_owners,
                  const KltOptions& options) {
  if (which.empty()) return;
  PointTracks& points = view.points;
  std::vector<cv::Point2f> from;
  for (const std::size_t i : which) from.push_back(points.anchor_px[i]);
  const PointLabels labels = labels_of(points, which);
  const KltResult again =
      track_points(view.anchor->pyramid, picture.pyramid, from, guesses, options, &labels);
  const auto likeness = [&](std::uint8_t found, float residual) {
    return found != 0 ? options.max_residual - residual : 0;
  };
  std::vector<double> gained(num_owners, 0);
  for (std::size_t j = 0; j < which.size(); ++j)
    gained[points.owner[which[j]]] += likeness(again.tracked[j], again.residual[j]) -
                                      likeness(points.found[which[j]], points.residual[which[j]]);
  for (std::size_t j = 0; j < which.size(); ++j) {
    const std::size_t i = which[j];
    if (gained[points.owner[i]] <= 0) continue;
    points.found[i] = again.tracked[j];
    points.residual[i] = again.residual[j];
    points.covariance[i] = again.covariance[j];
    if (again.tracked[j] != 0) points.last_px[i] = again.points[j];
  }
}

}  // namespace

void follow_ways(CameraView& view, const Picture& picture, const Pose& T_camera_t_lidar_k,
                 const std::vector<std::vector<Pose>>& ways, const KltOptions& options) {
  PointTracks& points = view.points;
  std::vector<cv::Point2f> expected(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    expected[i] = pixel_of(view, i, T_camera_t_lidar_k,
                           points.owner[i] < 0 ? Pose::Identity() : ways[points.owner[i]].front());
  follow_points(points, view.anchor->pyramid, picture.pyramid, expected, options);

  std::size_t most = 1;
  for (const auto& motions : ways) most = std::max(most, motions.size());
  for (std::size_t way = 1; way < most; ++way) {
    std::vector<std::size_t> which;
    std::vector<cv::Point2f> guesses;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (points.owner[i] < 0 || ways[points.owner[i]].size() <= way) continue;
      which.push_back(i);
      guesses.push_back(pixel_of(view, i, T_camera_t_lidar_k, ways[points.owner[i]][way]));
    }
    follow_again(view, picture, which, guesses, ways.size(), options);
  }
}

}  // namespace lidar_upsampling
