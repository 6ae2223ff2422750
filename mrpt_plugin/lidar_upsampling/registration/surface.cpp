// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/registration/surface.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>

namespace lidar_upsampling {

namespace {

constexpr float kSqFurther = 4;  // where points are dense: as many times the area

/// By its neighbours, the more of them the denser they lie.
Eigen::Vector3f normal_at(const PointIndex& index, const Eigen::Vector3f& point,
                          const NormalOptions& options) {
  thread_local std::vector<PointIndex::Neighbor> neighbors;  // made once
  index.nearest(point, options.num_neighbors, neighbors);
  // So near, it is the noise of their ranges that would be told.
  const auto sq_noisy = static_cast<float>(options.min_radius_m * options.min_radius_m);
  const float sq_farthest = neighbors.empty() ? 0 : neighbors.back().sq_distance;
  if (sq_farthest < sq_noisy) index.within(point, kSqFurther * sq_farthest, neighbors);
  const auto sq_radius = static_cast<float>(options.max_radius_m * options.max_radius_m);
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  Eigen::Matrix3f products = Eigen::Matrix3f::Zero();
  int count = 0;
  for (const auto& neighbor : neighbors) {
    if (neighbor.sq_distance <= sq_radius) {
      const Eigen::Vector3f offset = index.points()[neighbor.index] - point;
      sum += offset;
      products += offset * offset.transpose();
      ++count;
    }
  }
  if (count < 5) {
    return Eigen::Vector3f::Zero();
  }
  const Eigen::Vector3f mean = sum / count;
  const Eigen::Matrix3f scatter = products / count - mean * mean.transpose();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver;
  solver.computeDirect(scatter);
  const Eigen::Vector3f spread = solver.eigenvalues();
  const bool flat =
      spread[0] < options.max_flatness * spread[1] && spread[1] > options.min_width * spread[2];
  return flat ? Eigen::Vector3f(solver.eigenvectors().col(0)) : Eigen::Vector3f::Zero();
}

}  // namespace

std::vector<Eigen::Vector3f> evenly_thinned(const std::vector<Eigen::Vector3f>& points,
                                            std::size_t max_points) {
  if (points.size() <= max_points) return points;
  std::vector<Eigen::Vector3f> kept;
  kept.reserve(max_points);
  for (std::size_t i = 0; i < max_points; ++i)
    kept.push_back(points[i * points.size() / max_points]);
  return kept;
}

struct Surface::Known {
  enum State : std::uint8_t { unknown, under_way, ready };

  explicit Known(std::size_t size) : normals(size), states(size) {}

  std::vector<Eigen::Vector3f> normals;
  std::vector<std::atomic<std::uint8_t>> states;
};

Surface::Surface(std::vector<Eigen::Vector3f> points, const NormalOptions& options)
    : index_(std::move(points)),
      options_(options),
      known_(std::make_unique<Known>(index_.points().size())) {}
Surface::~Surface() = default;
Surface::Surface(Surface&&) noexcept = default;
Surface& Surface::operator=(Surface&&) noexcept = default;

Eigen::Vector3f Surface::normal(int point) const {
  std::atomic<std::uint8_t>& state = known_->states[point];
  if (state.load(std::memory_order_acquire) == Known::ready) return known_->normals[point];
  Eigen::Vector3f normal = normal_at(index_, points()[point], options_);
  // Whoever comes while another one writes goes on with its own.
  std::uint8_t expected = Known::unknown;
  if (state.compare_exchange_strong(expected, Known::under_way, std::memory_order_relaxed)) {
    known_->normals[point] = normal;
    state.store(Known::ready, std::memory_order_release);
  }
  return normal;
}

float Surface::spacing(int point) const {
  constexpr int kAround = 8;
  std::vector<PointIndex::Neighbor> neighbors;
  index_.nearest(points()[point], kAround, neighbors);
  if (neighbors.size() < 2) return std::numeric_limits<float>::infinity();
  const auto lies_beside = [&](const PointIndex::Neighbor& neighbor) {
    const Eigen::Vector3f step = points()[neighbor.index] - points()[point];
    return neighbor.index != point && std::abs(step.z()) <= step.head<2>().norm();
  };
  const auto beside = std::find_if(neighbors.begin(), neighbors.end(), lies_beside);
  return std::sqrt((beside != neighbors.end() ? *beside : neighbors.back()).sq_distance);
}

}  // namespace lidar_upsampling
