// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <benchmark/benchmark.h>

#include <algorithm>
#include <filesystem>
#include <opencv2/imgproc.hpp>
#include <random>

#include "lidar_upsampling/ego/camera_ego.h"
#include "lidar_upsampling/ego/static_points.h"
#include "lidar_upsampling/io/carriers.h"
#include "lidar_upsampling/io/rawlog_stream.h"
#include "lidar_upsampling/objects/point_tracks.h"
#include "lidar_upsampling/objects/road_users.h"
#include "lidar_upsampling/registration/scan_registration.h"
#include "lidar_upsampling/scan/compose.h"
#include "lidar_upsampling/scan/resample.h"
#include "lidar_upsampling/vision/visibility.h"
#include "scene.h"

namespace lidar_upsampling::bench {
namespace {

/// The first cycle's scan, its own picture and the next, and what the stages make of them.
struct Inputs {
  const LidarScan& scan = scene().cycles[0].scan;
  const CameraImage& key = scene().cycles[0].images[0];
  const CameraImage& next = scene().cycles[0].images[1];
  const CameraModel& camera = key.camera.model;
  Pose T_camera_lidar = scene().T_camera_lidar;
  Pose T_lidar_t_lidar_k = scene().T_lidar_t_lidar_k(scan.stamp, next.stamp);
  ImagePyramid key_pyramid{key.gray};
  ImagePyramid next_pyramid{next.gray};
  SceneSegments segments = segment_scan(scan);
  std::vector<ProjectedPoint> projected = project_scan(camera, T_camera_lidar, scan.points);
  std::vector<std::uint8_t> unreliable = mark_depth_edges(projected);
  cv::Mat texture;

