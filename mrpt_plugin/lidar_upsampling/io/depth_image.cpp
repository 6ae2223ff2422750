// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/io/scan_classes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "lidar_upsampling/io/images.h"
#include "lidar_upsampling/vision/projection.h"

namespace lidar_upsampling {
namespace {

constexpr float kSteepest = 8;        // depth per width of a surface: seen under 7 degrees
constexpr float kNoise_m = 0.01F;     // in neighbours' depths
constexpr float kLargestStretch = 4;  // pixels between what were neighbours
constexpr double kMargin_px = -4;     // surfaces may reach into the picture from outside
constexpr float kEdge = 1e-4F;        // neither gaps nor seams where triangles meet

// One vertex per cell of the key scan's picture; depth 0 where there is none.
struct Vertex {
  float u = 0, v = 0, depth = 0, intensity = 0;
  bool drawn = false;
};

// Twice the area of a triangle, with its sense of rotation.
float turn(const Vertex& a, const Vertex& b, float u, float v) {
  return (b.u - a.u) * (v - a.v) - (b.v - a.v) * (u - a.u);
}

// What a camera in the place of the sensor sees of a scan.
class SurfacePainter {
 public:
  SurfacePainter(const CameraModel& model, bool with_intensity)
      : depth(cv::Mat1f::zeros(model.height, model.width)),
        step_(1 / static_cast<float>(std::min(model.fx, model.fy))) {
    if (with_intensity) intensity = cv::Mat1f::zeros(model.height, model.width);
  }

  // The two triangles of four neighbouring cells, along the diagonal that is no edge.
  void paint(std::array<Vertex*, 4> corners) {  // clockwise
    const std::size_t first = joined(*corners[0], *corners[2]) ? 0 : 1;
    paint(*corners[first], *corners[first + 1], *corners[first + 2]);
    paint(*corners[first], *corners[first + 2], *corners[(first + 3) % 4]);
  }

  // Single points, and in the cracks along depth edges the points beside them.
  void paint_points(const std::vector<Vertex>& vertices) {
    const cv::Mat covered = depth > 0;
    for (const Vertex& point : vertices) {
      const auto x = static_cast<int>(std::lround(point.u));
      const auto y = static_cast<int>(std::lround(point.v));
      if (point.depth == 0 || !contains(x, y)) continue;
      if (!point.drawn || covered.at<std::uint8_t>(y, x) == 0) {
        put(x, y, point.depth, point.intensity);
      }
    }
  }

  cv::Mat1f depth;      // metres along the optical axis; 0: nothing
  cv::Mat1f intensity;  // [0, 1]; empty if the scan has none

 private:
  [[nodiscard]] bool contains(int x, int y) const {
    return x >= 0 && y >= 0 && x < depth.cols && y < depth.rows;
  }

  [[nodiscard]] bool joined(const Vertex& a, const Vertex& b) const {
    if (a.depth == 0 || b.depth == 0) return false;
    const float nearest = std::min(a.depth, b.depth);
    return std::abs(a.depth - b.depth) <= kSteepest * step_ * nearest + kNoise_m &&
           std::abs(a.u - b.u) <= kLargestStretch && std::abs(a.v - b.v) <= kLargestStretch;
  }

  void paint(Vertex& a, Vertex& b, Vertex& c) {
    if (!joined(a, b) || !joined(b, c) || !joined(c, a)) return;
    a.drawn = b.drawn = c.drawn = true;
    const float area = turn(a, b, c.u, c.v);
    if (area == 0) return;
    const auto [left, right] = std::minmax({a.u, b.u, c.u});
    const auto [top, bottom] = std::minmax({a.v, b.v, c.v});
    for (int y = static_cast<int>(std::ceil(top - kEdge)); y <= bottom + kEdge; ++y) {
      for (int x = static_cast<int>(std::ceil(left - kEdge)); x <= right + kEdge; ++x) {
        const auto u = static_cast<float>(x), v = static_cast<float>(y);
        const float of_a = turn(b, c, u, v) / area, of_b = turn(c, a, u, v) / area;
        const float of_c = 1 - of_a - of_b;
        if (std::min({of_a, of_b, of_c}) < -kEdge) continue;
        put(x, y, 1 / (of_a / a.depth + of_b / b.depth + of_c / c.depth),
            of_a * a.intensity + of_b * b.intensity + of_c * c.intensity);
      }
    }
  }

  void put(int x, int y, float depth_there, float intensity_there) {
    if (!contains(x, y)) return;
    float& nearest = depth(y, x);
    if (nearest != 0 && nearest <= depth_there) return;
    nearest = depth_there;
    if (!intensity.empty()) intensity(y, x) = intensity_there;
  }

