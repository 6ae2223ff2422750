// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "drawing.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <opencv2/imgproc.hpp>
#include <sstream>

#include "lidar_upsampling/vision/projection.h"
#include "lidar_upsampling/vision/visibility.h"

namespace lidar_upsampling {
namespace {

constexpr int kLevels = 256;
constexpr int kScaleHeight = 8, kMargin = 10;  // px
const cv::Scalar kTick(235, 235, 235);

cv::Mat depth_palette() {
  cv::Mat levels(kLevels, 1, CV_8UC1);
  for (int i = 0; i < kLevels; ++i)
    levels.at<std::uint8_t>(i) = static_cast<std::uint8_t>(kLevels - 1 - i);
  cv::Mat palette;
  cv::applyColorMap(levels, palette, cv::COLORMAP_TURBO);
  return palette;
}

/// Of a depth on the scale, 0 to 1; it is logarithmic.
double share_of(double depth, const DepthScale& scale) {
  const double share =
      std::log(depth / scale.nearest_m) / std::log(scale.farthest_m / scale.nearest_m);
  return std::clamp(share, 0., 1.);
}

cv::Scalar color_at(const cv::Mat& palette, double share) {
  const auto& color = palette.at<cv::Vec3b>(static_cast<int>(share * (kLevels - 1)));
  return {double(color[0]), double(color[1]), double(color[2])};
}

/// With its ticks' texts.
cv::Rect area_of_scale(const cv::Mat& picture) {
  constexpr int kTexts = 18;
  const int width = std::min(320, picture.cols / 3) + 3 * kMargin;
  return {picture.cols - width, picture.rows - kScaleHeight - kMargin - kTexts, width,
          kScaleHeight + kMargin + kTexts};
}

bool has_room_for_scale(const cv::Mat& picture) { return picture.rows >= 100; }

std::string metres(double depth) {
  std::ostringstream text;
  text << depth;
  return text.str();
}

void draw_scale(cv::Mat& picture, const cv::Mat& palette, const DepthScale& scale) {
  if (!has_room_for_scale(picture)) return;
  const int width = area_of_scale(picture).width - 3 * kMargin;
  const cv::Point corner(picture.cols - width - 3 * kMargin, picture.rows - kScaleHeight - kMargin);
  for (int u = 0; u < width; ++u)
    cv::line(picture, corner + cv::Point(u, 0), corner + cv::Point(u, kScaleHeight),
             color_at(palette, u / double(width - 1)));
  for (const double depth : {0.1, 0.2, 0.5, 1., 2., 3., 5., 10., 20., 40., 80.}) {
    if (depth < scale.nearest_m || depth > scale.farthest_m) continue;
    if (depth == 3 && scale.nearest_m < 3) continue;  // only as an end: 5 is near
    const cv::Point tick = corner + cv::Point(cvRound(share_of(depth, scale) * (width - 1)), 0);
    cv::line(picture, tick, tick - cv::Point(0, 3), kTick);
    const std::string unit = depth == scale.farthest_m ? " m" : "";
    draw_text(picture, metres(depth) + unit, tick - cv::Point(5, 7), 0.35, kTick);
  }
}

/// So that a text is read on whatever lies there.
void darken(cv::Mat& picture, const cv::Rect& area) {
  cv::Mat ground = picture(area & cv::Rect({0, 0}, picture.size()));
  ground *= 0.4;
}

}  // namespace

cv::Scalar color_of_track(int track) {
  constexpr double kGolden = 0.618034;
  const double turn = track * kGolden - std::floor(track * kGolden);
  const cv::Mat3b hsv(1, 1, cv::Vec3b(static_cast<std::uint8_t>(180 * turn), 160, 255));
  cv::Mat3b bgr;
  cv::cvtColor(hsv, bgr, cv::COLOR_HSV2BGR);
  return {double(bgr(0)[0]), double(bgr(0)[1]), double(bgr(0)[2])};
}

void draw_dot(cv::Mat& picture, double u, double v, double radius, const cv::Scalar& color) {
  constexpr int kShift = 4;  // sub-pixel bits
  constexpr double kUnit = 1 << kShift;
  cv::circle(picture, {cvRound(u * kUnit), cvRound(v * kUnit)}, cvRound(radius * kUnit), color,
             cv::FILLED, cv::LINE_AA, kShift);
}

void draw_text(cv::Mat& picture, const std::string& text, cv::Point at, double size,
               const cv::Scalar& color) {
  cv::putText(picture, text, at, cv::FONT_HERSHEY_SIMPLEX, size, {0, 0, 0}, 3, cv::LINE_AA);
  cv::putText(picture, text, at, cv::FONT_HERSHEY_SIMPLEX, size, color, 1, cv::LINE_AA);
}

void Labels::put(const std::string& text, cv::Point at, double size, const cv::Scalar& color) {
  constexpr int kStep = 4;  // px
  int below = 0;
  const cv::Size extent = cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, size, 1, &below);
  const int highest = extent.height + 2;
  const int lowest = std::max(highest, picture_.rows - below);
  at.x = std::clamp(at.x, 0, std::max(0, picture_.cols - extent.width));
  const auto area_at = [&](int y) {
    return cv::Rect(at.x - 2, y - extent.height - 2, extent.width + 4, extent.height + below + 2);
  };
  const auto is_free = [&](int y) {
    return y >= highest && y <= lowest &&
           std::none_of(taken_.begin(), taken_.end(),
                        [&](const cv::Rect& other) { return (other & area_at(y)).area() > 0; });
  };
  const int wanted = std::clamp(at.y, highest, lowest);
  at.y = wanted;
  for (int off = kStep; !is_free(at.y) && off < picture_.rows; off += kStep)
    at.y = is_free(wanted + off) ? wanted + off : is_free(wanted - off) ? wanted - off : wanted;
  taken_.push_back(area_at(at.y));
  darken(picture_, area_at(at.y));
  draw_text(picture_, text, at, size, color);
}

