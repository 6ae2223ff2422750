// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/tracks/surface_search.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "lidar_upsampling/tracks/motion_estimate.h"
#include "lidar_upsampling/vision/patch_sampling.h"
#include "lidar_upsampling/vision/projection.h"

namespace lidar_upsampling {
namespace {

constexpr int kSearchHalf = 2, kSearchSide = 2 * kSearchHalf + 1;  // pixels of a picture's level
constexpr double kStep_px = 2;  // between places that are tried: a patch still looks alike halfway
constexpr double kMostSigmas = 2;  // what is farther is not tried
constexpr int kMostSteps = 40;     // along an axis; wider grids begin on smaller pictures,
                                   // and on the smallest end there
constexpr std::size_t kMostPoints = 40;
constexpr int kRounds = 2;           // on each level, by steps and by half steps
constexpr double kMostUnlike = 0.6;  // of its contrast, squared: little is as like by chance

using SmallPatch = std::array<float, kSearchSide * kSearchSide>;

/// A patch less its mean; false where it leaves the picture.
bool cut_patch(const cv::Mat& image, const cv::Point2f& at, SmallPatch& patch) {
  const float x = at.x - kSearchHalf, y = at.y - kSearchHalf;
  if (!inside(image, x, y) || !inside(image, x + kSearchSide - 1, y + kSearchSide - 1))
    return false;
  cut_out<kSearchSide, std::uint8_t>(image, x, y, patch.data());
  const float sum = std::accumulate(patch.begin(), patch.end(), 0.F);
  for (float& gray : patch) gray -= sum / (kSearchSide * kSearchSide);
  return true;
}

float sq_distance(const SmallPatch& a, const SmallPatch& b) {
  float sum = 0;
  for (int i = 0; i < kSearchSide * kSearchSide; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

/// The surface on one level of the first picture.
class SurfaceOnLevel {
 public:
  SurfaceOnLevel(const LostSurface& lost, int level)
      : lost_(lost),
        pixel_of_(lost.camera),
        image_(lost.to.levels()[2 * level]),
        scale_(std::pow(0.5F, level)) {
    const std::size_t stride = lost.points.size() / kMostPoints + 1;
    for (std::size_t i = 0; i < lost.points.size(); i += stride) {
      SmallPatch patch;
      if (!cut_patch(lost.from.levels()[2 * level], lost.from_px[i] * scale_, patch)) continue;
      points_.push_back(lost.points[i]);
      patches_.push_back(patch);
      contrast_.push_back(sq_distance(patch, {}));
    }
  }

  /// How unlike it is to what has none.
  [[nodiscard]] double contrast() const {
    return std::accumulate(contrast_.begin(), contrast_.end(), 0.);
  }

  /// How unlike it looks after a motion; what is out of view looks like nothing at all.
  [[nodiscard]] double unlikeness(const Pose& T_mov) const {
    const Pose T = lost_.T_camera_source * T_mov;
    double sum = 0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const auto pixel = pixel_of_(T * points_[i]);
      SmallPatch patch;
      const bool is_shown = pixel && cut_patch(image_,
                                               scale_ * cv::Point2f(static_cast<float>(pixel->x()),
                                                                    static_cast<float>(pixel->y())),
                                               patch);
      sum += is_shown ? std::min(contrast_[i], sq_distance(patch, patches_[i])) : contrast_[i];
    }
    return sum;
  }

 private:
  const LostSurface& lost_;
  Projector pixel_of_;
  const cv::Mat& image_;
  float scale_;
  std::vector<Eigen::Vector3d> points_;  ///< source frame
  std::vector<SmallPatch> patches_;
  std::vector<float> contrast_;
};

Eigen::Vector3d middle_of(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

Pose motion_of(const Eigen::Vector3d& step, const Eigen::Vector3d& middle) {
  Twist motion = Twist::Zero();
  motion.segment<3>(2) << step.z(), step.x(), step.y();
  return motion_pose(motion, middle);
}

/// Steps that are seen as of one pixel: aside, away from the camera, and a turn, in columns.
Eigen::Matrix3d steps_of_a_pixel(const LostSurface& lost, const Eigen::Vector3d& middle) {
  const Eigen::Vector3d sight = middle - lost.T_camera_source.inverse().translation();
  const double m_per_px = sight.norm() / lost.camera.fx;
  double half_width = kSearchHalf * m_per_px, half_length = half_width;
  for (const Eigen::Vector3d& point : lost.points) {
    const Eigen::Vector3d arm = point - middle;
    half_width = std::max(half_width, sight.cross(arm).norm() / sight.norm());
    half_length = std::max(half_length, arm.head<2>().norm());
  }
  const Eigen::Vector2d away = sight.head<2>().normalized();
  Eigen::Matrix3d steps = Eigen::Matrix3d::Zero();
  steps.col(0) << -away.y() * m_per_px, away.x() * m_per_px, 0;
  steps.col(1) << away * m_per_px * sight.norm() / half_width, 0;  // it is seen at the edges
  steps.col(2) << 0, 0, m_per_px / half_length;
  return steps;
}

/// Either way. Of what is expected nowhere, none.
int steps_within(double reach_px, double step_px) {
  const double steps = reach_px / step_px;
  return steps > 0 ? static_cast<int>(std::min<double>(steps, kMostSteps)) : 0;
}

/// What is tried on a level, about a middle.
struct Grid {
  Eigen::Matrix3d steps;       ///< in columns
  std::array<int, 3> count{};  ///< of each, either way
};

/// The likest place of a grid. @param astray from what is expected.
Eigen::Vector3d likest(const SurfaceOnLevel& surface, const Grid& grid,
                       const Eigen::Vector3d& astray, const Eigen::Vector3d& middle,
                       const PlanarStep& expected, const Eigen::Matrix3d& information) {
  Eigen::Vector3d best = astray;
  double least = std::numeric_limits<double>::infinity();
  for (int i = -grid.count[0]; i <= grid.count[0]; ++i) {
    for (int j = -grid.count[1]; j <= grid.count[1]; ++j) {
      for (int k = -grid.count[2]; k <= grid.count[2]; ++k) {
        const Eigen::Vector3d at = astray + grid.steps * Eigen::Vector3d(i, j, k);
        if (at.dot(information * at) > kMostSigmas * kMostSigmas) continue;
        const double unlike = surface.unlikeness(motion_of(expected.mean + at, middle));
        if (unlike >= least) continue;
        least = unlike;
        best = at;
      }
    }
  }
  return best;
}

}  // namespace

std::optional<Pose> search_surface(const LostSurface& lost, const PlanarStep& expected,
                                   const KltOptions& options) {
  if (lost.points.empty()) return {};
  const Eigen::Vector3d middle = middle_of(lost.points);
  const Eigen::Matrix3d pixels = steps_of_a_pixel(lost, middle);
  const auto reach_px = [&](int axis) {
    const Eigen::Vector3d along = pixels.col(axis).normalized();
    return kMostSigmas * std::sqrt(along.dot(expected.covariance * along)) /
           pixels.col(axis).norm();
  };
  const double aside_px = reach_px(0);
  if (!(aside_px > 0.5 * options.window_px)) return {};
  // A pyramid of a small picture has fewer.
  const std::size_t levels = std::min(lost.from.levels().size(), lost.to.levels().size()) / 2;
  const int smallest = std::min(options.pyramid_levels, static_cast<int>(levels) - 1);
  int level = 0;
  while (level < smallest && 2 * aside_px > kStep_px * kMostSteps * (1 << level)) ++level;
  const Eigen::Matrix3d information = expected.covariance.inverse();
  Eigen::Vector3d astray = Eigen::Vector3d::Zero();
  for (int now = level; now >= 0; --now) {
    const SurfaceOnLevel surface(lost, now);
    const auto look = [&](const std::array<int, 3>& count, double step) {
      astray = likest(surface, {pixels * step, count}, astray, middle, expected, information);
    };
    const double step = kStep_px * (1 << now);
    if (now == level)
      look({steps_within(aside_px, step), steps_within(reach_px(1), step), 0}, step);
    for (const double part : {1., 0.5})
      for (int round = 0; round < kRounds; ++round) look({1, 1, 1}, part * step);
  }
  const Pose found = motion_of(expected.mean + astray, middle);
  const SurfaceOnLevel surface(lost, 0);
  if (surface.unlikeness(found) > kMostUnlike * surface.contrast()) return {};
  return found;
}

}  // namespace lidar_upsampling
