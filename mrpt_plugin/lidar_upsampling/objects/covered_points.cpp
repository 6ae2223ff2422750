// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/covered_points.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lidar_upsampling/vision/projection.h"

namespace lidar_upsampling {

CoverMap::CoverMap(int width, int height, double cell_width_px, double cell_height_px)
    : cell_width_px_(cell_width_px),
      cell_height_px_(cell_height_px),
      columns_(static_cast<int>(width / cell_width_px) + 1),
      rows_(static_cast<int>(height / cell_height_px) + 1),
      cells_(static_cast<std::size_t>(columns_) * rows_,
             Cell{std::numeric_limits<float>::infinity(), -1}) {}

void CoverMap::add(const Eigen::Vector2d& pixel, double depth_m, int owner) {
  const auto column = static_cast<int>(std::floor(pixel.x() / cell_width_px_));
  const auto row = static_cast<int>(std::floor(pixel.y() / cell_height_px_));
  if (column < 0 || column >= columns_ || row < 0 || row >= rows_) return;
  Cell& cell = cells_[static_cast<std::size_t>(row) * columns_ + column];
  if (depth_m < cell.depth_m) cell = {static_cast<float>(depth_m), owner};
}

bool CoverMap::covers(const Eigen::Vector2d& pixel, double depth_m,
                      const std::vector<std::uint8_t>& companions, double min_nearer_m) const {
  const auto column = static_cast<int>(std::floor(pixel.x() / cell_width_px_));
  const auto row = static_cast<int>(std::floor(pixel.y() / cell_height_px_));
  for (int r = std::max(0, row - 1); r <= std::min(rows_ - 1, row + 1); ++r)
    for (int c = std::max(0, column - 1); c <= std::min(columns_ - 1, column + 1); ++c) {
      const Cell& cell = cells_[static_cast<std::size_t>(r) * columns_ + c];
      if (cell.owner >= 0 && companions[cell.owner] == 0 && cell.depth_m + min_nearer_m < depth_m)
        return true;
    }
  return false;
}

std::vector<Correspondence> without_covered(const std::vector<Correspondence>& correspondences,
                                            const CoverMap& map, const CameraModel& camera,
                                            const Pose& T_camera_t_source,
                                            const std::vector<std::uint8_t>& companions) {
  constexpr double kNearer_m = 1.5;
  std::vector<Correspondence> kept;
  kept.reserve(correspondences.size());
  for (const Correspondence& pair : correspondences) {
    const Eigen::Vector3d point = T_camera_t_source * pair.point_in_source;
    const auto expected = project(camera, point);
    if (!map.covers(pair.pixel, point.z(), companions, kNearer_m) &&
        !(expected && map.covers(*expected, point.z(), companions, kNearer_m)))
      kept.push_back(pair);
  }
  return kept;
}

}  // namespace lidar_upsampling
