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

constexpr double kNearest_m = 3, kFarthest_m = 80;  // of the scale of colours, logarithmic
constexpr int kLevels = 256;

cv::Mat depth_palette() {
  cv::Mat levels(kLevels, 1, CV_8UC1);
  for (int i = 0; i < kLevels; ++i)
    levels.at<std::uint8_t>(i) = static_cast<std::uint8_t>(kLevels - 1 - i);
  cv::Mat palette;
  cv::applyColorMap(levels, palette, cv::COLORMAP_TURBO);
  return palette;
}

/// Of a depth on the scale, 0 to 1.
double share_of(double depth) {
  const double share = std::log(depth / kNearest_m) / std::log(kFarthest_m / kNearest_m);
  return std::clamp(share, 0., 1.);
}

cv::Scalar color_at(const cv::Mat& palette, double share) {
  const auto& color = palette.at<cv::Vec3b>(static_cast<int>(share * (kLevels - 1)));
  return {double(color[0]), double(color[1]), double(color[2])};
}

void draw_scale(cv::Mat& picture, const cv::Mat& palette) {
  constexpr int kHeight = 8, kMargin = 10;
  const int width = std::min(320, picture.cols / 3);
  if (picture.rows < 100) return;
  const cv::Point corner(picture.cols - width - 3 * kMargin, picture.rows - kHeight - kMargin);
  for (int u = 0; u < width; ++u)
    cv::line(picture, corner + cv::Point(u, 0), corner + cv::Point(u, kHeight),
             color_at(palette, u / double(width - 1)));
  for (const int depth : {3, 5, 10, 20, 40, 80}) {
    const cv::Point tick = corner + cv::Point(cvRound(share_of(depth) * (width - 1)), 0);
    cv::line(picture, tick, tick - cv::Point(0, 3), {235, 235, 235});
    const std::string text = std::to_string(depth) + (depth == 80 ? " m" : "");
    draw_text(picture, text, tick - cv::Point(5, 7), 0.35, {235, 235, 235});
  }
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
  int below = 0;
  const cv::Size extent = cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, size, 1, &below);
  at.x = std::clamp(at.x, 0, std::max(0, picture_.cols - extent.width));
  at.y = std::clamp(at.y, extent.height + 2, std::max(extent.height + 2, picture_.rows - below));
  const auto area = [&] {
    return cv::Rect(at.x - 2, at.y - extent.height - 2, extent.width + 4,
                    extent.height + below + 4);
  };
  const auto is_taken = [&] {
    return std::any_of(taken_.begin(), taken_.end(),
                       [&](const cv::Rect& other) { return (other & area()).area() > 0; });
  };
  while (is_taken() && at.y < picture_.rows - below) at.y += 4;
  taken_.push_back(area());
  draw_text(picture_, text, at, size, color);
}

std::string label_of(int track, double speed_m_s) {
  std::ostringstream text;
  text << '#' << track << ' ' << std::fixed << std::setprecision(1) << speed_m_s << " m/s";
  return text.str();
}

cv::Mat overlay(const LidarScan& scan, const CameraImage& image) {
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
             color_at(palette, share_of(points[i].depth)));
  draw_scale(picture, palette);
  return picture;
}

cv::Mat on_image(const VirtualScan& scan, const CameraImage& image) {
  cv::Mat picture = overlay(scan.scan, image);
  Labels labels(picture);
  for (const ObjectMotion& object : scan.objects) {
    if (!moves(object) || object.camera_label != image.camera.label) continue;
    const cv::Scalar color = color_of_track(object.track_id);
    cv::rectangle(picture, cv::Point2d(object.box.left, object.box.top),
                  cv::Point2d(object.box.right, object.box.bottom), color, 2, cv::LINE_AA);
    labels.put(label_of(object.track_id, object.velocity_lidar_k.norm()),
               {cvRound(object.box.left), cvRound(object.box.top) - 5}, 0.45, color);
  }
  return picture;
}

}  // namespace lidar_upsampling
