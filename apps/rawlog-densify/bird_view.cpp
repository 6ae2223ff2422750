// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "bird_view.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <opencv2/imgproc.hpp>
#include <set>
#include <sstream>

#include "drawing.h"

namespace lidar_upsampling {
namespace {

const cv::Scalar kGround(24, 20, 18), kText(235, 235, 235), kReal(92, 84, 80),
    kPoint(190, 160, 120);
constexpr float kHighest_m = 2.5F;  // roofs and trees would cover the road

double step_of_rings(const BirdView& view) {
  return view.ahead_m > 30 ? 10 : view.ahead_m > 12 ? 5 : 1;
}

void draw_grid(cv::Mat& picture, const BirdView& view) {
  const cv::Scalar line(58, 50, 46);
  const double step = step_of_rings(view), farthest = view.ahead_m + view.behind_m;
  for (double range = step; range <= farthest; range += step) {
    cv::circle(picture, view.at({0, 0, 0}), cvRound(range * view.pixels_per_m), line, 1,
               cv::LINE_AA);
    if (range > view.ahead_m) continue;
    const cv::Point2d at = view.at({range, 0, 0}) + cv::Point2d(4, -4);
    cv::putText(picture, std::to_string(cvRound(range)) + " m", at, cv::FONT_HERSHEY_SIMPLEX, 0.4,
                {120, 110, 105}, 1, cv::LINE_AA);
  }
  const double size = 11 / view.pixels_per_m;  // of the vehicle's arrow
  const auto corner = [&](double x, double y) {
    return cv::Point(view.at({x * size, y * size, 0}));
  };
  const std::vector<cv::Point> vehicle{corner(1, 0), corner(-0.7, 0.5), corner(-0.4, 0),
                                       corner(-0.7, -0.5)};
  cv::fillPoly(picture, std::vector<std::vector<cv::Point>>{vehicle}, {240, 240, 240}, cv::LINE_AA);
}

void draw_view_of(cv::Mat& picture, const Camera& camera, const Pose& T_vehicle_lidar,
                  const BirdView& view) {
  const CameraModel& model = camera.model;
  if (!(model.fx > 0)) return;
  const Pose T_lidar_camera = T_vehicle_lidar.inverse() * camera.T_vehicle_camera;
  for (const double u : {0., double(model.width)}) {
    const Eigen::Vector3d ray =
        T_lidar_camera.linear() * Eigen::Vector3d((u - model.cx) / model.fx, 0, 1).normalized();
    const Eigen::Vector3d from = T_lidar_camera.translation();
    const double far = view.ahead_m + view.behind_m + view.aside_m;
    cv::line(picture, view.at(from), view.at(from + far * ray), {95, 85, 60}, 1, cv::LINE_AA);
  }
}

void draw_points(cv::Mat& picture, const BirdView& view, const BirdScene& scene) {
  const cv::Rect inside({0, 0}, picture.size());
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    if (scene.points[i].z() >= kHighest_m) continue;
    const cv::Point2d at = view.at(scene.points[i].cast<double>());
    if (!inside.contains(cv::Point(at))) continue;
    const int track = scene.mover_of[i];
    draw_dot(picture, at.x, at.y, track < 0 ? 0.6 : 1.6,
             track < 0 ? kPoint : color_of_track(track));
  }
}

void draw_before(cv::Mat& picture, const BirdView& view, const LidarScan& before) {
  const cv::Rect inside({0, 0}, picture.size());
  for (const Eigen::Vector3f& point : before.points) {
    const cv::Point2d at = view.at(point.cast<double>());
    if (point.z() < kHighest_m && inside.contains(cv::Point(at)))
      draw_dot(picture, at.x, at.y, 0.6, kReal);
  }
}

void draw_mover(cv::Mat& picture, const BirdView& view, const BirdScene& scene, const Mover& mover,
                const Trails& trails) {
  const cv::Scalar color = color_of_track(mover.track);
  const Pose T_lidar_rest = scene.T_rest_lidar.inverse();
  cv::Point last = view.at(mover.position);
  if (const auto* trail = trails.of(mover.track))
    for (auto place = trail->rbegin(); place != trail->rend(); ++place) {
      const cv::Point here = view.at(T_lidar_rest * *place);
      cv::line(picture, last, here, color, 1, cv::LINE_AA);
      last = here;
    }
  const Eigen::Vector3d tip = mover.position + 0.5 * mover.velocity;
  cv::arrowedLine(picture, view.at(mover.position), view.at(tip), color, 2, cv::LINE_AA, 0, 0.2);
}

std::string ms_after(const VirtualScan& scan) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(0)
       << seconds_between(scan.key_stamp, scan.scan.stamp) * 1e3 << " ms";
  return text.str();
}