  Inputs() { cv::cornerMinEigenVal(key.gray, texture, 5); }
};

const Inputs& inputs() {
  static const Inputs instance;
  return instance;
}

// Where static points are on the next picture; those that leave it stay where they were.
std::vector<cv::Point2f> predicted(const Inputs& in, const std::vector<int>& chosen) {
  std::vector<cv::Point2f> pixels;
  for (const int i : chosen) {
    const ProjectedPoint& point = in.projected[i];
    const auto pixel = project(in.camera, in.T_camera_lidar * in.T_lidar_t_lidar_k *
                                              in.scan.points[point.index].cast<double>());
    pixels.push_back(pixel ? cv::Point2f(pixel->cast<float>().x(), pixel->cast<float>().y())
                           : cv::Point2f(point.u, point.v));
  }
  return pixels;
}

void image_pyramid(benchmark::State& state) {
  const Inputs& in = inputs();
  while (state.KeepRunning()) benchmark::DoNotOptimize(ImagePyramid(in.key.gray));
}

void project_and_mark(benchmark::State& state) {
  const Inputs& in = inputs();
  while (state.KeepRunning()) {
    const auto projected = project_scan(in.camera, in.T_camera_lidar, in.scan.points);
    benchmark::DoNotOptimize(mark_occluded(projected));
    benchmark::DoNotOptimize(mark_depth_edges(projected));
  }
  state.counters["points"] = static_cast<double>(in.scan.size());
  state.counters["in view"] = static_cast<double>(in.projected.size());
}

void ground_and_clusters(benchmark::State& state) {
  const Inputs& in = inputs();
  while (state.KeepRunning()) benchmark::DoNotOptimize(segment_scan(in.scan));
  state.counters["points"] = static_cast<double>(in.scan.size());
  state.counters["clusters"] = static_cast<double>(in.segments.clusters.size());
}

void road_users(benchmark::State& state) {
  const Inputs& in = inputs();
  std::size_t found = 0;
  while (state.KeepRunning()) found = why_no_road_users(in.scan, in.segments, {}).size();
  state.counters["objects"] = static_cast<double>(found);
}

void scan_registration(benchmark::State& state) {
  const LidarScan& from = scene().cycles[0].scan;
  const LidarScan& to = scene().cycles[1].scan;
  const Pose T_truth = scene().T_lidar_t_lidar_k(from.stamp, to.stamp);
  Pose T_guess = T_truth;  // as if braking had not been foreseen
  T_guess.translation().x() += 0.05;
  while (state.KeepRunning())
    if (!register_scans(from.points, to.points, T_guess)) state.SkipWithError("no registration");
  state.counters["points"] = static_cast<double>(from.size());
}

void klt_1000_points(benchmark::State& state) {
  const Inputs& in = inputs();
  const std::vector<int> chosen = choose_spread(in.projected, in.texture, 1000, 8);
  std::vector<cv::Point2f> points;
  points.reserve(chosen.size());
  for (const int i : chosen) points.emplace_back(in.projected[i].u, in.projected[i].v);
  const std::vector<cv::Point2f> guesses = predicted(in, chosen);
  KltResult result;
  while (state.KeepRunning())
    result = track_points(in.key_pyramid, in.next_pyramid, points, guesses);
  state.counters["points"] = static_cast<double>(points.size());
  state.counters["tracked"] =
      static_cast<double>(std::count(result.tracked.begin(), result.tracked.end(), 1));
}

// As of a car: 100 points, a fifth of them astray.
void pose_100_points(benchmark::State& state) {
  const Inputs& in = inputs();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0, 1);
  std::normal_distribution<double> noise(0, 0.3);
  const Pose T_before = in.T_camera_lidar;
  const Pose T_truth = in.T_camera_lidar * Eigen::Translation3d(0.4, 0.03, 0);
  std::vector<Correspondence> pairs;
  while (pairs.size() < 100) {
    const Eigen::Vector3d point(12 + 4 * share(random), -0.9 + 1.8 * share(random),
                                -1.6 + 1.4 * share(random));
    const auto pixel = project(in.camera, T_truth * point);
    if (!pixel) continue;
    const double astray = pairs.size() % 5 == 0 ? 15 : 0;
    pairs.push_back({point, *pixel + Eigen::Vector2d(noise(random) + astray * share(random),
                                                     noise(random) + astray * share(random))});
  }
  std::optional<AbsolutePose> pose;
  while (state.KeepRunning()) pose = estimate_absolute_pose(pairs, in.camera, {}, T_before);
  if (!pose) return state.SkipWithError("no consensus");
  state.counters["inliers"] = pose->num_inliers;
}

void camera_ego(benchmark::State& state) {
  const Inputs& in = inputs();
  const std::vector<std::uint8_t> no_candidates(in.projected.size(), 0);
  const auto chosen = choose_static_points(
      {in.projected, in.unreliable, no_candidates, in.texture.size(), in.texture});
  PointTracks tracks;
  add_points(tracks, in.projected, chosen, in.scan, kStaticOwner);
  const KltResult found =
      track_points(in.key_pyramid, in.next_pyramid, tracks.anchor_px, predicted(in, chosen));
  tracks.last_px = found.points;
  tracks.found = found.tracked;
  tracks.covariance = found.covariance;
  const auto pairs = correspondences_of(tracks, kStaticOwner);
  bool is_found = true;
  while (state.KeepRunning())
    is_found =
        estimate_camera_ego(pairs, in.camera, in.T_camera_lidar, {}, Pose::Identity()).has_value();
  if (!is_found) return state.SkipWithError("no consensus");
  state.counters["tracked"] = static_cast<double>(pairs.size());
}

// What moves the scene's key scan; no objects if the upsampler finds none.
ScanMotion scan_motion() {
  const Inputs& in = inputs();
  LidarUpsampler upsampler{Config{}};
  upsampler.insert_scan(in.scan);
  upsampler.insert_image(in.key);
  const auto sample = upsampler.insert_image(in.next);
  ScanMotion motion;
  motion.stamp = in.next.stamp;
  motion.T_lidar_t_lidar_k = in.T_lidar_t_lidar_k;
  if (sample) motion.objects = sample->objects;
  motion.cameras = {in.next.camera};
  return motion;
}

void compose_120k(benchmark::State& state) {
  const Inputs& in = inputs();
  const ScanMotion motion = scan_motion();
  while (state.KeepRunning())
    benchmark::DoNotOptimize(compose_virtual_scan(in.scan, motion, "VIRTUAL", {}));
  state.counters["points"] = static_cast<double>(in.scan.size());
  state.counters["objects"] = static_cast<double>(motion.objects.size());
}

// Once per real scan.
void beams_120k(benchmark::State& state) {
  const Inputs& in = inputs();
  while (state.KeepRunning()) benchmark::DoNotOptimize(BeamResampler(in.scan));
}

void resample_120k(benchmark::State& state) {
  const Inputs& in = inputs();
  const VirtualScan moved = compose_virtual_scan(in.scan, scan_motion(), "VIRTUAL", {});
  const BeamResampler resampler(in.scan);
  while (state.KeepRunning()) benchmark::DoNotOptimize(resampler.resample(moved));
  state.counters["points"] = static_cast<double>(in.scan.size());
}

// Into a real file, which goes when the writer does; gzip takes most of the time.
void write_scan(benchmark::State& state) {
  const Inputs& in = inputs();
  const auto path = std::filesystem::temp_directory_path() / "lidar_upsampling_benchmark.rawlog";
  RawlogWriter writer(path.string(), true);
  while (state.KeepRunning()) writer.write(*observation_from_scan(in.scan, Carrier::automatic));
  state.counters["points"] = static_cast<double>(in.scan.size());
}

#define LIDAR_UPSAMPLING_STAGE_BENCHMARK(name) \
  BENCHMARK(name)->Unit(benchmark::kMillisecond)->UseRealTime()
LIDAR_UPSAMPLING_STAGE_BENCHMARK(image_pyramid);
LIDAR_UPSAMPLING_STAGE_BENCHMARK(project_and_mark);
LIDAR_UPSAMPLING_STAGE_BENCHMARK(ground_and_clusters);
LIDAR_UPSAMPLING_STAGE_BENCHMARK(road_users);
LIDAR_UPSAMPLING_STAGE_BENCHMARK(scan_registration);
LIDAR_UPSAMPLING_STAGE_BENCHMARK(klt_1000_points);
LIDAR_UPSAMPLING_STAGE_BENCHMARK(pose_100_points);
LIDAR_UPSAMPLING_STAGE_BENCHMARK(camera_ego);
LIDAR_UPSAMPLING_STAGE_BENCHMARK(compose_120k);
LIDAR_UPSAMPLING_STAGE_BENCHMARK(beams_120k);
LIDAR_UPSAMPLING_STAGE_BENCHMARK(resample_120k);
LIDAR_UPSAMPLING_STAGE_BENCHMARK(write_scan);

}  // namespace
}  // namespace lidar_upsampling::bench
