// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/robust/msac_plane.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "lidar_upsampling/units.h"

namespace lidar_upsampling {
namespace {

void check(const PlaneOptions& options) {
  const auto complain = [](const std::string& what, double value) {
    throw std::invalid_argument("plane: " + what + ", not " + std::to_string(value));
  };
  if (!(options.inlier_distance_m > 0)) {
    complain("inlier_distance_m must be positive", options.inlier_distance_m);
  }
  if (!(options.max_tilt_deg > 0 && options.max_tilt_deg <= 90)) {
    complain("max_tilt_deg must be within (0, 90]", options.max_tilt_deg);
  }
  if (!(options.up.norm() > 0)) complain("the up axis must not be zero", options.up.norm());
  if (options.max_scored_points < 3) {
    complain("max_scored_points must be at least 3", options.max_scored_points);
  }
}

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

  MsacPlane(Eigen::Matrix3Xf points, const PlaneOptions& options)
      : points_(std::move(points)),
        up_(options.up.normalized()),
        min_cos_tilt_(std::cos(options.max_tilt_deg * kDegree)),
        distance_(static_cast<float>(options.inlier_distance_m)) {}

  [[nodiscard]] int num_data() const { return static_cast<int>(points_.cols()); }

  void generate_models(const std::array<int, 3>& sample, std::vector<Plane>* models) const {
    const Eigen::Vector3d a = points_.col(sample[0]).cast<double>();
    const Eigen::Vector3d b = points_.col(sample[1]).cast<double>();
    const Eigen::Vector3d c = points_.col(sample[2]).cast<double>();
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
    const auto sq_distance =
        ((normal.transpose() * points_).array() + static_cast<float>(plane.d)).square().eval();
    return {sq_distance.min(threshold).cast<double>().sum(),
            static_cast<int>((sq_distance < threshold).count())};
  }

  void refine_model(Plane& plane) const {
    PlaneSums sums(-plane.d * plane.normal);
    for (Eigen::Index i = 0; i < points_.cols(); ++i) {
      const Eigen::Vector3d point = points_.col(i).cast<double>();
      if (std::abs(plane.signed_distance(point)) < distance_) sums.add(point);
    }
    if (sums.count() < 3) return;
    const Plane refined = sums.fit(up_);
    if (is_level(refined)) plane = refined;
  }

  [[nodiscard]] bool is_level(const Plane& plane) const {
    return plane.normal.dot(up_) >= min_cos_tilt_;
  }

 private:
  Eigen::Matrix3Xf points_;
  Eigen::Vector3d up_;
  double min_cos_tilt_;
  float distance_;
};

/// The points at `count` of the indices, each equally likely: one from each of `count` equal
/// stretches.
Eigen::Matrix3Xf subsample(const std::vector<Eigen::Vector3f>& points,
                           const std::vector<int>& indices, std::size_t count, std::uint32_t seed) {
  const std::size_t size = indices.size();
  Eigen::Matrix3Xf chosen(3, static_cast<Eigen::Index>(std::min(size, count)));
  if (size <= count) {
    for (std::size_t i = 0; i < size; ++i)
      chosen.col(static_cast<Eigen::Index>(i)) = points[static_cast<std::size_t>(indices[i])];
    return chosen;
  }
  std::mt19937 generator(seed);
  const double stretch = static_cast<double>(size) / static_cast<double>(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double at = (static_cast<double>(i) + generator() * 0x1p-32) * stretch;
    const int index = indices[std::min(size - 1, static_cast<std::size_t>(at))];
    chosen.col(static_cast<Eigen::Index>(i)) = points[static_cast<std::size_t>(index)];
  }
  return chosen;
}

}  // namespace

std::optional<PlaneFit> estimate_plane(const std::vector<Eigen::Vector3f>& points,
                                       const std::vector<int>& indices,
                                       const PlaneOptions& options) {
  check(options);
  for (const int index : indices) {
    if (index < 0 || static_cast<std::size_t>(index) >= points.size()) {
      throw std::invalid_argument("plane: index " + std::to_string(index) + " into " +
                                  std::to_string(points.size()) + " points");
    }
  }
  const auto max_points = static_cast<std::size_t>(options.max_scored_points);
  MsacPlane estimator(subsample(points, indices, max_points, options.ransac.seed), options);
  const auto found = ransac(estimator, options.ransac);
  if (!found.model) return std::nullopt;

  const auto for_each_inlier = [&](const Plane& plane, const auto& action) {
    const Eigen::Vector3f normal = plane.normal.cast<float>();
    const auto d = static_cast<float>(plane.d);
    const auto limit = static_cast<float>(options.inlier_distance_m);
    for (const int index : indices) {
      const Eigen::Vector3f& point = points[static_cast<std::size_t>(index)];
      if (std::abs(normal.dot(point) + d) < limit) action(point.cast<double>());
    }
  };
  PlaneFit fit;
  fit.plane = *found.model;
  PlaneSums sums(-fit.plane.d * fit.plane.normal);
  for_each_inlier(fit.plane, [&sums](const Eigen::Vector3d& point) { sums.add(point); });
  if (sums.count() < std::max(3, options.min_inliers)) return std::nullopt;
  if (const Plane refined = sums.fit(options.up); estimator.is_level(refined)) fit.plane = refined;

  double sum_sq = 0;
  for_each_inlier(fit.plane, [&](const Eigen::Vector3d& point) {
    const double distance = fit.plane.signed_distance(point);
    sum_sq += distance * distance;
    ++fit.num_inliers;
  });
  if (fit.num_inliers < options.min_inliers) return std::nullopt;
  fit.rmse_m = std::sqrt(sum_sq / std::max(1, fit.num_inliers));
  return fit;
}

}  // namespace lidar_upsampling
