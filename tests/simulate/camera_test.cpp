// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <opencv2/calib3d.hpp>
#include <opencv2/video/tracking.hpp>

#include "test_world.h"

namespace lidar_upsampling::sim {
namespace {

Eigen::Vector2d projected(const CameraModel& m, const Eigen::Vector3d& p) {
  return {m.fx * p.x() / p.z() + m.cx, m.fy * p.y() / p.z() + m.cy};
}

// Whether the whole neighbourhood of a pixel shows one object.
bool shows(const cv::Mat& object, const Eigen::Vector2d& uv, int id, int margin) {
  const int u = static_cast<int>(std::lround(uv.x())), v = static_cast<int>(std::lround(uv.y()));
  const cv::Rect around(u - margin, v - margin, 2 * margin + 1, 2 * margin + 1);
  if ((around & cv::Rect(0, 0, object.cols, object.rows)) != around) return false;
  return cv::countNonZero(object(around) != id) == 0;
}

struct Tracked {
  std::vector<cv::Point2f> on_first, truth;
};

// LiDAR points of an object, where picture 0 shows them, and where the true motion puts them on
// picture 1.
Tracked true_tracks(const World& world, const CameraSpec& spec, int id, const RenderedImage& first,
                    const RenderedImage& second) {
  const LidarSpec lidar = test_lidar();
  const double t0 = time_of(first.image.stamp), t1 = time_of(second.image.stamp);
  const SimulatedScan scan = scan_at(world, lidar, first.image.stamp, 1);
  const Pose T_world_lidar = world.T_world_vehicle(t0) * lidar.T_vehicle_lidar;
  const Pose T_camera0_world = (world.T_world_vehicle(t0) * spec.camera.T_vehicle_camera).inverse();
  const Pose T_camera1_world = (world.T_world_vehicle(t1) * spec.camera.T_vehicle_camera).inverse();
  const Pose T_moved = world.T_world_object(id, t1) * world.T_world_object(id, t0).inverse();
  Tracked tracks;
  for (std::size_t i = 0; i < scan.scan.size(); ++i) {
    if (scan.object[i] != id) continue;
    const Eigen::Vector3d p = T_world_lidar * scan.scan.points[i].cast<double>();
    const Eigen::Vector2d a = projected(spec.camera.model, T_camera0_world * p);
    const Eigen::Vector2d b = projected(spec.camera.model, T_camera1_world * (T_moved * p));
    if (!shows(first.object, a, id, 5) || !shows(second.object, b, id, 5)) continue;
    tracks.on_first.emplace_back(a.x(), a.y());
    tracks.truth.emplace_back(b.x(), b.y());
  }
  return tracks;
}

// The part of the test camera's picture that shows the road ahead.
CameraSpec camera_ahead() {
  CameraSpec spec = test_camera();
  CameraModel& model = spec.camera.model;
  model.width = 500;
  model.height = 190;
  model.cx -= 150;
  model.cy -= 60;
  return spec;
}

double median_tracking_error(const MotionProfile& motion, const std::string& type) {
  World world = empty_world();
  world.ego.motion.speed = 10;
  const int id = add_vehicle(world, type, motion);
  const CameraSpec spec = camera_ahead();
  const CameraRenderer renderer(spec);
  const RenderedImage first = renderer.render(world, stamp_of(0, 30, 0), 3);
  const RenderedImage second = renderer.render(world, stamp_of(1, 30, 0), 3);
  const Tracked tracks = true_tracks(world, spec, id, first, second);
  EXPECT_GT(tracks.truth.size(), 60U);
  std::vector<cv::Point2f> found;
  std::vector<unsigned char> ok;
  std::vector<float> residual;
  cv::calcOpticalFlowPyrLK(first.image.gray, second.image.gray, tracks.on_first, found, ok,
                           residual, cv::Size(15, 15), 3);
  std::vector<double> errors;
  for (std::size_t i = 0; i < found.size(); ++i) {
    errors.push_back(ok[i] != 0 ? cv::norm(found[i] - tracks.truth[i]) : 100);
  }
  if (errors.empty()) return 100;
  std::nth_element(errors.begin(), errors.begin() + errors.size() / 2, errors.end());
  return errors[errors.size() / 2];
}

TEST(Camera, a_point_on_a_moving_car_is_seen_where_its_true_motion_puts_it) {
  EXPECT_LT(median_tracking_error({13, 0, 0, 0, 12, {}}, "car"), 0.15);
  EXPECT_LT(median_tracking_error({16, 3, 3.0, 0, 8, {{0, 0, 0.6}}}, "car"), 0.25);
  EXPECT_LT(median_tracking_error({20, 1, 1.3, 0, 5, {}}, "truck"), 0.2);
}

TEST(Camera, picture_and_scan_agree_on_what_is_where) {
  World world = empty_world();
  add_vehicle(world, "car", {11, 2, 0.4, 0, 0, {}});
  add_vehicle(world, "truck", {19, -3, 0, 0, 0, {}});
  add_vehicle(world, "pedestrian", {8, -1, 0, 0, 0, {}});
  CameraSpec spec = test_camera();
  const LidarSpec lidar = test_lidar();
  spec.camera.T_vehicle_camera.translation() = lidar.T_vehicle_lidar.translation();
  const RenderedImage picture = CameraRenderer(spec).render(world, start_stamp(), 1);
  const SimulatedScan scan = scan_at(world, lidar, start_stamp(), 1);
  const Pose T_camera_lidar = spec.camera.T_vehicle_camera.inverse() * lidar.T_vehicle_lidar;
  int seen = 0, on_vehicles = 0;
  for (std::size_t i = 0; i < scan.scan.size(); ++i) {
    const Eigen::Vector3d p = T_camera_lidar * scan.scan.points[i].cast<double>();
    if (p.z() < 1) continue;
    const Eigen::Vector2d uv = projected(spec.camera.model, p);
    const cv::Point pixel(static_cast<int>(std::lround(uv.x())),
                          static_cast<int>(std::lround(uv.y())));
    if (!cv::Rect(0, 0, 800, 300).contains(pixel)) continue;
    // The ray passes within half a pixel of the centre, so only at edges may it show something
    // else.
    const cv::Rect around = cv::Rect(pixel.x - 1, pixel.y - 1, 3, 3) & cv::Rect(0, 0, 800, 300);
    ASSERT_GT(cv::countNonZero(picture.object(around) == scan.object[i]), 0);
    ++seen;
    on_vehicles += scan.object[i] > 0 ? 1 : 0;
  }
  EXPECT_GT(seen, 5000);
  EXPECT_GT(on_vehicles, 1500);
}

TEST(Camera, a_distorted_picture_shows_points_where_the_lens_puts_them) {
  for (const DistortionModel model :
       {DistortionModel::plumb_bob, DistortionModel::kannala_brandt}) {
    World world = empty_world();
    const int car = add_vehicle(world, "car", {9, 3, 0.5, 0, 0, {}});
    CameraSpec spec = test_camera();
    spec.camera.model.distortion_model = model;
    spec.camera.model.distortion = {-0.28, 0.08, 0.001, -0.0005};
    const RenderedImage picture = CameraRenderer(spec).render(world, start_stamp(), 1);
    const LidarSpec lidar = test_lidar();
    const SimulatedScan scan = scan_at(world, lidar, start_stamp(), 1);
    const Pose T_camera_lidar = spec.camera.T_vehicle_camera.inverse() * lidar.T_vehicle_lidar;
    std::vector<cv::Point3d> points;
    for (std::size_t i = 0; i < scan.scan.size(); ++i) {
      if (scan.object[i] != car) continue;
      const Eigen::Vector3d p = T_camera_lidar * scan.scan.points[i].cast<double>();
      points.emplace_back(p.x(), p.y(), p.z());
    }
    const cv::Matx33d K(700, 0, 399.5, 0, 700, 140, 0, 0, 1);
    const auto& d = spec.camera.model.distortion;
    const cv::Vec3d none(0, 0, 0);
    std::vector<cv::Point2d> pixels;
    if (model == DistortionModel::plumb_bob) {
      cv::projectPoints(points, none, none, K, std::vector<double>(d.begin(), d.end()), pixels);
    } else {
      cv::fisheye::projectPoints(points, pixels, none, none, K, cv::Vec4d(d[0], d[1], d[4], d[5]));
    }
    int inside = 0, hits = 0;
    for (const cv::Point2d& pixel : pixels) {
      const cv::Point center(cvRound(pixel.x), cvRound(pixel.y));
      if (!cv::Rect(0, 0, 800, 300).contains(center)) continue;
      ++inside;
      hits += picture.object.at<int>(center) == car ? 1 : 0;
    }
    ASSERT_GT(inside, 500);
    EXPECT_GT(hits, 0.97 * inside);  // some at the silhouette are hidden from the camera
  }
}

TEST(Camera, the_same_seed_gives_the_same_picture_on_any_number_of_threads) {
  World world = empty_world();
  add_vehicle(world, "car", {9, 0, 0, 0, 5, {}});
  const CameraRenderer renderer(camera_ahead());
  const cv::Mat many = renderer.render(world, start_stamp(), 5).image.bgr;
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(cv::norm(many, renderer.render(world, start_stamp(), 5).image.bgr, cv::NORM_INF), 0);
  EXPECT_GT(cv::norm(many, renderer.render(world, start_stamp(), 6).image.bgr, cv::NORM_INF), 0);
}

TEST(Camera, gray_values_scatter_by_the_noise_asked_for) {
  const World world = empty_world();
  CameraSpec spec = test_camera();
  spec.noise = 0;
  const cv::Mat exact = CameraRenderer(spec).render(world, start_stamp(), 1).image.gray;
  spec.noise = 1.5;
  const cv::Mat noisy = CameraRenderer(spec).render(world, start_stamp(), 1).image.gray;
  cv::Scalar mean, sigma;
  cv::Mat difference;
  cv::subtract(noisy, exact, difference, cv::noArray(), CV_32F);
  cv::meanStdDev(difference, mean, sigma);
  EXPECT_NEAR(mean[0], 0, 0.1);
  EXPECT_NEAR(sigma[0], 1.5, 0.25);
}

TEST(Camera, gain_follows_its_steps) {
  CameraSpec spec = camera_ahead();
  EXPECT_EQ(gain_at(spec, 5), 1);
  spec.gain = {{0, 1}, {1, 1}, {2, 1.5}};
  EXPECT_EQ(gain_at(spec, 0.5), 1);
  EXPECT_DOUBLE_EQ(gain_at(spec, 1.5), 1.25);
  EXPECT_EQ(gain_at(spec, 9), 1.5);
  const World world = empty_world();
  const CameraRenderer renderer(spec);
  const double dark = cv::mean(renderer.render(world, start_stamp(), 1).image.gray)[0];
  const double bright =
      cv::mean(renderer.render(world, shifted(start_stamp(), 3), 1).image.gray)[0];
  EXPECT_GT(bright, dark + 10);
}

}  // namespace
}  // namespace lidar_upsampling::sim
