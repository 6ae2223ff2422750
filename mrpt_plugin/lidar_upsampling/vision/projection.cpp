// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/vision/projection.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <stdexcept>

#include "lidar_upsampling/vision/distortion.h"

namespace lidar_upsampling {
namespace {

constexpr std::size_t kPointsPerChunk = 8192;

}  // namespace

void check(const CameraModel& model) {
  if (model.width <= 0 || model.height <= 0) {
    throw std::invalid_argument("camera model: picture of " + std::to_string(model.width) + " x " +
                                std::to_string(model.height) +
                                " pixels; is the image without calibration?");
  }
  if (!(model.fx > 0 && model.fy > 0)) {
    throw std::invalid_argument("camera model: focal lengths " + std::to_string(model.fx) + ", " +
                                std::to_string(model.fy) +
                                " px must be positive; is the image without calibration?");
  }
  bool finite = std::isfinite(model.fx) && std::isfinite(model.fy) && std::isfinite(model.cx) &&
                std::isfinite(model.cy);
  for (const double parameter : model.distortion) finite = finite && std::isfinite(parameter);
  if (!finite) throw std::invalid_argument("camera model: a parameter is not a finite number");
}

Projector::Projector(const CameraModel& model) : model_(model), max_radius_(valid_radius(model)) {}

std::optional<Eigen::Vector2d> Projector::operator()(const Eigen::Vector3d& point_in_camera,
                                                     double margin_px) const {
  if (!(point_in_camera.z() > kNearestDepth)) return std::nullopt;
  const Eigen::Vector2d normalised = point_in_camera.head<2>() / point_in_camera.z();
  if (!(normalised.squaredNorm() < max_radius_ * max_radius_)) return std::nullopt;
  const Eigen::Vector2d distorted = distort(model_, normalised).point;
  const double u = model_.fx * distorted.x() + model_.cx;
  const double v = model_.fy * distorted.y() + model_.cy;
  if (!(u >= margin_px && u <= model_.width - 1 - margin_px)) return std::nullopt;
  if (!(v >= margin_px && v <= model_.height - 1 - margin_px)) return std::nullopt;
  return Eigen::Vector2d(u, v);
}

std::optional<Eigen::Vector2d> project(const CameraModel& model,
                                       const Eigen::Vector3d& point_in_camera, double margin_px) {
  return Projector(model)(point_in_camera, margin_px);
}

std::optional<Eigen::Vector2d> undistort(const CameraModel& model, const Eigen::Vector2d& pixel) {
  const Eigen::Vector2d distorted((pixel.x() - model.cx) / model.fx,
                                  (pixel.y() - model.cy) / model.fy);
  return undistort_normalised(model, distorted, valid_radius(model));
}

std::vector<ProjectedPoint> project_scan(const CameraModel& model, const Pose& T_camera_lidar,
                                         const std::vector<Eigen::Vector3f>& points,
                                         double margin_px) {
  check(model);
  const Projector pixel_of(model);
  const std::size_t num_chunks = (points.size() + kPointsPerChunk - 1) / kPointsPerChunk;
  std::vector<std::vector<ProjectedPoint>> chunks(num_chunks);
  tbb::parallel_for(std::size_t{0}, num_chunks, [&](std::size_t chunk) {
    const std::size_t end = std::min(points.size(), (chunk + 1) * kPointsPerChunk);
    for (std::size_t i = chunk * kPointsPerChunk; i < end; ++i) {
      const Eigen::Vector3d point = T_camera_lidar * points[i].cast<double>();
      const auto pixel = pixel_of(point, margin_px);
      if (!pixel) continue;
      chunks[chunk].push_back({static_cast<int>(i), static_cast<float>(pixel->x()),
                               static_cast<float>(pixel->y()), static_cast<float>(point.z())});
    }
  });
  std::vector<ProjectedPoint> projected;
  for (const auto& chunk : chunks) projected.insert(projected.end(), chunk.begin(), chunk.end());
  return projected;
}

}  // namespace lidar_upsampling
