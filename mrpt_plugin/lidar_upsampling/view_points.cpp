// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/view_points.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

namespace lidar_upsampling {
namespace {

// What is followed of a candidate: patches on the picture, and the places that they show, by how
// far they lie beside the scan's points.
struct Patches {
  std::vector<ProjectedPoint> at;
  std::vector<Eigen::Vector3d> beside;  ///< m, lidar frame at k
};

Patches patches_of(Candidate& candidate, const AnchoredScan& anchored, const CameraView& view,
                   const LidarScan& scan, const Pose& T_camera_lidar_a, const Config& config) {
  const CameraModel& camera = view.camera.model;
  const double until_anchor = view.anchor_dt - candidate.time_s;
  const int enough = 2 * config.object_motion.min_points;
  Patches patches{followable_points(anchored, candidate.points, enough), {}};
  candidate.on_edges =
      std::any_of(patches.at.begin(), patches.at.end(), [&](const ProjectedPoint& point) {
        return anchored.on_edge[anchored.position[point.index]] != 0;
      });
  Pose T_camera_a_lidar_k = T_camera_lidar_a;
  if (until_anchor != 0 && !candidate.rate.isZero()) {
    T_camera_a_lidar_k = T_camera_lidar_a * exp_se3(Twist(candidate.rate * until_anchor));
    patches.at = reprojected(patches.at, scan, camera, T_camera_a_lidar_k);
  }
  if (!candidate.on_edges || !config.point_tracks.off_edges) return patches;
  const std::vector<cv::Point2f> shifts = inward_shifts(anchored, candidate.points, patches.at);
  for (std::size_t i = 0; i < shifts.size(); ++i) {
    ProjectedPoint& at = patches.at[i];
    at.u += shifts[i].x;
    at.v += shifts[i].y;
    const Eigen::Vector3d aside(shifts[i].x / camera.fx, shifts[i].y / camera.fy, 0);
    patches.beside.emplace_back(T_camera_a_lidar_k.linear().transpose() * (at.depth * aside));
  }
  return patches;
}

void add_static_points(PointTracks& tracks, const AnchoredScan& anchored,
                       const std::vector<Candidate>& candidates, const LidarScan& scan,
                       const cv::Mat& texture, const StaticPointOptions& options) {
  std::vector<std::uint8_t> unreliable(anchored.points.size()),
      candidate(anchored.points.size(), 0);
  for (std::size_t i = 0; i < unreliable.size(); ++i)
    unreliable[i] = anchored.hidden[i] | anchored.on_edge[i];
  for (const Candidate& object : candidates)
    for (const int i : object.points)
      if (anchored.position[i] >= 0) candidate[anchored.position[i]] = 1;
  const auto chosen = choose_static_points(
      {anchored.points, unreliable, candidate, texture.size(), texture}, options);
  add_points(tracks, anchored.points, chosen, scan, kStaticOwner);
}

// Prediction of all followed points; where one leaves the lens model, its last position.
std::vector<cv::Point2f> predict_pixels(const CameraView& view, const Pose& T_camera_t_lidar_k,
                                        double dt) {
  std::vector<Pose> of_owner{T_camera_t_lidar_k};
  for (const Candidate& candidate : view.candidates)
    of_owner.push_back(T_camera_t_lidar_k *
                       exp_se3(Twist(candidate.rate * (dt - candidate.time_s))));
  constexpr double kFarOutside = -1e4;
  std::vector<cv::Point2f> pixels(view.points.size());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const auto pixel = project(
        view.camera.model, of_owner[view.points.owner[i] + 1] * view.points.point[i], kFarOutside);
    pixels[i] = pixel ? cv::Point2f(static_cast<float>(pixel->x()), static_cast<float>(pixel->y()))
                      : view.points.last_px[i];
  }
  return pixels;
}

}  // namespace

void choose_points(CameraView& view, const AnchoredScan& anchored, const cv::Mat& texture,
                   const LidarScan& scan, const Pose& T_camera_lidar_a, bool with_static_points,
                   const Config& config) {
  const PointTrackOptions& options = config.point_tracks;
  for (std::size_t i = 0; i < view.candidates.size(); ++i) {
    Candidate& candidate = view.candidates[i];
    candidate.anchor_rate = candidate.rate;
    const Patches patches = patches_of(candidate, anchored, view, scan, T_camera_lidar_a, config);
    const auto chosen =
        choose_spread(patches.at, texture, options.max_points_per_object, options.border_px);
    add_points(view.points, patches.at, chosen, scan, static_cast<int>(i), patches.beside);
  }
  if (with_static_points)
    add_static_points(view.points, anchored, view.candidates, scan, texture, config.static_points);
}

