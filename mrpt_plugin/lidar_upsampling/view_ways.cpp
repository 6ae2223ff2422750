// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/view_ways.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>

#include "lidar_upsampling/vision/projection.h"

namespace lidar_upsampling {
namespace {

constexpr double kFarOutside = -1e4;

/// Where a point is looked for after a motion.
class Guesses {
 public:
  Guesses(const CameraView& view, const Pose& T_camera_t_lidar_k)
      : points_(view.points), pixel_of_(view.camera.model), T_camera_lidar_(T_camera_t_lidar_k) {}

  [[nodiscard]] cv::Point2f at(std::size_t i, const Pose& T_mov) const {
    const auto pixel = pixel_of_(T_camera_lidar_ * (T_mov * points_.point[i]), kFarOutside);
    return pixel ? cv::Point2f(static_cast<float>(pixel->x()), static_cast<float>(pixel->y()))
                 : points_.last_px[i];
  }

 private:
  const PointTracks& points_;
  Projector pixel_of_;
  const Pose& T_camera_lidar_;
};

/// Points that may have gone one way, and where they then are.
struct Start {
  std::vector<std::size_t> which;
  std::vector<cv::Point2f> guesses;
};

/// One per way; of what is settled there is none.
std::vector<Start> starts_of(const CameraView& view, const Pose& T_camera_t_lidar_k,
                             const std::vector<Ways>& ways) {
  const PointTracks& points = view.points;
  const Guesses guesses(view, T_camera_t_lidar_k);
  const Pose still = Pose::Identity();
  std::vector<Start> starts(1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t count = points.owner[i] < 0 ? 1 : ways[points.owner[i]].motions.size();
    if (starts.size() < count) starts.resize(count);
    for (std::size_t way = 0; way < count; ++way) {
      starts[way].which.push_back(i);
      starts[way].guesses.push_back(
          guesses.at(i, points.owner[i] < 0 ? still : ways[points.owner[i]].motions[way]));
    }
  }
  return starts;
}

void forget(PointTracks& points, const std::vector<std::size_t>& which) {
  for (const std::size_t i : which) points.found[i] = 0;
}

/// Each owner keeps what looks more like it: what is known or what was found now.
void keep_better(PointTracks& points, const std::vector<std::size_t>& which, const KltResult& now,
                 const KltOptions& options) {
  const auto likeness = [&](std::uint8_t found, float residual) {
    return found != 0 ? options.max_residual - residual : 0;
  };
  std::map<int, double> gained;
  for (std::size_t j = 0; j < which.size(); ++j)
    gained[points.owner[which[j]]] += likeness(now.tracked[j], now.residual[j]) -
                                      likeness(points.found[which[j]], points.residual[which[j]]);
  for (std::size_t j = 0; j < which.size(); ++j) {
    const std::size_t i = which[j];
    if (gained[points.owner[i]] <= 0) continue;
    points.found[i] = now.tracked[j];
    points.residual[i] = now.residual[j];
    points.covariance[i] = now.covariance[j];
    if (now.tracked[j] != 0) points.last_px[i] = now.points[j];
  }
}

/// Of a start, the points that are asked for, too.
Start part_of(const Start& start, const std::vector<std::size_t>& asked) {
  Start part;
  auto next = asked.begin();
  for (std::size_t j = 0; j < start.which.size(); ++j) {
    next = std::lower_bound(next, asked.end(), start.which[j]);
    if (next == asked.end()) break;
    if (*next != start.which[j]) continue;
    part.which.push_back(start.which[j]);
    part.guesses.push_back(start.guesses[j]);
  }
  return part;
}

/// @param all, some of them: rising.
std::vector<std::size_t> without(const std::vector<std::size_t>& all,
                                 const std::vector<std::size_t>& some) {
  std::vector<std::size_t> rest;
  std::set_difference(all.begin(), all.end(), some.begin(), some.end(), std::back_inserter(rest));
  return rest;
}

/// Lost objects, where as a whole they are found.
Start searched(const CameraView& view, const Picture& picture, const Pose& T_camera_t_lidar_k,
               const std::vector<Ways>& ways, const std::vector<std::size_t>& lost,
               const KltOptions& options) {
  const LostSurface nothing{
      view.anchor->pyramid, picture.pyramid, view.camera.model, T_camera_t_lidar_k, {}, {}};
  std::vector<LostSurface> surfaces(ways.size(), nothing);
  for (const std::size_t i : lost) {
    if (view.points.owner[i] < 0) continue;
    LostSurface& surface = surfaces[view.points.owner[i]];
    surface.points.push_back(view.points.point[i]);
    surface.from_px.push_back(view.points.anchor_px[i]);
  }
  std::vector<std::optional<Pose>> motions(ways.size());
  tbb::parallel_for(std::size_t{0}, ways.size(), [&](std::size_t k) {
    motions[k] = search_surface(surfaces[k], ways[k].step, options);
  });
  const Guesses guesses(view, T_camera_t_lidar_k);
  Start start;
  for (const std::size_t i : lost) {
    const int owner = view.points.owner[i];
    if (owner < 0 || !motions[owner]) continue;
    start.which.push_back(i);
    start.guesses.push_back(guesses.at(i, *motions[owner]));
  }
  return start;
}

}  // namespace

void follow_ways(CameraView& view, const Picture& picture, const Pose& T_camera_t_lidar_k,
                 const std::vector<Ways>& ways, const KltOptions& options) {
  PointTracks& points = view.points;
  const std::vector<Start> starts = starts_of(view, T_camera_t_lidar_k, ways);
  const auto follow = [&](const Start& start, const auto& follow_points) {
    if (start.which.empty()) return;
    std::vector<cv::Point2f> from;
    std::vector<PatchReference*> references;
    for (const std::size_t i : start.which) {
      from.push_back(points.anchor_px[i]);
      references.push_back(&points.reference[i]);
    }
    const PointLabels labels = labels_of(points, start.which);
    const Patches patches{view.anchor->pyramid, picture.pyramid, from,
                          start.guesses,        &labels,         references};
    keep_better(points, start.which, follow_points(patches, options), options);
  };
  forget(points, starts.front().which);
  Start whole;
  if (options.align_first) {
    for (const Start& start : starts) follow(start, align_points);
    const std::vector<std::size_t> lost = points_elsewhere(points.owner, points.found);
    whole = searched(view, picture, T_camera_t_lidar_k, ways, lost, options);
    follow(whole, align_points);
  }
  const std::vector<std::size_t> lost = points_elsewhere(points.owner, points.found);
  forget(points, lost);
  whole = part_of(whole, lost);
  follow(whole, search_points);
  const std::vector<std::size_t> nowhere = without(lost, whole.which);
  for (const Start& start : starts) follow(part_of(start, nowhere), search_points);
}

}  // namespace lidar_upsampling
