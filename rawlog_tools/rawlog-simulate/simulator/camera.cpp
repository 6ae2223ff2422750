// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "simulator/camera.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "simulator/fragment.h"
#include "simulator/noise.h"

namespace lidar_upsampling::sim {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr int kTile = 16, kSubpixels = 3;

struct Instant : CameraView {
  const CameraRenderer& renderer;

  [[nodiscard]] Vector3d in_world(const Vector2d& ray) const {
    return T_world_camera.linear() * ray.homogeneous();
  }
};

// The ray through a point of pixel (u, v), `at` in [0, 1]^2 from its corner, for a filter 1 / n
// pixels wide.
PixelRay ray_at(const Instant& now, int u, int v, const Vector2d& at, int n) {
  const Vector2d &a = now.renderer.corner_ray(u, v), &b = now.renderer.corner_ray(u + 1, v),
                 &c = now.renderer.corner_ray(u, v + 1), &d = now.renderer.corner_ray(u + 1, v + 1);
  const Vector2d top = a + at.x() * (b - a), bottom = c + at.x() * (d - c);
  const Vector3d direction = now.in_world(top + at.y() * (bottom - top));
  const double norm = direction.norm(), scale = 1 / (n * norm);
  const Eigen::Matrix3d& R = now.T_world_camera.linear();
  return {direction / norm, scale * (R.leftCols<2>() * (b - a)),
          scale * (R.leftCols<2>() * (c - a))};
}

RayBundle bundle_of(const Instant& now, const cv::Rect& tile) {
  const CameraModel& model = now.renderer.spec().camera.model;
  // A pixel more on each side, since distortion bends the tile's borders.
  const int left = std::max(0, tile.x - 1), right = std::min(model.width, tile.x + tile.width + 1);
  const int top = std::max(0, tile.y - 1),
            bottom = std::min(model.height, tile.y + tile.height + 1);
  std::array<Vector3d, 4> corners;
  corners[0] = now.in_world(now.renderer.corner_ray(left, top)).normalized();
  corners[1] = now.in_world(now.renderer.corner_ray(right, top)).normalized();
  corners[2] = now.in_world(now.renderer.corner_ray(right, bottom)).normalized();
  corners[3] = now.in_world(now.renderer.corner_ray(left, bottom)).normalized();
  RayBundle bundle;
  bundle.axis = (corners[0] + corners[1] + corners[2] + corners[3]).normalized();
  double lowest_cosine = 1;
  for (int i = 0; i < 4; ++i) {
    lowest_cosine = std::min(lowest_cosine, bundle.axis.dot(corners[i]));
    bundle.sides.emplace_back(corners[(i + 1) % 4].cross(corners[i]));
  }
  bundle.half_angle = std::acos(std::min(1., lowest_cosine)) + 0.002;
  return bundle;
}

/// Row-major fragments of the whole picture, and each tile's candidates.
struct Canvas {
  int width, height, tiles_x, tiles_y;
  std::vector<Fragment> fragments;
  std::vector<std::vector<int>> candidates;

  [[nodiscard]] cv::Rect tile(int i) const {
    return cv::Rect(i % tiles_x * kTile, i / tiles_x * kTile, kTile, kTile) &
           cv::Rect(0, 0, width, height);
  }
  Fragment& at(int u, int v) { return fragments[static_cast<std::size_t>(v) * width + u]; }
  [[nodiscard]] bool on_edge(int u, int v) {
    const std::uint32_t own = at(u, v).surface;
    for (int y = std::max(0, v - 1); y <= std::min(height - 1, v + 1); ++y) {
      for (int x = std::max(0, u - 1); x <= std::min(width - 1, u + 1); ++x) {
        if (at(x, y).surface != own) return true;
      }
    }
    return false;
  }
};

void draw_tile(const Instant& now, int index, Canvas& canvas) {
  const cv::Rect tile = canvas.tile(index);
  canvas.candidates[index] = now.view.candidates(bundle_of(now, tile));
  for (int v = tile.y; v < tile.br().y; ++v) {
    for (int u = tile.x; u < tile.br().x; ++u) {
      canvas.at(u, v) =
          trace(now, ray_at(now, u, v, Vector2d::Constant(0.5), 1), canvas.candidates[index]);
    }
  }
}

// Only colours change: the neighbours' edges are still found by their surfaces.
void smooth_edges(const Instant& now, int index, Canvas& canvas) {
  const cv::Rect tile = canvas.tile(index);
  for (int v = tile.y; v < tile.br().y; ++v) {
    for (int u = tile.x; u < tile.br().x; ++u) {
      if (!canvas.on_edge(u, v)) continue;
      Vector3f sum = Vector3f::Zero();
      for (int i = 0; i < kSubpixels * kSubpixels; ++i) {
        const int column = i % kSubpixels, row = i / kSubpixels;
        const Vector2d at((column + 0.5) / kSubpixels, (row + 0.5) / kSubpixels);
        const PixelRay ray = ray_at(now, u, v, at, kSubpixels);
        sum += trace(now, ray, canvas.candidates[index]).color.cwiseMin(1.3F);
      }
      canvas.at(u, v).color = sum / static_cast<float>(kSubpixels * kSubpixels);
    }
  }
}

// Four bytes of a hash add up to something near enough to a Gaussian, of sigma 1.
float cheap_gaussian(std::uint32_t h) {
  const int sum = (h & 255U) + (h >> 8 & 255U) + (h >> 16 & 255U) + (h >> 24);
  return (static_cast<float>(sum) - 510.F) * (1.F / 147.8F);
}

void develop_row(Canvas& canvas, int v, float gain, float noise, std::uint32_t seed,
                 RenderedImage& out) {
  auto* bgr = out.image.bgr.ptr<cv::Vec3b>(v);
  auto* object = out.object.ptr<int>(v);
  for (int u = 0; u < canvas.width; ++u) {
    const Fragment& fragment = canvas.at(u, v);
    const auto pixel = static_cast<std::uint32_t>(v * canvas.width + u);
    const float common = noise * cheap_gaussian(hash(seed, pixel));
    for (int channel = 0; channel < 3; ++channel) {
      const float light = std::clamp(gain * fragment.color[2 - channel], 0.F, 1.F);
      const float own = 0.4F * noise * cheap_gaussian(hash(seed + 1 + channel, pixel));
      bgr[u][channel] =
          cv::saturate_cast<std::uint8_t>(255 * std::pow(light, 1 / 2.2F) + common + own);
    }
    object[u] = fragment.object;
  }
}

}  // namespace