  float step_;  // between neighbouring pixels' rays
};

std::vector<Vertex> vertices_of(const LidarScan& scan, const CameraModel& model) {
  Pose T_camera_lidar = Pose::Identity();
  T_camera_lidar.linear() << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  std::vector<Vertex> vertices(scan.size());
  for (const ProjectedPoint& point : project_scan(model, T_camera_lidar, scan.points, kMargin_px)) {
    const auto i = static_cast<std::size_t>(point.index);
    vertices[i] = {point.u, point.v, point.depth, scan.intensity.empty() ? 0.F : scan.intensity[i],
                   false};
  }
  return vertices;
}

// The vertices of a scan's picture, row by row from above; `nothing` where nothing was measured.
std::vector<Vertex*> picture_of(const LidarScan& scan, std::vector<Vertex>& vertices,
                                Vertex& nothing) {
  if (scan.ring.size() != scan.size() || scan.column.size() != scan.size()) return {};
  std::vector<Vertex*> picture(
      static_cast<std::size_t>(scan.num_rings) * static_cast<std::size_t>(scan.num_columns),
      &nothing);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (scan.ring[i] >= scan.num_rings || scan.column[i] >= scan.num_columns) continue;
    const auto row = static_cast<std::size_t>(scan.num_rings - 1 - scan.ring[i]);
    picture[row * static_cast<std::size_t>(scan.num_columns) + scan.column[i]] = &vertices[i];
  }
  return picture;
}

/// Draws a scan whose rings and columns are the rows (from below) and columns of a picture:
/// triangles between neighbours, depth exact at each pixel's centre (perspective interpolation),
/// the nearest one in front. None lies across a depth edge. Points of no triangle, and those in a
/// crack along a depth edge, are drawn as one pixel.
/// @param model of a camera that looks along +X of the lidar frame, +Z up.
SurfacePainter draw_surface(const LidarScan& scan, const CameraModel& model) {
  SurfacePainter painter(model, !scan.intensity.empty());
  std::vector<Vertex> vertices = vertices_of(scan, model);
  Vertex nothing;
  const std::vector<Vertex*> picture = picture_of(scan, vertices, nothing);
  const auto columns = static_cast<std::size_t>(scan.num_columns);
  for (std::size_t corner = 0; corner + columns + 1 < picture.size(); ++corner) {
    if ((corner + 1) % columns == 0) continue;
    painter.paint({picture[corner], picture[corner + 1], picture[corner + columns + 1],
                   picture[corner + columns]});
  }
  painter.paint_points(vertices);
  return painter;
}

using mrpt::obs::CObservation3DRangeScan;

// Metres of range per metre of depth at a pixel.
double range_per_depth(const CameraModel& model, int row, int column, bool range_is_depth) {
  if (range_is_depth) return 1;
  const auto ray = undistort(model, Eigen::Vector2d(column, row));
  return ray ? std::hypot(1., ray->x(), ray->y()) : std::numeric_limits<double>::infinity();
}

void set_ranges(const cv::Mat1f& depth, const CameraModel& model,
                CObservation3DRangeScan& observation) {
  constexpr double kLargest = std::numeric_limits<std::uint16_t>::max();
  observation.hasRangeImage = true;
  observation.rangeImage_setSize(depth.rows, depth.cols);
  observation.rangeImage.fill(0);
  for (int row = 0; row < depth.rows; ++row) {
    for (int column = 0; column < depth.cols; ++column) {
      const double x = depth(row, column);
      if (x == 0) continue;
      const double steps =
          std::round(x * range_per_depth(model, row, column, observation.range_is_depth) /
                     static_cast<double>(observation.rangeUnits));
      // What the unit cannot express is no return.
      if (steps <= kLargest) {
        observation.rangeImage(row, column) = static_cast<std::uint16_t>(steps);
      }
    }
  }
}

bool shows_intensity_of_points(const CObservation3DRangeScan& like) {
  return like.hasIntensityImage && like.doDepthAndIntensityCamerasCoincide() &&
         like.cameraParamsIntensity.ncols == like.cameraParams.ncols &&
         like.cameraParamsIntensity.nrows == like.cameraParams.nrows;
}

}  // namespace

bool is_depth_image(const CObservation3DRangeScan& observation) {
  return observation.hasRangeImage && is_calibrated(from_mrpt(observation.cameraParams));
}

CObservation3DRangeScan::Ptr make_depth_image(const LidarScan& scan,
                                              const CObservation3DRangeScan& like,
                                              bool with_points) {
  const CameraModel model = from_mrpt(like.cameraParams);
  auto observation = CObservation3DRangeScan::Create();
  observation->cameraParams = like.cameraParams;
  observation->cameraParamsIntensity = like.cameraParamsIntensity;
  observation->relativePoseIntensityWRTDepth = like.relativePoseIntensityWRTDepth;
  observation->maxRange = like.maxRange;
  observation->stdError = like.stdError;
  observation->rangeUnits = like.rangeUnits;
  observation->range_is_depth = like.range_is_depth;

  const SurfacePainter surface = draw_surface(scan, model);
  set_ranges(surface.depth, model, *observation);
  if (!scan.intensity.empty() && shows_intensity_of_points(like)) {
    cv::Mat gray;
    surface.intensity.convertTo(gray, CV_8U, 255.);
    observation->hasIntensityImage = true;
    observation->intensityImage = mrpt::img::CImage(gray, mrpt::img::DEEP_COPY);
  }
  if (with_points) observation->unprojectInto(*observation);
  return observation;
}

}  // namespace lidar_upsampling
