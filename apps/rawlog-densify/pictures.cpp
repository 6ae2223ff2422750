// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "pictures.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <stdexcept>

#include "lidar_upsampling/vision/projection.h"
#include "lidar_upsampling/vision/visibility.h"

namespace lidar_upsampling {
namespace {

constexpr int kShift = 4;  // sub-pixel bits of cv's drawing functions
const cv::Scalar kText(235, 235, 235);

cv::Scalar color_of_track(int track) {
  // The golden angle keeps neighbouring ids apart.
  const cv::Mat3b hsv(1, 1, cv::Vec3b(static_cast<std::uint8_t>((track * 67) % 180), 200, 255));
  cv::Mat3b bgr;
  cv::cvtColor(hsv, bgr, cv::COLOR_HSV2BGR);
  return {double(bgr(0)[0]), double(bgr(0)[1]), double(bgr(0)[2])};
}

void draw_dot(cv::Mat& picture, double u, double v, double radius, const cv::Scalar& color) {
  constexpr double kUnit = 1 << kShift;
  cv::circle(picture, {cvRound(u * kUnit), cvRound(v * kUnit)}, cvRound(radius * kUnit), color,
             cv::FILLED, cv::LINE_AA, kShift);
}

void draw_text(cv::Mat& picture, const std::string& text, cv::Point at, double size,
               const cv::Scalar& color) {
  cv::putText(picture, text, at, cv::FONT_HERSHEY_SIMPLEX, size, {0, 0, 0}, 3, cv::LINE_AA);
  cv::putText(picture, text, at, cv::FONT_HERSHEY_SIMPLEX, size, color, 1, cv::LINE_AA);
}

std::string speed_text(const ObjectMotion& object) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(1) << object.velocity_lidar_k.norm() << " m/s";
  return text.str();
}

// Depth to colour: red near, blue far, on a logarithmic scale from 3 to 80 m.
cv::Mat depth_palette() {
  cv::Mat levels(256, 1, CV_8UC1);
  for (int i = 0; i < 256; ++i) levels.at<std::uint8_t>(i) = static_cast<std::uint8_t>(255 - i);
  cv::Mat palette;
  cv::applyColorMap(levels, palette, cv::COLORMAP_TURBO);
  return palette;
}

cv::Scalar color_of_depth(const cv::Mat& palette, double depth) {
  const double share = std::log(std::max(depth, 3.) / 3) / std::log(80. / 3);
  const auto& color = palette.at<cv::Vec3b>(std::min(255, static_cast<int>(share * 255)));
  return {double(color[0]), double(color[1]), double(color[2])};
}

cv::Mat on_image(const VirtualScan& scan, const CameraImage& image) {
  cv::Mat picture = overlay(scan.scan, image);
  for (const ObjectMotion& object : scan.objects) {
    if (!moves(object) || object.camera_label != image.camera.label) continue;
    const cv::Scalar color = color_of_track(object.track_id);
    cv::rectangle(picture, cv::Point2d(object.box.left, object.box.top),
                  cv::Point2d(object.box.right, object.box.bottom), color, 2, cv::LINE_AA);
    draw_text(picture, speed_text(object),
              {cvRound(object.box.left), std::max(12, cvRound(object.box.top) - 5)}, 0.45, color);
  }
  return picture;
}

/// The ground from above: x forward is up, y left is left.
struct Map {
  static constexpr double kPixelsPerMetre = 14;
  static constexpr double kAhead = 62, kBehind = 10, kAside = 32;
  cv::Mat picture{cvRound((kAhead + kBehind) * kPixelsPerMetre),
                  cvRound(2 * kAside * kPixelsPerMetre), CV_8UC3, cv::Scalar(24, 20, 18)};

