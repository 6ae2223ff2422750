// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/view_ways.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

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

/// Follows some points once more; each owner keeps what finds more of its points.
void follow_again(CameraView& view, const Picture& picture, const std::vector<std::size_t>& which,
                  const std::vector<cv::Point2f>& guesses, std::size_t num_owners,
                  const KltOptions& options) {
  if (which.empty()) return;
  PointTracks& points = view.points;
  std::vector<cv::Point2f> from;
  for (const std::size_t i : which) from.push_back(points.anchor_px[i]);
  const KltResult again =
      track_points(view.anchor->pyramid, picture.pyramid, from, guesses, options);
  std::vector<int> gained(num_owners, 0);
  for (std::size_t j = 0; j < which.size(); ++j)
    gained[points.owner[which[j]]] += again.tracked[j] - points.found[which[j]];
  for (std::size_t j = 0; j < which.size(); ++j) {
    const std::size_t i = which[j];
    if (gained[points.owner[i]] <= 0) continue;
    points.found[i] = again.tracked[j];
    if (again.tracked[j] != 0) points.last_px[i] = again.points[j];
  }
}

/// Patches on a picture a quarter as large, without their mean.
class SmallPatches {
 public:
  static constexpr int kLevel = 2, kHalf = 2, kSide = 2 * kHalf + 1;
  explicit SmallPatches(const ImagePyramid& pyramid)
      : gray_(pyramid.levels()[2 * std::min(kLevel, pyramid.pyramid_levels())]),
        scale_(1.F / static_cast<float>(1 << std::min(kLevel, pyramid.pyramid_levels()))) {}

  /// @return false where it leaves the picture.
  bool at(const cv::Point2f& pixel, float* patch) const {
    const int u = cvRound(pixel.x * scale_), v = cvRound(pixel.y * scale_);
    if (u < kHalf || v < kHalf || u + kHalf >= gray_.cols || v + kHalf >= gray_.rows) return false;
    float mean = 0;
    int k = 0;
    for (int y = v - kHalf; y <= v + kHalf; ++y) {
      const auto* row = gray_.ptr<std::uint8_t>(y);
      for (int x = u - kHalf; x <= u + kHalf; ++x) mean += patch[k++] = row[x];
    }
    for (k = 0; k < kSide * kSide; ++k) patch[k] -= mean / (kSide * kSide);
    return true;
  }

 private:
  cv::Mat gray_;
  float scale_;
};

using Patch = std::array<float, SmallPatches::kSide * SmallPatches::kSide>;

/// Patches of an object where they were first put, and the places that they show.
struct Template {
  std::vector<Patch> patches;
  std::vector<Eigen::Vector3d> places;  ///< lidar frame at k, where the likeliest way leads
  double depth = 0;                     ///< m, mean, from the camera
};

Template make_template(const CameraView& view, const SmallPatches& anchor,
                       const std::vector<std::size_t>& points, const Pose& T_camera_t_lidar_k,
                       const Pose& T_mov) {
  constexpr std::size_t kEnough = 24;
  Template result;
  const std::size_t stride = 1 + points.size() / kEnough;
  for (std::size_t j = 0; j < points.size(); j += stride) {
    Patch patch;
    if (!anchor.at(view.points.anchor_px[points[j]], patch.data())) continue;
    result.patches.push_back(patch);
    result.places.push_back(T_mov * view.points.point[points[j]]);
    result.depth += (T_camera_t_lidar_k * result.places.back()).z();
  }
  result.depth /= std::max<double>(1., static_cast<double>(result.places.size()));
  return result;
}

/// Sum of the patches' mean absolute differences, gray levels.
float difference_at(const CameraModel& camera, const SmallPatches& next, const Template& object,
                    const Pose& T_camera_t_lidar_k, const Eigen::Vector3d& shift) {
  constexpr float kWorst = 30;  // gray levels: as bad as what has nothing in common
  float sum = 0;
  for (std::size_t j = 0; j < object.places.size(); ++j) {
    Patch patch;
    float difference = kWorst * static_cast<float>(patch.size());
    const auto pixel = project(camera, T_camera_t_lidar_k * (object.places[j] + shift));
    if (pixel &&
        next.at({static_cast<float>(pixel->x()), static_cast<float>(pixel->y())}, patch.data())) {
      difference = 0;
      for (std::size_t k = 0; k < patch.size(); ++k)
        difference += std::abs(patch[k] - object.patches[j][k]);
    }
    sum += std::min(kWorst, difference / static_cast<float>(patch.size()));
  }
  return sum;
}

