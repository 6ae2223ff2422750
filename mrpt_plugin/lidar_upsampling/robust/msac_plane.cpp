// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/robust/msac_plane.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "lidar_upsampling/checks.h"
#include "lidar_upsampling/robust/ransac.h"
#include "lidar_upsampling/units.h"

namespace lidar_upsampling {
namespace {

constexpr RansacOptions kRansac{20, 300, 0.9999, 1};
constexpr std::size_t kMaxScoredPoints = 4000;  // a random choice that hypotheses are scored on

/// Sums of a least-squares plane; about an origin near the points, or the squares lose their
/// digits.
class PlaneSums {
 public:
  explicit PlaneSums(const Eigen::Vector3d& origin) : origin_(origin) {}

  void add(const Eigen::Vector3d& point) {
    const Eigen::Vector3d p = point - origin_;
    sum_ += p;
    sum_of_squares_.noalias() += p * p.transpose();
    ++count_;
  }

  [[nodiscard]] Plane fit(const Eigen::Vector3d& up) const {
    const Eigen::Vector3d mean = sum_ / count_;
    const Eigen::Matrix3d covariance = sum_of_squares_ / count_ - mean * mean.transpose();
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    solver.computeDirect(covariance);
    Plane plane;
    plane.normal = solver.eigenvectors().col(0);
    if (plane.normal.dot(up) < 0) plane.normal = -plane.normal;
    plane.d = -plane.normal.dot(mean + origin_);
    return plane;
  }

  [[nodiscard]] int count() const { return count_; }

 private:
  Eigen::Vector3d origin_;
  Eigen::Vector3d sum_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d sum_of_squares_ = Eigen::Matrix3d::Zero();
  int count_ = 0;
};

class MsacPlane {
 public:
  using Model = Plane;
  static constexpr std::size_t sample_size = 3;

  MsacPlane(std::vector<Eigen::Vector3f> points, const PlaneOptions& options)
      : points_(std::move(points)),
        up_(options.up.normalized()),
        min_cos_tilt_(std::cos(options.max_tilt_deg * kDegree)),
        distance_(static_cast<float>(options.inlier_distance_m)) {}

  [[nodiscard]] int num_data() const { return static_cast<int>(points_.size()); }

  void generate_models(const std::array<int, 3>& sample, std::vector<Plane>* models) const {
    const Eigen::Vector3d a = points_[sample[0]].cast<double>();
    const Eigen::Vector3d b = points_[sample[1]].cast<double>();
    const Eigen::Vector3d c = points_[sample[2]].cast<double>();
    const Eigen::Vector3d cross = (b - a).cross(c - a);
    const double length = cross.norm();
    if (!(length > 1e-6)) return;
    Plane plane;
    plane.normal = cross / length;
    if (plane.normal.dot(up_) < 0) plane.normal = -plane.normal;
    plane.d = -plane.normal.dot(a);
    if (is_level(plane)) models->push_back(plane);
  }

  [[nodiscard]] ModelScore score_model(const Plane& plane) const {
    const Eigen::Vector3f normal = plane.normal.cast<float>();
    const float threshold = distance_ * distance_;
    const Eigen::Map<const Eigen::Matrix3Xf> points(points_.data()->data(), 3,
                                                    static_cast<Eigen::Index>(points_.size()));
    const auto sq_distance =
        ((normal.transpose() * points).array() + static_cast<float>(plane.d)).square().eval();
    return {sq_distance.min(threshold).cast<double>().sum(),
            static_cast<int>((sq_distance < threshold).count())};
  }

  void refine_model(Plane& plane) const {
    PlaneSums inliers(-plane.d * plane.normal);
    for (const Eigen::Vector3f& point : points_) {
      const Eigen::Vector3d p = point.cast<double>();
      if (std::abs(plane.normal.dot(p) + plane.d) < distance_) inliers.add(p);
    }
    if (inliers.count() < 3) return;
    if (const Plane refined = inliers.fit(up_); is_level(refined)) plane = refined;
  }

  [[nodiscard]] bool is_level(const Plane& plane) const {
    return plane.normal.dot(up_) >= min_cos_tilt_;
  }

 private:
  std::vector<Eigen::Vector3f> points_;
  Eigen::Vector3d up_;
  double min_cos_tilt_;
  float distance_;
};

/// As many of the points, each equally likely: one from each of `count` equal stretches.
std::vector<Eigen::Vector3f> subsample(const std::vector<Eigen::Vector3f>& points,
                                       std::size_t count) {
  const std::size_t size = points.size();
  if (size <= count) return points;
  std::vector<Eigen::Vector3f> chosen;
  std::mt19937 generator(kRansac.seed);
  const double stretch = static_cast<double>(size) / static_cast<double>(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double at = (static_cast<double>(i) + generator() * 0x1p-32) * stretch;
    chosen.push_back(points[std::min(size - 1, static_cast<std::size_t>(at))]);
  }
  return chosen;
}

/// Sums of the points near a plane.
PlaneSums inlier_sums(const std::vector<Eigen::Vector3f>& points, const Plane& plane, float limit) {
  const Eigen::Vector3f normal = plane.normal.cast<float>();
  const auto d = static_cast<float>(plane.d);
  PlaneSums sums(-plane.d * plane.normal);
  for (const Eigen::Vector3f& point : points)
    if (std::abs(normal.dot(point) + d) < limit) sums.add(point.cast<double>());
  return sums;
}

}  // namespace

std::optional<Plane> estimate_plane(const std::vector<Eigen::Vector3f>& points,
                                    const PlaneOptions& options) {
  require(options.inlier_distance_m > 0, "plane: inlier_distance_m must be positive",
          options.inlier_distance_m);
  require(options.max_tilt_deg > 0 && options.max_tilt_deg <= 90,
          "plane: max_tilt_deg must be within (0, 90]", options.max_tilt_deg);
  MsacPlane estimator(subsample(points, kMaxScoredPoints), options);
  std::optional<Plane> plane = ransac(estimator, kRansac).model;
  if (!plane) return std::nullopt;
  const auto enough = [&](const PlaneSums& inliers) {
    return inliers.count() >= std::max(3, options.min_inliers);
  };
  const auto limit = static_cast<float>(options.inlier_distance_m);
  const PlaneSums inliers = inlier_sums(points, *plane, limit);
  if (!enough(inliers)) return std::nullopt;
  if (const Plane refined = inliers.fit(options.up); estimator.is_level(refined)) plane = refined;
  return enough(inlier_sums(points, *plane, limit)) ? plane : std::nullopt;
}

}  // namespace lidar_upsampling