  [[nodiscard]] static cv::Point2d at(const Eigen::Vector3d& p) {
    return {(kAside - p.y()) * kPixelsPerMetre, (kAhead - p.x()) * kPixelsPerMetre};
  }
  void dot(const Eigen::Vector3d& p, double radius, const cv::Scalar& color) {
    const cv::Point2d pixel = at(p);
    if (pixel.x < 0 || pixel.y < 0 || pixel.x >= picture.cols || pixel.y >= picture.rows) return;
    draw_dot(picture, pixel.x, pixel.y, radius, color);
  }
};

void draw_grid(Map& map) {
  const cv::Scalar line(58, 50, 46);
  for (int range = 10; range <= 70; range += 10) {
    cv::circle(map.picture, Map::at({0, 0, 0}), cvRound(range * Map::kPixelsPerMetre), line, 1,
               cv::LINE_AA);
    if (range <= 60)
      cv::putText(map.picture, std::to_string(range) + " m", Map::at({double(range) + 0.3, 0.8, 0}),
                  cv::FONT_HERSHEY_SIMPLEX, 0.4, {120, 110, 105}, 1, cv::LINE_AA);
  }
  const std::vector<cv::Point> vehicle{Map::at({2.2, 0, 0}), Map::at({-1.5, 1, 0}),
                                       Map::at({-0.8, 0, 0}), Map::at({-1.5, -1, 0})};
  cv::fillPoly(map.picture, std::vector<std::vector<cv::Point>>{vehicle}, {240, 240, 240},
               cv::LINE_AA);
}

void draw_legend(Map& map, const VirtualScan& scan) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(0) << "virtual scan, "
       << seconds_between(scan.key_stamp, scan.scan.stamp) * 1e3 << " ms after the real one";
  draw_text(map.picture, text.str(), {16, 28}, 0.6, kText);
  draw_text(map.picture, "gray: last real scan", {16, 52}, 0.5, {170, 170, 170});
  draw_text(map.picture, "colour: moving objects, their trails and speeds", {16, 74}, 0.5,
            {140, 220, 255});
}

std::string numbered(int number, const std::string& what) {
  std::ostringstream name;
  name << std::setw(4) << std::setfill('0') << number << '_' << what << ".png";
  return name.str();
}

}  // namespace

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
             color_of_depth(palette, points[i].depth));
  return picture;
}

Pictures::Pictures(std::string folder) : folder_(std::move(folder)) {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error) throw std::runtime_error(folder_ + ": cannot make this folder: " + error.message());
}

void Pictures::virtual_scan(const VirtualScan& scan) {
  constexpr double kSameInstant_s = 0.01;
  remember_trails(scan);
  for (const auto& [label, image] : images_)
    if (std::abs(seconds_between(image.stamp, scan.scan.stamp)) < kSameInstant_s)
      write(numbered(number_, label), on_image(scan, image));
  write(numbered(number_, "from_above"), from_above(scan));
  ++number_;
}

void Pictures::remember_trails(const VirtualScan& scan) {
  for (const ObjectMotion& object : scan.objects) {
    if (!moves(object)) continue;
    trails_[object.track_id].push_back(
        {scan.scan.stamp,
         scan.T_rest_lidar_t * (object.T_lidar_t_lidar_k * object.centroid_lidar_k)});
  }
}

cv::Mat Pictures::from_above(const VirtualScan& scan) const {
  constexpr double kHighest_m = 2.5;  // roofs and trees would cover the road
  Map map;
  draw_grid(map);
  for (const auto& point : real_.points)
    if (point.z() < kHighest_m) map.dot(point.cast<double>(), 0.6, {92, 84, 80});
  std::map<int, bool> moving;
  for (const ObjectMotion& object : scan.objects) moving[object.track_id] = moves(object);
  for (std::size_t i = 0; i < scan.scan.size(); ++i) {
    const auto& point = scan.scan.points[i];
    if (point.z() >= kHighest_m) continue;
    const auto object = moving.find(scan.track_id[i]);
    const bool is_moving = object != moving.end() && object->second;
    map.dot(point.cast<double>(), is_moving ? 1.6 : 0.6,
            is_moving ? color_of_track(scan.track_id[i]) : cv::Scalar(190, 160, 120));
  }

  const Pose T_lidar_t_rest = scan.T_rest_lidar_t.inverse();
  for (const auto& [track, trail] : trails_)
    for (std::size_t i = 1; i < trail.size(); ++i)
      cv::line(map.picture, Map::at(T_lidar_t_rest * trail[i - 1].position_at_rest),
               Map::at(T_lidar_t_rest * trail[i].position_at_rest), color_of_track(track), 2,
               cv::LINE_AA);
  for (const ObjectMotion& object : scan.objects) {
    if (!moves(object)) continue;
    const Eigen::Vector3d center = object.T_lidar_t_lidar_k * object.centroid_lidar_k;
    const Eigen::Vector3d tip =
        center + scan.T_lidar_t_lidar_k.linear() * object.velocity_lidar_k * 0.5;
    const cv::Scalar color = color_of_track(object.track_id);
    cv::arrowedLine(map.picture, Map::at(center), Map::at(tip), color, 2, cv::LINE_AA, 0, 0.2);
    draw_text(map.picture, speed_text(object), Map::at(center + Eigen::Vector3d(0, -1.6, 0)), 0.45,
              color);
  }
  draw_legend(map, scan);
  return map.picture;
}

void Pictures::write(const std::string& name, const cv::Mat& picture) const {
  const auto path = std::filesystem::path(folder_) / name;
  if (!cv::imwrite(path.string(), picture))
    throw std::runtime_error(path.string() + ": cannot be written");
}

}  // namespace lidar_upsampling
