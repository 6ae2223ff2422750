// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "object_pictures.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "html.h"
#include "lidar_upsampling/vision/projection.h"
#include "palette.h"

namespace lidar_upsampling {

namespace {

constexpr int kShift = 4;  // sub-pixel bits of cv's drawing functions
const cv::Size kCropSize(640, 400);
constexpr int kMapSize = 560;  // pixels

cv::Scalar bgr_of(const std::string& color) {
  const auto channel = [&](std::size_t at) {
    return static_cast<double>(std::stoi(color.substr(at, 2), nullptr, 16));
  };
  return {channel(5), channel(3), channel(1)};
}

void draw_dot(cv::Mat& picture, const cv::Point2d& at, double radius, const cv::Scalar& color) {
  constexpr double kUnit = 1 << kShift;
  cv::circle(picture, {cvRound(at.x * kUnit), cvRound(at.y * kUnit)}, cvRound(radius * kUnit),
             color, cv::FILLED, cv::LINE_AA, kShift);
}

std::vector<cv::Point2d> pixels_of(const CameraImage& image, const Pose& T_vehicle_lidar,
                                   const Positions& points) {
  const Pose T_camera_lidar = image.camera.T_vehicle_camera.inverse() * T_vehicle_lidar;
  std::vector<cv::Point2d> pixels;
  for (const Eigen::Vector3d& point : points)
    if (const auto pixel = project(image.camera.model, T_camera_lidar * point))
      pixels.emplace_back(pixel->x(), pixel->y());
  return pixels;
}

/// The pixels with room around them, of the crop's shape and within the picture where it can be.
cv::Rect2d frame_around(const std::vector<cv::Point2d>& pixels, const cv::Size& picture) {
  const auto [left, right] = std::minmax_element(
      pixels.begin(), pixels.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
  const auto [top, bottom] = std::minmax_element(
      pixels.begin(), pixels.end(), [](const auto& a, const auto& b) { return a.y < b.y; });
  constexpr double kRoom = 2.6, kLeastWidth_px = 240;
  const double shape = static_cast<double>(kCropSize.width) / kCropSize.height;
  double width = std::max(
      {kRoom * (right->x - left->x), kRoom * shape * (bottom->y - top->y), kLeastWidth_px});
  width = std::min({width, static_cast<double>(picture.width), shape * picture.height});
  const double height = width / shape;
  const auto placed = [](double center, double size, int limit) {
    return std::clamp(center - size / 2, 0., std::max(0., limit - size));
  };
  return {placed((left->x + right->x) / 2, width, picture.width),
          placed((top->y + bottom->y) / 2, height, picture.height), width, height};
}

std::string encoded(const cv::Mat& picture, const char* ending, const char* mime_type,
                    const std::vector<int>& settings) {
  std::vector<std::uint8_t> bytes;
  if (!cv::imencode(ending, picture, bytes, settings))
    throw std::runtime_error("OpenCV cannot encode pictures as " + std::string(mime_type));
  return data_uri(mime_type, bytes);
}

void draw_grid(cv::Mat& map, const Window& window, double pixels_per_metre) {
  const int step = window.size_m > 24 ? 5 : window.size_m > 12 ? 2 : 1;
  const cv::Scalar line(233, 227, 221);
  for (int offset = -60; offset <= 60; offset += step) {
    const int at = cvRound(kMapSize / 2. + offset * pixels_per_metre);
    if (at < 0 || at >= kMapSize) continue;
    cv::line(map, {at, 0}, {at, kMapSize}, line);
    cv::line(map, {0, at}, {kMapSize, at}, line);
  }
  const int length = cvRound(step * pixels_per_metre);
  const cv::Point end(kMapSize - 12, kMapSize - 14);
  cv::line(map, end, end - cv::Point(length, 0), {80, 65, 50}, 4);
  const std::string text = std::to_string(step) + " m";
  const cv::Size extent = cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, 0.8, 2, nullptr);
  cv::putText(map, text, {end.x - (length + extent.width) / 2, end.y - 8}, cv::FONT_HERSHEY_SIMPLEX,
              0.8, {80, 65, 50}, 2, cv::LINE_AA);
}

}  // namespace

std::optional<cv::Mat> draw_on_crop(const CameraImage& image, const Pose& T_vehicle_lidar,
                                    const Positions& estimated, const Positions& reference) {
  const cv::Mat& photograph = image.bgr.empty() ? image.gray : image.bgr;
  if (photograph.empty()) return {};
  const auto ours = pixels_of(image, T_vehicle_lidar, estimated);
  const auto real = pixels_of(image, T_vehicle_lidar, reference);
  if (ours.empty() || real.empty()) return {};
  std::vector<cv::Point2d> all = real;
  all.insert(all.end(), ours.begin(), ours.end());
  const cv::Rect2d frame = frame_around(all, photograph.size());
  const double scale = kCropSize.width / frame.width;
  const cv::Matx23d to_crop(scale, 0, -scale * frame.x, 0, scale, -scale * frame.y);
  cv::Mat crop;
  cv::warpAffine(photograph, crop, to_crop, kCropSize, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  if (crop.channels() == 1) cv::cvtColor(crop, crop, cv::COLOR_GRAY2BGR);
  crop *= 0.85;
  // The fewer the points, the larger.
  const double radius = std::clamp(40 / std::sqrt(static_cast<double>(all.size())), 1.5, 3.);
  const auto draw = [&](const std::vector<cv::Point2d>& pixels, Row row, double size) {
    for (const cv::Point2d& pixel : pixels)
      draw_dot(crop, (pixel - frame.tl()) * scale, size, bgr_of(color_of(row)));
  };
  draw(real, Row::oracle, 1.35 * radius);
  draw(ours, Row::ours, 0.8 * radius);
  return crop;
}

Window window_around(const std::vector<const Positions*>& points) {
  Eigen::AlignedBox2d box;
  for (const Positions* positions : points)
    for (const Eigen::Vector3d& point : *positions) box.extend(point.head<2>());
  if (box.isEmpty()) return {};
  constexpr double kRoom_m = 2, kLeast_m = 5;
  return {box.center(), std::max(kLeast_m, box.sizes().maxCoeff() + kRoom_m)};
}

cv::Mat draw_from_above(const Window& window, const Positions& surroundings,
                        const Positions& points, const std::string& color) {
  cv::Mat map(kMapSize, kMapSize, CV_8UC3, cv::Scalar(252, 250, 248));
  const double scale = kMapSize / window.size_m;
  draw_grid(map, window, scale);
  const auto draw = [&](const Positions& positions, double radius, const cv::Scalar& ink) {
    for (const Eigen::Vector3d& point : positions) {
      const Eigen::Vector2d offset = point.head<2>() - window.center;
      if (offset.cwiseAbs().maxCoeff() < 0.5 * window.size_m)
        draw_dot(map, {kMapSize / 2. - offset.y() * scale, kMapSize / 2. - offset.x() * scale},
                 radius, ink);
    }
  };
  draw(surroundings, 2.6, {60, 50, 40});
  draw(points, 3, bgr_of(color));
  return map;
}

std::string jpeg_uri(const cv::Mat& picture) {
  return encoded(picture, ".jpg", "image/jpeg", {cv::IMWRITE_JPEG_QUALITY, 85});
}

std::string png_uri(const cv::Mat& picture) {
  return encoded(picture, ".png", "image/png", {cv::IMWRITE_PNG_COMPRESSION, 9});
}

}  // namespace lidar_upsampling