/// The level shift over ground that makes the patches look most alike.
std::optional<Eigen::Vector3d> sought(const CameraView& view, const SmallPatches& anchor,
                                      const SmallPatches& next,
                                      const std::vector<std::size_t>& points,
                                      const Pose& T_camera_t_lidar_k, const Ways& ways) {
  constexpr std::size_t kFewest = 6;
  constexpr double kFinest_m = 0.1, kMostSteps = 25;
  const Template object =
      make_template(view, anchor, points, T_camera_t_lidar_k, ways.T_mov.front());
  if (object.places.size() < kFewest) return {};
  // Steps of two pixels of the small picture, within a patch's reach.
  const double step =
      std::max(kFinest_m, 2 * (1 << SmallPatches::kLevel) * object.depth / view.camera.model.fx);
  const int reach = static_cast<int>(std::min(kMostSteps, ways.reach_m / step));
  float least = std::numeric_limits<float>::infinity();
  Eigen::Vector3d best = Eigen::Vector3d::Zero();
  for (int ix = -reach; ix <= reach; ++ix) {
    for (int iy = -reach; iy <= reach; ++iy) {
      const Eigen::Vector3d shift(ix * step, iy * step, 0);
      const float difference =
          difference_at(view.camera.model, next, object, T_camera_t_lidar_k, shift);
      if (difference >= least) continue;
      least = difference;
      best = shift;
    }
  }
  return best;
}

/// Points by their owner.
std::vector<std::vector<std::size_t>> points_of_owners(const PointTracks& points,
                                                       std::size_t num_owners) {
  std::vector<std::vector<std::size_t>> of_owner(num_owners);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points.owner[i] >= 0) of_owner[points.owner[i]].push_back(i);
  return of_owner;
}

/// Owners of whose points few were found, and that may be elsewhere.
std::vector<std::size_t> lost_owners(const PointTracks& points, const std::vector<Ways>& ways,
                                     const std::vector<std::vector<std::size_t>>& of_owner) {
  constexpr double kMost = 0.5;  // of what stands where it was sought, most are found again
  std::vector<std::size_t> lost;
  for (std::size_t owner = 0; owner < ways.size(); ++owner) {
    const auto found = std::count_if(of_owner[owner].begin(), of_owner[owner].end(),
                                     [&](std::size_t i) { return points.found[i] != 0; });
    if (ways[owner].reach_m > 0 &&
        static_cast<double>(found) < kMost * static_cast<double>(of_owner[owner].size()))
      lost.push_back(owner);
  }
  return lost;
}

}  // namespace

void follow_ways(CameraView& view, const Picture& picture, const Pose& T_camera_t_lidar_k,
                 std::vector<Ways>& ways, const KltOptions& options) {
  PointTracks& points = view.points;
  std::vector<cv::Point2f> expected(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    expected[i] =
        pixel_of(view, i, T_camera_t_lidar_k,
                 points.owner[i] < 0 ? Pose::Identity() : ways[points.owner[i]].T_mov.front());
  follow_points(points, view.anchor->pyramid, picture.pyramid, expected, options);

  const auto of_owner = points_of_owners(points, ways.size());
  const auto follow_way = [&](std::size_t way, const std::vector<std::size_t>& owners) {
    std::vector<std::size_t> which;
    std::vector<cv::Point2f> guesses;
    for (const std::size_t owner : owners) {
      if (ways[owner].T_mov.size() <= way) continue;
      for (const std::size_t i : of_owner[owner]) {
        which.push_back(i);
        guesses.push_back(pixel_of(view, i, T_camera_t_lidar_k, ways[owner].T_mov[way]));
      }
    }
    follow_again(view, picture, which, guesses, ways.size(), options);
  };
  std::vector<std::size_t> all(ways.size());
  std::size_t most = 1;
  for (std::size_t i = 0; i < ways.size(); ++i) {
    all[i] = i;
    most = std::max(most, ways[i].T_mov.size());
  }
  for (std::size_t way = 1; way < most; ++way) follow_way(way, all);

  const auto lost = lost_owners(points, ways, of_owner);
  const SmallPatches from(view.anchor->pyramid), to(picture.pyramid);
  tbb::parallel_for(std::size_t{0}, lost.size(), [&](std::size_t j) {
    Ways& way = ways[lost[j]];
    const auto shift = sought(view, from, to, of_owner[lost[j]], T_camera_t_lidar_k, way);
    if (shift) way.T_mov.push_back(Eigen::Translation3d(*shift) * way.T_mov.front());
  });
  for (const std::size_t owner : lost)
    if (ways[owner].T_mov.size() > most) follow_way(ways[owner].T_mov.size() - 1, {owner});
}

}  // namespace lidar_upsampling