/// On a ground of its own, as rings, points and arrows may lie there.
void put_legend(cv::Mat& picture, Labels& labels, const std::string& text, cv::Point at,
                double size, const cv::Scalar& color) {
  int below = 0;
  const cv::Size extent = cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, size, 1, &below);
  const cv::Rect area(at + cv::Point(-6, -extent.height - 5),
                      at + cv::Point(extent.width + 6, below + 3));
  cv::rectangle(picture, area, kGround, cv::FILLED);
  labels.keep_free(area);
  draw_text(picture, text, at, size, color);
}

}  // namespace

BirdScene scene_of(const VirtualScan& scan) {
  BirdScene scene{"virtual scan, " + ms_after(scan) + " after the real one",
                  scan.scan.points,
                  {},
                  {},
                  scan.T_rest_lidar_t};
  std::set<int> moving;
  for (const ObjectMotion& object : scan.objects) {
    if (!moves(object)) continue;
    moving.insert(object.track_id);
    scene.movers.push_back({object.track_id, object.T_lidar_t_lidar_k * object.centroid_lidar_k,
                            scan.T_lidar_t_lidar_k.linear() * object.velocity_lidar_k});
  }
  for (const int track : scan.track_id)
    scene.mover_of.push_back(moving.count(track) > 0 ? track : -1);
  return scene;
}

BirdScene scene_of_key(const VirtualScan& scan, const LidarScan& key) {
  BirdScene scene = scene_of(key);
  scene.T_rest_lidar = scan.T_rest_lidar_t * scan.T_lidar_t_lidar_k;
  for (const ObjectMotion& object : scan.objects) {
    if (!moves(object)) continue;
    scene.movers.push_back({object.track_id, object.centroid_lidar_k, object.velocity_lidar_k});
    for (const int i : object.points) scene.mover_of[i] = object.track_id;
  }
  return scene;
}

BirdScene scene_of(const LidarScan& scan) {
  return {"real scan", scan.points, std::vector<int>(scan.size(), -1), {}, Pose::Identity()};
}

void Trails::remember(const BirdScene& scene) {
  for (const Mover& mover : scene.movers)
    trails_[mover.track].push_back(scene.T_rest_lidar * mover.position);
}

const std::vector<Eigen::Vector3d>* Trails::of(int track) const {
  const auto found = trails_.find(track);
  return found == trails_.end() ? nullptr : &found->second;
}

BirdView BirdView::for_scan(const LidarScan& scan, int width_px) {
  constexpr double kLeast_m = 4, kMost_m = 62;
  BirdView view;
  if (const double range = range_of_nearly_all(scan); range > 0)
    view.ahead_m = std::clamp(1.1 * range, kLeast_m, kMost_m);
  view.behind_m = view.ahead_m / 6;
  view.aside_m = view.ahead_m / 2;
  view.pixels_per_m = width_px / (2 * view.aside_m);
  return view;
}

cv::Size BirdView::size() const {
  return {cvRound(2 * aside_m * pixels_per_m), cvRound((ahead_m + behind_m) * pixels_per_m)};
}

cv::Point2d BirdView::at(const Eigen::Vector3d& p) const {
  return {(aside_m - p.y()) * pixels_per_m, (ahead_m - p.x()) * pixels_per_m};
}

cv::Mat from_above(const BirdScene& scene, const LidarScan* before, const Trails& trails,
                   const std::vector<Camera>& cameras, const Pose& T_vehicle_lidar,
                   const BirdView& view) {
  cv::Mat picture(view.size(), CV_8UC3, kGround);
  draw_grid(picture, view);
  for (const Camera& camera : cameras) draw_view_of(picture, camera, T_vehicle_lidar, view);
  if (before != nullptr) draw_before(picture, view, *before);
  draw_points(picture, view, scene);
  for (const Mover& mover : scene.movers) draw_mover(picture, view, scene, mover, trails);

  Labels labels(picture);
  put_legend(picture, labels, scene.title, {16, 28}, 0.6, kText);
  if (before != nullptr)
    put_legend(picture, labels, "grey: last real scan", {16, 52}, 0.5, {170, 170, 170});
  if (!scene.movers.empty())
    put_legend(picture, labels, "colour: what moves, its way and speed",
               {16, before != nullptr ? 74 : 52}, 0.5, {140, 220, 255});
  const cv::Rect inside({0, 0}, picture.size());
  for (const Mover& mover : scene.movers)
    if (inside.contains(cv::Point(view.at(mover.position))))
      labels.put(label_of(mover.track, mover.velocity.norm()),
                 view.at(mover.position) + cv::Point2d(12, 4), 0.45, color_of_track(mover.track));
  return picture;
}

}  // namespace lidar_upsampling
