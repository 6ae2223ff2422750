// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/ego/time_offset.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "lidar_upsampling/decompositions.h"
#include "lidar_upsampling/registration/point_index.h"
#include "lidar_upsampling/units.h"
#include "lidar_upsampling/vision/projection.h"

namespace lidar_upsampling {
namespace {

int half_size(const TimeOffsetOptions& options) {
  return static_cast<int>(std::lround(options.max_offset_s / options.step_s));
}

/// A point as its neighbours in the ring see it.
struct Beam {
  int row;
  double azimuth, range;
  int index;
};

// In the order of rows and of azimuths therein; without rings, of narrow bands of elevation.
std::vector<Beam> beams_of(const LidarScan& scan, const TimeOffsetOptions& options) {
  constexpr double kBand = 0.3 * kDegree;
  std::vector<Beam> beams;
  beams.reserve(scan.size());
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const Eigen::Vector3d p = scan.points[i].cast<double>();
    const double range = p.norm();
    if (range < options.min_range_m) continue;
    const int row = scan.ring.empty()
                        ? static_cast<int>(std::floor(std::asin(p.z() / range) / kBand))
                        : scan.ring[i];
    beams.push_back({row, std::atan2(p.y(), p.x()), range, static_cast<int>(i)});
  }
  std::sort(beams.begin(), beams.end(), [](const Beam& a, const Beam& b) {
    return a.row != b.row ? a.row < b.row : a.azimuth < b.azimuth;
  });
  return beams;
}

double usual_gap(const std::vector<Beam>& beams) {
  std::vector<double> gaps;
  for (std::size_t i = 1; i < beams.size(); ++i)
    if (beams[i].row == beams[i - 1].row) gaps.push_back(beams[i].azimuth - beams[i - 1].azimuth);
  return gaps.empty() ? 0 : median(std::move(gaps));
}

/// Points where surfaces end, and how well the beams' spacing lets them be known.
struct DepthEdges {
  std::vector<Eigen::Vector3d> points;
  double step_rad = 0;
};

// Where surfaces end beside something farther away: at the nearer one's range, halfway to the next
// beam, for the last point lies inside by half a step on average.
DepthEdges depth_edges(const LidarScan& scan, const TimeOffsetOptions& options) {
  const std::vector<Beam> beams = beams_of(scan, options);
  DepthEdges edges;
  edges.step_rad = usual_gap(beams);
  const double widest_gap = 2.5 * edges.step_rad;
  for (std::size_t i = 1; i < beams.size(); ++i) {
    const Beam &a = beams[i - 1], &b = beams[i];
    const double gap = b.azimuth - a.azimuth;
    if (a.row != b.row || gap > widest_gap) continue;
    const Beam& nearer = a.range < b.range ? a : b;
    const double jump = options.min_jump_m + options.min_jump_per_range * nearer.range;
    if (nearer.range > options.max_range_m || std::abs(a.range - b.range) < jump) continue;
    const Eigen::AngleAxisd half_way((a.range < b.range ? 0.5 : -0.5) * gap,
                                     Eigen::Vector3d::UnitZ());
    edges.points.emplace_back(half_way *
                              scan.points[static_cast<std::size_t>(nearer.index)].cast<double>());
  }
  return edges;
}

// Upright edges are sampled by other beams each time: heights count little.
Eigen::Vector3f footing(const Eigen::Vector3d& edge) {
  return Eigen::Vector3d(edge.x(), edge.y(), 0.25 * edge.z()).cast<float>();
}

// Edges of the scan that the scan before has at the same place.
std::vector<Eigen::Vector3d> standing_edges(const ScanOnPicture& pair,
                                            const TimeOffsetOptions& options) {
  DepthEdges now = depth_edges(pair.scan, options);
  std::vector<Eigen::Vector3d> edges = std::move(now.points);
  if (pair.before == nullptr) return edges;
  const Pose T_k_before =
      pair.lidar_step(seconds_between(pair.scan.stamp, pair.before->stamp)).inverse();
  std::vector<Eigen::Vector3f> before;
  const DepthEdges then = depth_edges(*pair.before, options);
  for (const Eigen::Vector3d& edge : then.points) before.push_back(footing(T_k_before * edge));
  if (before.empty()) return {};
  const PointIndex index(std::move(before));
  const auto moved = [&](const Eigen::Vector3d& edge) {
    const double reach = options.max_moved_m + now.step_rad * edge.norm();
    return index.nearest(footing(edge)).sq_distance > reach * reach;
  };
  edges.erase(std::remove_if(edges.begin(), edges.end(), moved), edges.end());
  return edges;
}

// Strength of upright edges, 1 on average round about: a tree's leaves weigh no more than a pole.
cv::Mat upright_edges(const cv::Mat& gray, double blur_px) {
  constexpr double kAround_px = 20, kNoise = 2;
  cv::Mat smooth, gradient, around;
  gray.convertTo(smooth, CV_32F);
  cv::GaussianBlur(smooth, smooth, {}, blur_px);
  cv::Sobel(smooth, gradient, CV_32F, 1, 0, 3, 0.125);
  gradient = cv::abs(gradient);
  cv::GaussianBlur(gradient, around, {}, kAround_px);
  cv::divide(gradient, around + kNoise, gradient);
  return cv::min(gradient, 4);
}

float at(const cv::Mat& map, const Eigen::Vector2d& pixel) {
  const int u = std::clamp(static_cast<int>(pixel.x()), 0, map.cols - 2);
  const int v = std::clamp(static_cast<int>(pixel.y()), 0, map.rows - 2);
  const auto x = static_cast<float>(pixel.x() - u), y = static_cast<float>(pixel.y() - v);
  const float *above = map.ptr<float>(v) + u, *below = map.ptr<float>(v + 1) + u;
  return (1 - y) * ((1 - x) * above[0] + x * above[1]) + y * ((1 - x) * below[0] + x * below[1]);
}

std::vector<double> sum_of(const std::vector<OffsetScores>& scores, std::size_t skip_from,
                           std::size_t skip_to) {
  std::vector<double> sum(scores.front().score.size(), 0);
  for (std::size_t i = 0; i < scores.size(); ++i) {
    if (i >= skip_from && i < skip_to) continue;
    for (std::size_t j = 0; j < sum.size(); ++j) sum[j] += scores[i].score[j];
  }
  return sum;
}

// Position of the highest score, in steps; a parabola over what lies around it.
std::optional<double> peak_of(const std::vector<double>& sum, int reach) {
  const int size = static_cast<int>(sum.size());
  const int top = static_cast<int>(std::max_element(sum.begin(), sum.end()) - sum.begin());
  if (top < reach || top >= size - reach) return {};
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  for (int i = -reach; i <= reach; ++i) {
    const Eigen::Vector3d powers(1, i, i * i);
    A += powers * powers.transpose();
    b += powers * sum[top + i];
  }
  const Eigen::Vector3d parabola = solved<3, 1>(A, b);
  if (!(parabola[2] < 0)) return {};
  return top + std::clamp(-0.5 * parabola[1] / parabola[2], -1. * reach, 1. * reach);
}

}  // namespace