namespace {

constexpr double kFarOutside = -1e4;

cv::Point2f pixel_of(const CameraView& view, std::size_t i, const Pose& T_camera_t_lidar_k,
                     const Pose& T_mov) {
  const auto pixel = project(view.camera.model, T_camera_t_lidar_k * (T_mov * view.points.point[i]),
                             kFarOutside);
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
  const KltResult again = track_points(view.anchor->pyramid, picture.pyramid, from, guesses, options);
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

/// The shift over ground that makes the patches look most alike.
std::optional<Eigen::Vector3d> sought(const CameraView& view, const SmallPatches& anchor,
                                      const SmallPatches& next,
                                      const std::vector<std::size_t>& points,
                                      const Pose& T_camera_t_lidar_k, const Ways& ways) {
  constexpr std::size_t kEnough = 24;
  constexpr float kOutside = 30;  // gray levels: as bad as what has nothing in common
  constexpr int kArea = SmallPatches::kSide * SmallPatches::kSide;
  std::vector<std::array<float, kArea>> patches;
  std::vector<Eigen::Vector3d> places;
  const std::size_t stride = 1 + points.size() / kEnough;
  double depth = 0;
  for (std::size_t j = 0; j < points.size(); j += stride) {
    std::array<float, kArea> patch;
    if (!anchor.at(view.points.anchor_px[points[j]], patch.data())) continue;
    patches.push_back(patch);
    places.push_back(ways.T_mov.front() * view.points.point[points[j]]);
    depth += (T_camera_t_lidar_k * places.back()).z();
  }
  if (places.size() < 6) return {};
  depth /= static_cast<double>(places.size());
  // Steps of a pixel of the small picture, for what is to be within a patch's reach.
  const double step = std::max(0.1, 8 * depth / view.camera.model.fx);
  const int reach = static_cast<int>(std::min(25., ways.reach_m / step));
  double least = std::numeric_limits<double>::infinity();
  Eigen::Vector3d best = Eigen::Vector3d::Zero();
  for (int ix = -reach; ix <= reach; ++ix) {
    for (int iy = -reach; iy <= reach; ++iy) {
      const Eigen::Vector3d shift(ix * step, iy * step, 0);
      double sum = 0;
      for (std::size_t j = 0; j < places.size(); ++j) {
        std::array<float, kArea> patch;
        const auto pixel = project(view.camera.model, T_camera_t_lidar_k * (places[j] + shift));
        if (!pixel || !next.at({static_cast<float>(pixel->x()), static_cast<float>(pixel->y())},
                               patch.data())) {
          sum += kOutside;
          continue;
        }
        float difference = 0;
        for (int k = 0; k < kArea; ++k) difference += std::abs(patch[k] - patches[j][k]);
        sum += std::min(kOutside, difference / kArea);
      }
      if (sum >= least) continue;
      least = sum;
      best = shift;
    }
  }
  return best;
}

}  // namespace

void follow_ways(CameraView& view, const Picture& picture, const Pose& T_camera_t_lidar_k,
                 std::vector<Ways>& ways, const KltOptions& options) {
  PointTracks& points = view.points;
  std::vector<cv::Point2f> predicted(points.size());
  std::vector<std::vector<std::size_t>> of_owner(ways.size());
  std::size_t most = 1;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const int owner = points.owner[i];
    predicted[i] = pixel_of(view, i, T_camera_t_lidar_k,
                            owner < 0 ? Pose::Identity() : ways[owner].T_mov.front());
    if (owner < 0) continue;
    of_owner[owner].push_back(i);
    most = std::max(most, ways[owner].T_mov.size());
  }
  follow_points(points, view.anchor->pyramid, picture.pyramid, predicted, options);
  const auto follow_way = [&](std::size_t way, const std::vector<std::size_t>& owners) {
    std::vector<std::size_t> which;
    std::vector<cv::Point2f> guesses;
    for (const std::size_t owner : owners)
      for (const std::size_t i : of_owner[owner]) {
        which.push_back(i);
        guesses.push_back(pixel_of(view, i, T_camera_t_lidar_k, ways[owner].T_mov[way]));
      }
    follow_again(view, picture, which, guesses, ways.size(), options);
  };
  for (std::size_t way = 1; way < most; ++way) {
    std::vector<std::size_t> owners;
    for (std::size_t i = 0; i < ways.size(); ++i)
      if (ways[i].T_mov.size() > way) owners.push_back(i);
    follow_way(way, owners);
  }
  // Of what stands where it was sought most points are found again.
  constexpr double kMost = 0.5;
  std::vector<std::size_t> lost;
  for (std::size_t owner = 0; owner < ways.size(); ++owner) {
    double found = 0;
    for (const std::size_t i : of_owner[owner]) found += points.found[i];
    if (ways[owner].reach_m > 0 && of_owner[owner].size() >= 6 &&
        found < kMost * static_cast<double>(of_owner[owner].size()))
      lost.push_back(owner);
  }
  const SmallPatches from(view.anchor->pyramid), to(picture.pyramid);
  tbb::parallel_for(std::size_t{0}, lost.size(), [&](std::size_t j) {
    Ways& way = ways[lost[j]];
    const auto shift = sought(view, from, to, of_owner[lost[j]], T_camera_t_lidar_k, way);
    way.T_mov.push_back(way.T_mov.front());
    if (shift) way.T_mov.back().pretranslate(*shift);
  });
  for (const std::size_t owner : lost) follow_way(ways[owner].T_mov.size() - 1, {owner});
}

void follow_view(CameraView& view, const Picture& picture, const LidarScan& key_scan,
                 const Pose& T_lidar_t_lidar_k_predicted, const Config& config) {
  const Pose T_camera_t_lidar_k =
      T_camera_lidar_of(view.camera, key_scan.T_vehicle_lidar) * T_lidar_t_lidar_k_predicted;
  const double dt = seconds_between(key_scan.stamp, picture.instant);
  follow_points(view.points, view.anchor->pyramid, picture.pyramid,
                predict_pixels(view, T_camera_t_lidar_k, dt), config.klt);
}

}  // namespace lidar_upsampling
