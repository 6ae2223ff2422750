// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/tracks/faces.h"

#include <algorithm>
#include <cmath>

#include "lidar_upsampling/decompositions.h"

namespace lidar_upsampling {
namespace {

/// Zero where the points around are no line from above, or one no wider than a column of beams.
Eigen::Vector2f normal_from_above(const std::vector<Eigen::Vector3f>& points,
                                  const Eigen::Vector3f& at) {
  constexpr float kNear_m = 0.7F, kWide_m = 0.1F, kThickness = 0.15F;  // deviations, of the width
  Eigen::Vector2f sum = Eigen::Vector2f::Zero();
  Eigen::Matrix2f products = Eigen::Matrix2f::Zero();
  float count = 0;
  for (const Eigen::Vector3f& point : points) {
    const Eigen::Vector2f offset = (point - at).head<2>();
    if (offset.squaredNorm() > kNear_m * kNear_m) continue;
    sum += offset;
    products += offset * offset.transpose();
    ++count;
  }
  const Eigen::Vector2f mean = sum / count;
  const Eigen::Matrix2d scatter = (products / count - mean * mean.transpose()).cast<double>();
  const auto [spread, axes] = symmetric_eigen<2>(scatter);
  const bool is_line =
      spread[1] > kWide_m * kWide_m && spread[0] < kThickness * kThickness * spread[1];
  return is_line ? Eigen::Vector2f(axes.col(0).cast<float>()) : Eigen::Vector2f::Zero();
}

}  // namespace

Faces::Faces(const Surface& surface) {
  constexpr std::size_t kMost = 100;  // the share's deviation is 5 % at worst
  const std::size_t size = surface.points().size(), count = std::min(size, kMost);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t point = i * size / count;
    const Eigen::Vector3f normal = surface.normal(static_cast<int>(point));
    normals_.emplace_back(normal.isZero()
                              ? normal_from_above(surface.points(), surface.points()[point])
                              : Eigen::Vector2f(normal.head<2>()));
  }
}

double Faces::share_across(const Eigen::Vector2d& d) const {
  constexpr float kAcross = 0.5F;  // a normal within 60 degrees
  const auto lies_across = [&](const Eigen::Vector2f& normal) {
    return std::abs(normal.dot(d.cast<float>())) > kAcross;
  };
  return std::count_if(normals_.begin(), normals_.end(), lies_across) /
         static_cast<double>(normals_.size());
}

}  // namespace lidar_upsampling
