// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/ground.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <queue>
#include <stdexcept>
#include <string>

#include "lidar_upsampling/objects/beam_step.h"
#include "lidar_upsampling/objects/feet.h"

namespace lidar_upsampling {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::infinity();
constexpr double kSeedRange = 20;  ///< m, plane cells within are where the ground is followed from
constexpr float kDeepest = -0.5F;  ///< m, echoes from mirrors and puddles lie further down
constexpr std::size_t kGrain = 8192;  ///< points per task

/// Square cells around the origin of a frame whose z is up.
class CellGrid {
 public:
  explicit CellGrid(const GroundOptions& options)
      : half_(static_cast<int>(std::ceil(options.max_range / options.cell_size))),
        size_(2 * half_ + 1),
        per_metre_(static_cast<float>(1 / options.cell_size)) {}

  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] int num_cells() const { return size_ * size_; }
  [[nodiscard]] bool contains(const Eigen::Vector3f& p) const {
    return std::max(std::abs(p.x()), std::abs(p.y())) * per_metre_ < static_cast<float>(half_);
  }
  [[nodiscard]] int cell_of(const Eigen::Vector3f& p) const {
    const float first_edge = static_cast<float>(half_) + 0.5F;
    return index(static_cast<int>(p.x() * per_metre_ + first_edge),
                 static_cast<int>(p.y() * per_metre_ + first_edge));
  }
  /// Distance of a cell's centre from the origin, in cells.
  [[nodiscard]] double range_of(int cell) const {
    return std::hypot(cell % size_ - half_, cell / size_ - half_);
  }

  /// Between the centres of the four cells around.
  [[nodiscard]] float interpolate(const std::vector<float>& values,
                                  const Eigen::Vector3f& p) const {
    // In this order what is no number becomes 0.
    const float most = static_cast<float>(size_) - 1.001F;
    const float x = std::max(0.F, std::min(column(p.x()), most));
    const float y = std::max(0.F, std::min(column(p.y()), most));
    const int ix = static_cast<int>(x);
    const int iy = static_cast<int>(y);
    const float fx = x - static_cast<float>(ix);
    const float fy = y - static_cast<float>(iy);
    const float* near = &values[index(ix, iy)];
    const float* far = near + size_;
    return (1 - fy) * ((1 - fx) * near[0] + fx * near[1]) + fy * ((1 - fx) * far[0] + fx * far[1]);
  }

 private:
  [[nodiscard]] float column(float x) const { return x * per_metre_ + static_cast<float>(half_); }
  [[nodiscard]] int index(int ix, int iy) const { return iy * size_ + ix; }

  int half_, size_;
  float per_metre_;
};

std::vector<Eigen::Vector3f> moved(const std::vector<Eigen::Vector3f>& points,
                                   const Eigen::Isometry3f& T) {
  std::vector<Eigen::Vector3f> result(points.size());
  std::transform(points.begin(), points.end(), result.begin(),
                 [&](const Eigen::Vector3f& point) { return T * point; });
  return result;
}

/// The lowest point of each cell in a frame whose z is up, -1 where a cell is empty.
struct LowestPoints {
  std::vector<int> index;
  std::vector<float> z;
};

LowestPoints lowest_points(const std::vector<Eigen::Vector3f>& points,
                           const std::vector<std::uint8_t>& left_out, const CellGrid& grid) {
  LowestPoints lowest{std::vector<int>(grid.num_cells(), -1),
                      std::vector<float>(grid.num_cells(), kUnknown)};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3f& p = points[i];
    if (!grid.contains(p) || (!left_out.empty() && left_out[i] != 0)) continue;
    const int cell = grid.cell_of(p);
    if (!(p.z() < lowest.z[cell])) continue;
    lowest.z[cell] = p.z();
    lowest.index[cell] = static_cast<int>(i);
  }
  return lowest;
}