CameraRenderer::CameraRenderer(const CameraSpec& spec) : spec_(spec) {
  const CameraModel& m = spec.camera.model;
  std::vector<cv::Point2d> corners, rays;
  for (int v = 0; v <= m.height; ++v) {
    for (int u = 0; u <= m.width; ++u) corners.emplace_back(u - 0.5, v - 0.5);
  }
  const cv::Matx33d K(m.fx, 0, m.cx, 0, m.fy, m.cy, 0, 0, 1);
  const auto& d = m.distortion;
  if (m.distortion_model == DistortionModel::kannala_brandt) {
    cv::fisheye::undistortPoints(corners, rays, K, cv::Vec4d(d[0], d[1], d[4], d[5]));
  } else {
    const bool plain = m.distortion_model == DistortionModel::none;
    const cv::Mat coefficients =
        plain ? cv::Mat() : cv::Mat(std::vector<double>(d.begin(), d.end())).clone();
    const cv::TermCriteria until(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 100, 1e-12);
    cv::undistortPoints(corners, rays, K, coefficients, cv::noArray(), cv::noArray(), until);
  }
  for (const cv::Point2d& ray : rays) corner_rays_.emplace_back(ray.x, ray.y);
}

RenderedImage CameraRenderer::render(const World& world, Stamp stamp, std::uint32_t seed) const {
  const double t = time_of(stamp) - spec_.time_offset_s;
  const Scene scene = scene_at(world, t);
  const Pose T_world_camera = world.T_world_vehicle(t) * spec_.camera.T_vehicle_camera;
  const Instant now{
      {world, scene, T_world_camera, View(scene, T_world_camera.translation()), SunShadows(scene)},
      *this};
  const CameraModel& model = spec_.camera.model;
  Canvas canvas{model.width,
                model.height,
                (model.width + kTile - 1) / kTile,
                (model.height + kTile - 1) / kTile,
                {},
                {}};
  const int num_tiles = canvas.tiles_x * canvas.tiles_y;
  canvas.fragments.resize(static_cast<std::size_t>(model.width) * model.height);
  canvas.candidates.resize(num_tiles);
  tbb::parallel_for(0, num_tiles, [&](int i) { draw_tile(now, i, canvas); });
  tbb::parallel_for(0, num_tiles, [&](int i) { smooth_edges(now, i, canvas); });

  RenderedImage out;
  out.image.stamp = stamp;
  out.taken_at = t;
  out.image.camera = spec_.camera;
  out.image.bgr.create(model.height, model.width, CV_8UC3);
  out.object.create(model.height, model.width, CV_32S);
  const auto ticks = static_cast<std::uint32_t>((stamp - start_stamp()).count());
  std::uint32_t own = hash(seed, ticks);
  for (const char letter : spec_.camera.label) own = hash(own, static_cast<unsigned char>(letter));
  const auto gain = static_cast<float>(gain_at(spec_, t)), noise = static_cast<float>(spec_.noise);
  tbb::parallel_for(0, model.height, [&](int v) { develop_row(canvas, v, gain, noise, own, out); });
  cv::cvtColor(out.image.bgr, out.image.gray, cv::COLOR_BGR2GRAY);
  return out;
}

double gain_at(const CameraSpec& spec, double t) {
  const auto& steps = spec.gain;
  if (steps.empty()) return 1;
  if (t <= steps.front().first) return steps.front().second;
  for (std::size_t i = 1; i < steps.size(); ++i) {
    if (t > steps[i].first) continue;
    const double share = (t - steps[i - 1].first) / (steps[i].first - steps[i - 1].first);
    return steps[i - 1].second + share * (steps[i].second - steps[i - 1].second);
  }
  return steps.back().second;
}

}  // namespace lidar_upsampling::sim