std::optional<OffsetScores> score_time_offsets(const ScanOnPicture& pair,
                                               const TimeOffsetOptions& options) {
  const Camera& camera = pair.image.camera;
  const Pose T_camera_lidar = camera.T_vehicle_camera.inverse() * pair.scan.T_vehicle_lidar;
  const double dt = seconds_between(pair.scan.stamp, pair.image.stamp);
  const int half = half_size(options);
  std::vector<Pose> T_camera_lidar_k;
  for (int i = -half; i <= half; ++i)
    T_camera_lidar_k.push_back(T_camera_lidar * pair.lidar_step(dt - i * options.step_s));

  // Only what stays in the picture all over the search counts, else scores could not be compared.
  std::vector<Eigen::Vector3d> edges;
  std::vector<double> shifts;
  for (const Eigen::Vector3d& edge : standing_edges(pair, options)) {
    const auto first = project(camera.model, T_camera_lidar_k.front() * edge, 2);
    const auto last = project(camera.model, T_camera_lidar_k.back() * edge, 2);
    if (!first || !last) continue;
    edges.push_back(edge);
    shifts.push_back((*first - *last).norm());
  }
  if (static_cast<int>(edges.size()) < options.min_edges || median(shifts) < options.min_shift_px)
    return {};

  const cv::Mat strength = upright_edges(pair.image.gray, options.blur_px);
  OffsetScores scores;
  const double span = options.step_s * (2. * half);
  scores.speed =
      (T_camera_lidar_k.front().translation() - T_camera_lidar_k.back().translation()).norm() /
      span;
  for (const Pose& T : T_camera_lidar_k) {
    double sum = 0;
    for (const Eigen::Vector3d& edge : edges)
      if (const auto pixel = project(camera.model, T * edge)) sum += at(strength, *pixel);
    scores.score.push_back(sum);
  }
  return scores;
}

std::optional<TimeOffset> estimate_time_offset(const std::vector<OffsetScores>& scores,
                                               const TimeOffsetOptions& options) {
  const auto num = scores.size();
  if (num < 2 || static_cast<int>(num) < options.min_pictures) return {};
  const int reach = std::max(2, static_cast<int>(std::lround(0.006 / options.step_s)));
  const auto peak = peak_of(sum_of(scores, 0, 0), reach);
  if (!peak) return {};

  // The jackknife, by stretches of the log: neighbouring pictures err alike.
  const std::size_t parts = std::min<std::size_t>(num, 10);
  double sq_sum = 0;
  for (std::size_t i = 0; i < parts; ++i) {
    const auto without = peak_of(sum_of(scores, i * num / parts, (i + 1) * num / parts), reach);
    if (!without) return {};
    sq_sum += (*without - *peak) * (*without - *peak);
  }
  double sum_speed = 0;
  for (const OffsetScores& each : scores) sum_speed += each.speed;
  const double scatter_s = options.step_s * std::sqrt(sq_sum * static_cast<double>(parts - 1) /
                                                      static_cast<double>(parts));
  const double misplaced_s =
      options.calibration_sigma_m * static_cast<double>(num) / std::max(sum_speed, 1e-6);
  TimeOffset result;
  result.offset_s = (*peak - half_size(options)) * options.step_s;
  result.sigma_s = std::hypot(scatter_s, misplaced_s);
  result.num_pictures = static_cast<int>(num);
  if (result.sigma_s > options.max_sigma_s) return {};
  return result;
}

}  // namespace lidar_upsampling
