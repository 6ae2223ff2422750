// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/anchored_scan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lidar_upsampling/objects/beam_step.h"
#include "lidar_upsampling/units.h"

namespace lidar_upsampling {
namespace {

constexpr std::int16_t kOthers = std::numeric_limits<std::int16_t>::max();  // no object's surface

/// What is painted for a point: the surface that it shows, where its place may be.
struct Spot {
  float depth;
  std::int16_t label;
  cv::Rect place;
};

/// Where patches about the objects' points lie, in squares of the picture.
class PatchPlaces {
 public:
  PatchPlaces(const std::vector<std::vector<ProjectedPoint>>& objects, const cv::Size& size)
      : squares_(cv::Mat1b::zeros(size.height / kSide_px + 1, size.width / kSide_px + 1)),
        picture_({}, size) {
    constexpr int kReach = kPatchHalf_px + 1;
    for (const auto& points : objects)
      for (const ProjectedPoint& point : points) {
        const cv::Point corner(cvRound(point.u) - kReach, cvRound(point.v) - kReach);
        const cv::Rect patch = cv::Rect(corner, cv::Size(2 * kReach + 1, 2 * kReach + 1));
        for_each_square(patch & picture_, [](std::uint8_t& square) { square = 1; });
      }
  }

  [[nodiscard]] bool touch(const cv::Rect& place) {
    std::uint8_t any = 0;
    for_each_square(place, [&](std::uint8_t square) { any |= square; });
    return any != 0;
  }

 private:
  static constexpr int kSide_px = 8;

  template <typename Action>
  void for_each_square(const cv::Rect& place, const Action& action) {
    if (place.empty()) return;
    const int right = (place.br().x - 1) / kSide_px, bottom = (place.br().y - 1) / kSide_px;
    for (int y = place.y / kSide_px; y <= bottom; ++y)
      for (int x = place.x / kSide_px; x <= right; ++x) action(squares_(y, x));
  }

  cv::Mat1b squares_;
  cv::Rect picture_;
};

void paint(const Spot& spot, cv::Mat& label) {
  for (int v = spot.place.y; v < spot.place.br().y; ++v)
    std::fill_n(label.ptr<std::int16_t>(v) + spot.place.x, spot.place.width, spot.label);
}

}  // namespace

Neighbourhood sampling_of(const LidarScan& scan, const CameraModel& camera) {
  constexpr double kFinest_px = 5;
  Neighbourhood result{kFinest_px, 7};
  if (scan.num_rings < 2 || scan.ring.empty()) return result;
  double lowest = M_PI, highest = -M_PI;
  for (std::size_t i = 0; i < scan.size(); i += 16) {
    const Eigen::Vector3f& point = scan.points[i];
    const double elevation = std::atan2(point.z(), std::hypot(point.x(), point.y()));
    lowest = std::min(lowest, elevation);
    highest = std::max(highest, elevation);
  }
  const double ring_step_px = camera.fy * std::max(0., highest - lowest) / (scan.num_rings - 1);
  result.half_height_px = std::clamp(1.3 * ring_step_px, kFinest_px, 60.);
  if (const auto step = estimate_horizontal_step_deg(scan))
    result.half_width_px = std::clamp(2.6 * camera.fx * *step * kDegree, kFinest_px, 30.);
  return result;
}

AnchoredScan anchor_scan(const LidarScan& scan, const CameraModel& camera,
                         const Pose& T_camera_lidar_a) {
  AnchoredScan result;
  result.points = project_scan(camera, T_camera_lidar_a, scan.points);
  result.sampling = sampling_of(scan, camera);
  Visibility visibility = mark_visibility(result.points, result.sampling);
  result.hidden = std::move(visibility.hidden);
  result.on_edge = std::move(visibility.on_edge);
  result.position.assign(scan.size(), -1);
  for (std::size_t i = 0; i < result.points.size(); ++i)
    result.position[result.points[i].index] = static_cast<int>(i);
  return result;
}

std::vector<ProjectedPoint> visible_points(const AnchoredScan& anchored) {
  std::vector<ProjectedPoint> visible;
  for (std::size_t i = 0; i < anchored.points.size(); ++i)
    if (anchored.hidden[i] == 0) visible.push_back(anchored.points[i]);
  return visible;
}

std::vector<ProjectedPoint> followable_points(const AnchoredScan& anchored,
                                              const std::vector<int>& object, int min_points) {
  std::vector<ProjectedPoint> inner, all;
  for (const int i : object) {
    const int position = anchored.position[i];
    if (position < 0 || anchored.hidden[position] != 0) continue;
    all.push_back(anchored.points[position]);
    if (anchored.on_edge[position] == 0) inner.push_back(anchored.points[position]);
  }
  return static_cast<int>(inner.size()) >= min_points ? inner : all;
}

std::vector<ProjectedPoint> reprojected(const std::vector<ProjectedPoint>& points,
                                        const LidarScan& scan, const CameraModel& camera,
                                        const Pose& T_camera_a_lidar_k) {
  const Projector pixel_of(camera);
  std::vector<ProjectedPoint> moved;
  for (ProjectedPoint point : points) {
    const Eigen::Vector3d p = T_camera_a_lidar_k * scan.points[point.index].cast<double>();
    const auto pixel = pixel_of(p);
    if (!pixel) continue;
    point.u = static_cast<float>(pixel->x());
    point.v = static_cast<float>(pixel->y());
    moved.push_back(point);
  }
  return moved;
}

SurfaceMap surfaces_on(const AnchoredScan& anchored,
                       const std::vector<std::vector<ProjectedPoint>>& objects,
                       const cv::Size& size) {
  // A point's edge may lie anywhere until the next ring and azimuth step; the neighbourhood holds
  // them with 1.3 and 2.6 times the room.
  const double half_width = anchored.sampling.half_width_px / 2.6;
  const double half_height = anchored.sampling.half_height_px / 1.3;
  const cv::Rect picture({}, size);
  PatchPlaces patches(objects, size);
  std::vector<Spot> spots;
  const auto add = [&](const ProjectedPoint& point, std::int16_t label) {
    const cv::Point low(cvRound(point.u - half_width), cvRound(point.v - half_height));
    const cv::Point high(cvRound(point.u + half_width), cvRound(point.v + half_height));
    const cv::Rect place = cv::Rect(low, high + cv::Point(1, 1)) & picture;
    if (patches.touch(place)) spots.push_back({point.depth, label, place});
  };
  std::vector<std::uint8_t> is_other(anchored.points.size(), 1);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    for (const ProjectedPoint& point : objects[i]) {
      add(point, static_cast<std::int16_t>(std::min<std::size_t>(i, kOthers - 1)));
      is_other[anchored.position[point.index]] = 0;
    }
  }
  for (std::size_t i = 0; i < is_other.size(); ++i)
    if (is_other[i] != 0 && anchored.hidden[i] == 0) add(anchored.points[i], kOthers);
  // What is near is painted over what is behind it.
  std::stable_sort(spots.begin(), spots.end(),
                   [](const Spot& a, const Spot& b) { return a.depth > b.depth; });
  SurfaceMap map{cv::Mat(size, CV_16S, cv::Scalar(SurfaceMap::kUnknown))};
  for (const Spot& spot : spots) paint(spot, map.label);
  return map;
}

}  // namespace lidar_upsampling