/// Rotates `up` to +Z and keeps the heading.
Eigen::Matrix3d level_rotation(const Eigen::Vector3d& up) {
  return Eigen::Quaterniond::FromTwoVectors(up, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

std::optional<Plane> near_plane(const LidarScan& scan, const CellGrid& grid,
                                const GroundOptions& options) {
  PlaneOptions plane_options;
  plane_options.up = scan.T_vehicle_lidar.linear().transpose() * Eigen::Vector3d::UnitZ();
  plane_options.max_tilt_deg = options.max_tilt_deg;
  plane_options.inlier_distance_m = options.plane_tolerance;
  plane_options.min_inliers = options.min_plane_cells;
  Eigen::Isometry3f T_up_lidar = Eigen::Isometry3f::Identity();
  T_up_lidar.linear() = level_rotation(plane_options.up).cast<float>();
  std::vector<Eigen::Vector3f> low;
  for (const int point : lowest_points(moved(scan.points, T_up_lidar), {}, grid).index) {
    if (point >= 0 && scan.points[point].norm() < options.plane_range)
      low.push_back(scan.points[point]);
  }
  const auto plane = estimate_plane(low, plane_options);
  // Seen from below it would be a ceiling.
  if (!plane || plane->d <= 0 || plane->d > options.max_sensor_height) return std::nullopt;
  return plane;
}

/// Follows the ground from cell to cell, those first that lie nearest to ground already found, so
/// that it goes round an object before it looks behind.
class GroundFlood {
 public:
  GroundFlood(const CellGrid& grid, const std::vector<float>& low, const GroundOptions& options)
      : grid_(grid), low_(low), options_(options), ground_(low.size(), kUnknown) {}

  std::vector<float> run() {
    seed();
    for (std::size_t gap = 0; gap < waiting_.size();) {
      if (waiting_[gap].empty()) {
        ++gap;
        continue;
      }
      const Reached reached = waiting_[gap].front();
      waiting_[gap].pop();
      if (ground_[reached.cell] == kUnknown && visit(reached, gap)) gap = 0;
    }
    return std::move(ground_);
  }

 private:
  struct Reached {
    int cell;
    float height;  ///< of the ground it was reached from
  };

  void seed() {
    const double max_cells = kSeedRange / options_.cell_size;
    for (const bool anywhere : {false, true}) {
      for (int cell = 0; cell < grid_.num_cells(); ++cell) {
        if (std::abs(low_[cell]) > options_.plane_tolerance) continue;
        if (anywhere || grid_.range_of(cell) < max_cells) push({cell, low_[cell]}, 0);
      }
      if (!waiting_.empty()) return;
    }
  }

  /// @return whether the ground was found there.
  bool visit(const Reached& reached, std::size_t gap) {
    const double distance = static_cast<double>(gap) * options_.cell_size;
    const double tolerance =
        std::min(options_.max_step + options_.max_slope * distance, options_.max_height_jump);
    const bool found = std::abs(low_[reached.cell] - reached.height) <= tolerance;
    ground_[reached.cell] = found ? low_[reached.cell] : reached.height;
    const std::size_t next_gap = found ? 1 : gap + 1;
    const int x = reached.cell % grid_.size();
    const int y = reached.cell / grid_.size();
    const float height = ground_[reached.cell];
    if (x > 0) push({reached.cell - 1, height}, next_gap);
    if (x + 1 < grid_.size()) push({reached.cell + 1, height}, next_gap);
    if (y > 0) push({reached.cell - grid_.size(), height}, next_gap);
    if (y + 1 < grid_.size()) push({reached.cell + grid_.size(), height}, next_gap);
    return found;
  }

  void push(const Reached& reached, std::size_t gap) {
    if (ground_[reached.cell] != kUnknown) return;
    if (gap >= waiting_.size()) waiting_.resize(gap + 1);
    waiting_[gap].push(reached);
  }

  const CellGrid& grid_;
  const std::vector<float>& low_;
  const GroundOptions& options_;
  std::vector<float> ground_;
  std::vector<std::queue<Reached>> waiting_;  ///< by the cells since ground was last found
};

void check(const GroundOptions& options) {
  if (!(options.cell_size > 0.1 && options.cell_size < 20 && options.max_range > 1 &&
        options.max_range / options.cell_size < 1000)) {
    throw std::invalid_argument("ground: cell_size " + std::to_string(options.cell_size) +
                                " m must lie in (0.1, 20) and max_range " +
                                std::to_string(options.max_range) + " m in (1, 1000 cells)");
  }
}

}  // namespace

Ground estimate_ground(const LidarScan& scan, const GroundOptions& options) {
  check(options);
  Ground ground;
  const CellGrid grid(options);
  const auto plane = near_plane(scan, grid, options);
  if (!plane) return ground;
  ground.status = GroundStatus::found;
  ground.plane = *plane;

  // z = 0 is the plane from here on.
  Eigen::Isometry3f T_plane_lidar = Eigen::Isometry3f::Identity();
  T_plane_lidar.linear() = level_rotation(plane->normal).cast<float>();
  T_plane_lidar.translation().z() = static_cast<float>(plane->d);
  const std::vector<Eigen::Vector3f> points = moved(scan.points, T_plane_lidar);
  constexpr float kAnyHill_m = 5;  // what lies farther off the plane is not asked, to save time
  const double step_deg =
      options.vertical_step_deg > 0 ? options.vertical_step_deg : estimate_vertical_step_deg(scan);
  const auto is_foot =
      find_feet(points, -kAnyHill_m, kAnyHill_m, step_deg, options.ground_thickness);
  const std::vector<float> low = lowest_points(points, is_foot, grid).z;
  const std::vector<float> local = GroundFlood(grid, low, options).run();

  ground.height.resize(scan.size());
  ground.is_ground.resize(scan.size());
  const auto thickness = static_cast<float>(options.ground_thickness);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, scan.size(), kGrain), [&](const auto& part) {
    for (std::size_t i = part.begin(); i < part.end(); ++i) {
      ground.height[i] = points[i].z() - grid.interpolate(local, points[i]);
      ground.is_ground[i] =
          is_foot[i] == 0 && ground.height[i] > kDeepest && ground.height[i] < thickness;
    }
  });
  return ground;
}

std::vector<Eigen::Vector3f> without_ground(const LidarScan& scan, const GroundOptions& options) {
  const Ground ground = estimate_ground(scan, options);
  std::vector<Eigen::Vector3f> points;
  for (std::size_t i = 0; i < scan.size(); ++i)
    if (ground.is_ground.empty() || ground.is_ground[i] == 0) points.push_back(scan.points[i]);
  return points;
}

}  // namespace lidar_upsampling
