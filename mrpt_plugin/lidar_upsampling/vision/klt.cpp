// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/vision/klt.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>
#include <stdexcept>
#include <string>

#include "lidar_upsampling/checks.h"

namespace lidar_upsampling {
namespace {

constexpr double kSmoothing_px = 0.7;  // sigma of a blur: interpolation errs on sharp edges

struct Flow {
  std::vector<cv::Point2f> points;
  std::vector<std::uint8_t> found;
};

Flow track_one_way(const ImagePyramid& from, const ImagePyramid& to,
                   const std::vector<cv::Point2f>& points, const std::vector<cv::Point2f>& guesses,
                   int levels, const KltOptions& options) {
  Flow flow;
  flow.points = guesses;
  const cv::TermCriteria stop(cv::TermCriteria::COUNT + cv::TermCriteria::EPS,
                              options.max_iterations, options.epsilon_px);
  cv::calcOpticalFlowPyrLK(from.levels(), to.levels(), points, flow.points, flow.found,
                           cv::noArray(), cv::Size(options.window_px, options.window_px), levels,
                           stop, cv::OPTFLOW_USE_INITIAL_FLOW, options.min_eigenvalue);
  return flow;
}

bool patch_inside(const cv::Size& size, const cv::Point2f& point, int window_px) {
  const int pixels = window_px / 2;
  const auto half = static_cast<float>(pixels);
  return point.x >= half && point.x <= static_cast<float>(size.width - 1) - half &&
         point.y >= half && point.y <= static_cast<float>(size.height - 1) - half;
}

/// Which points are found both ways, and end near where they started.
std::vector<std::uint8_t> come_back(const ImagePyramid& from, const ImagePyramid& to,
                                    const std::vector<cv::Point2f>& points, const Flow& forward,
                                    const KltOptions& options) {
  std::vector<std::uint8_t> result(points.size(), 0);
  std::vector<std::size_t> which;
  std::vector<cv::Point2f> starts, ends;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (forward.found[i] == 0) continue;
    if (!patch_inside(from.size(), points[i], options.window_px)) continue;
    if (!patch_inside(to.size(), forward.points[i], options.window_px)) continue;
    which.push_back(i);
    starts.push_back(points[i]);
    ends.push_back(forward.points[i]);
  }
  if (which.empty()) return result;
  // The way back starts at its end, so that coarse levels have nothing to say.
  const int levels = std::min(1, options.pyramid_levels);
  const Flow back = track_one_way(to, from, ends, starts, levels, options);
  const auto limit = static_cast<float>(options.max_forward_backward_px);
  for (std::size_t k = 0; k < which.size(); ++k) {
    const cv::Point2f offset = back.points[k] - starts[k];
    result[which[k]] = back.found[k] != 0 && std::hypot(offset.x, offset.y) <= limit ? 1 : 0;
  }
  return result;
}

/// What aligns better, from where Lucas-Kanade has ended or, of a patch that shows others, too,
/// which pull it along, from the guess.
void align_all(const ImagePyramid& from, const ImagePyramid& to,
               const std::vector<cv::Point2f>& points, const std::vector<cv::Point2f>& guesses,
               const PointLabels* labels, KltResult& result) {
  constexpr std::size_t kGrainSize = 32;
  constexpr float kSameStart_px = 0.25F;  // as steps are whole pixels at first, they end alike
  const auto align_one = [&](std::size_t i) {
    std::vector<float> own;
    if (labels != nullptr) own = own_pixels(labels->surfaces, labels->of_point[i], points[i]);
    std::vector<cv::Point2f> starts;
    if (result.tracked[i] != 0) starts.push_back(result.points[i]);
    const auto is_new = [&](const cv::Point2f& start) {
      const cv::Point2f apart = start - result.points[i];
      return result.tracked[i] == 0 || std::hypot(apart.x, apart.y) > kSameStart_px;
    };
    if (!own.empty() && is_new(guesses[i])) starts.push_back(guesses[i]);
    const auto best = align_patch(from.full(), to.full(), points[i], starts, own);
    result.tracked[i] = best ? 1 : 0;
    if (!best) return;
    result.points[i] = best->point;
    result.residual[i] = best->residual;
    result.covariance[i] = best->covariance;
  };
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), kGrainSize),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t i = range.begin(); i < range.end(); ++i) align_one(i);
                    });
}

}  // namespace

void check(const KltOptions& options) {
  const auto& o = options;
  require(o.window_px >= 3 && o.window_px % 2 == 1, "klt: window_px must be odd and at least 3",
          o.window_px);
  require(o.pyramid_levels >= 0, "klt: pyramid_levels must not be negative", o.pyramid_levels);
  require(o.max_iterations > 0, "klt: max_iterations must be positive", o.max_iterations);
  require(o.epsilon_px > 0, "klt: epsilon_px must be positive", o.epsilon_px);
  require(o.max_forward_backward_px > 0, "klt: max_forward_backward_px must be positive",
          o.max_forward_backward_px);
  require(o.max_residual > 0, "klt: max_residual must be positive", o.max_residual);
}

ImagePyramid::ImagePyramid(const cv::Mat& gray, const KltOptions& options) {
  check(options);
  if (gray.empty() || gray.type() != CV_8UC1) {
    throw std::invalid_argument("klt: need a gray picture of 8 bits, got " +
                                std::to_string(gray.cols) + " x " + std::to_string(gray.rows) +
                                " of OpenCV type " + std::to_string(gray.type()));
  }
  cv::Mat smooth;
  cv::GaussianBlur(gray, smooth, cv::Size(), kSmoothing_px);
  cv::buildOpticalFlowPyramid(smooth, levels_, cv::Size(options.window_px, options.window_px),
                              options.pyramid_levels, true, cv::BORDER_REFLECT_101,
                              cv::BORDER_CONSTANT, false);
  smooth.convertTo(full_, CV_32F);
}

KltResult track_points(const ImagePyramid& from, const ImagePyramid& to,
                       const std::vector<cv::Point2f>& points,
                       const std::vector<cv::Point2f>& guesses, const KltOptions& options,
                       const PointLabels* labels) {
  check(options);
  if (from.size() != to.size()) {
    throw std::invalid_argument(
        "klt: pictures of different sizes, " + std::to_string(from.size().width) + " x " +
        std::to_string(from.size().height) + " and " + std::to_string(to.size().width) + " x " +
        std::to_string(to.size().height));
  }
  if (!guesses.empty() && guesses.size() != points.size()) {
    throw std::invalid_argument("klt: " + std::to_string(guesses.size()) + " guesses for " +
                                std::to_string(points.size()) + " points");
  }
  KltResult result;
  if (points.empty()) return result;
  const std::vector<cv::Point2f>& starts = guesses.empty() ? points : guesses;
  Flow forward = track_one_way(from, to, points, starts, options.pyramid_levels, options);
  result.tracked = come_back(from, to, points, forward, options);
  result.points = std::move(forward.points);
  result.residual.assign(points.size(), 0);
  result.covariance.assign(points.size(), Eigen::Matrix2f::Zero());
  align_all(from, to, points, starts, labels, result);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (result.residual[i] > static_cast<float>(options.max_residual)) result.tracked[i] = 0;
  }
  return result;
}

}  // namespace lidar_upsampling