DepthScale DepthScale::for_scan(const LidarScan& scan) {
  constexpr double kFarthestToNearest = 80. / 3;
  const double farthest = range_of_nearly_all(scan);
  DepthScale scale;
  for (const double end : {40., 20., 10., 5., 2.})
    if (farthest > 0 && farthest <= end) scale = {end / kFarthestToNearest, end};
  return scale;
}

double range_of_nearly_all(const LidarScan& scan) {
  constexpr double kNearlyAll = 0.98;
  std::vector<double> ranges;
  for (const Eigen::Vector3f& point : scan.points) ranges.push_back(point.head<2>().norm());
  if (ranges.empty()) return 0;
  const auto nearly_last =
      ranges.begin() + static_cast<std::ptrdiff_t>(kNearlyAll * static_cast<double>(ranges.size()));
  std::nth_element(ranges.begin(), nearly_last, ranges.end());
  return *nearly_last;
}

std::string label_of(int track, double speed_m_s) {
  std::ostringstream text;
  text << '#' << track << ' ' << std::fixed << std::setprecision(1) << speed_m_s << " m/s";
  return text.str();
}

cv::Mat overlay(const LidarScan& scan, const CameraImage& image, const DepthScale& scale) {
  cv::Mat picture;
  if (image.bgr.empty())
    cv::cvtColor(image.gray, picture, cv::COLOR_GRAY2BGR);
  else
    image.bgr.copyTo(picture);
  picture *= 0.7;

  const Pose T_camera_lidar = image.camera.T_vehicle_camera.inverse() * scan.T_vehicle_lidar;
  auto points = project_scan(image.camera.model, T_camera_lidar, scan.points);
  const auto hidden = mark_occluded(points);
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (hidden[i] == 0) order.push_back(i);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return points[a].depth > points[b].depth; });
  const cv::Mat palette = depth_palette();
  for (const std::size_t i : order)
    draw_dot(picture, points[i].u, points[i].v, points[i].depth < 15 ? 1.5 : 1.1,
             color_at(palette, share_of(points[i].depth, scale)));
  draw_scale(picture, palette, scale);
  return picture;
}

cv::Mat on_image(const VirtualScan& scan, const CameraImage& image, const DepthScale& scale) {
  cv::Mat picture = overlay(scan.scan, image, scale);
  std::vector<const ObjectMotion*> movers;
  for (const ObjectMotion& object : scan.objects)
    if (moves(object) && object.camera_label == image.camera.label) movers.push_back(&object);
  for (const ObjectMotion* mover : movers)
    cv::rectangle(picture, cv::Point2d(mover->box.left, mover->box.top),
                  cv::Point2d(mover->box.right, mover->box.bottom), color_of_track(mover->track_id),
                  2, cv::LINE_AA);
  Labels labels(picture);
  if (has_room_for_scale(picture)) labels.keep_free(area_of_scale(picture));
  for (const ObjectMotion* mover : movers)
    labels.put(label_of(mover->track_id, mover->velocity_lidar_k.norm()),
               {cvRound(mover->box.left), cvRound(mover->box.top) - 5}, 0.45,
               color_of_track(mover->track_id));
  return picture;
}

}  // namespace lidar_upsampling
