// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/vision/klt.h"

#include <cmath>
#include <opencv2/video/tracking.hpp>
#include <stdexcept>
#include <string>

namespace lidar_upsampling {
namespace {

struct Flow {
  std::vector<cv::Point2f> points;
  std::vector<std::uint8_t> found;
  std::vector<float> residual;
};

Flow track_one_way(const ImagePyramid& from, const ImagePyramid& to,
                   const std::vector<cv::Point2f>& points, const std::vector<cv::Point2f>& guesses,
                   const KltOptions& options) {
  Flow flow;
  flow.points = guesses;
  const cv::TermCriteria stop(cv::TermCriteria::COUNT + cv::TermCriteria::EPS,
                              options.max_iterations, options.epsilon_px);
  cv::calcOpticalFlowPyrLK(from.levels(), to.levels(), points, flow.points, flow.found,
                           flow.residual, cv::Size(options.window_px, options.window_px),
                           options.pyramid_levels, stop, cv::OPTFLOW_USE_INITIAL_FLOW,
                           options.min_eigenvalue);
  return flow;
}

void check_fits(const ImagePyramid& pyramid, const KltOptions& options) {
  if (pyramid.empty()) throw std::invalid_argument("klt: an empty image pyramid");
  if (pyramid.window_px() == options.window_px &&
      pyramid.pyramid_levels() == options.pyramid_levels) {
    return;
  }
  throw std::invalid_argument(
      "klt: pyramid made for window_px = " + std::to_string(pyramid.window_px()) +
      " and pyramid_levels = " + std::to_string(pyramid.pyramid_levels()) + ", tracking asks for " +
      std::to_string(options.window_px) + " and " + std::to_string(options.pyramid_levels));
}

}  // namespace

void check(const KltOptions& options) {
  const auto complain = [](const std::string& what, double value) {
    throw std::invalid_argument("klt: " + what + ", not " + std::to_string(value));
  };
  if (options.window_px < 3 || options.window_px % 2 == 0) {
    complain("window_px must be odd and at least 3", options.window_px);
  }
  if (options.pyramid_levels < 0) {
    complain("pyramid_levels must not be negative", options.pyramid_levels);
  }
  if (options.max_iterations < 1) {
    complain("max_iterations must be positive", options.max_iterations);
  }
  if (!(options.epsilon_px > 0)) complain("epsilon_px must be positive", options.epsilon_px);
  if (!(options.max_forward_backward_px > 0)) {
    complain("max_forward_backward_px must be positive", options.max_forward_backward_px);
  }
  if (!(options.max_residual > 0)) complain("max_residual must be positive", options.max_residual);
}

ImagePyramid::ImagePyramid(const cv::Mat& gray, const KltOptions& options)
    : size_(gray.size()), window_px_(options.window_px), pyramid_levels_(options.pyramid_levels) {
  check(options);
  if (gray.empty() || gray.type() != CV_8UC1) {
    throw std::invalid_argument("klt: need a gray picture of 8 bits, got " +
                                std::to_string(gray.cols) + " x " + std::to_string(gray.rows) +
                                " of OpenCV type " + std::to_string(gray.type()));
  }
  cv::buildOpticalFlowPyramid(gray, levels_, cv::Size(window_px_, window_px_), pyramid_levels_,
                              true, cv::BORDER_REFLECT_101, cv::BORDER_CONSTANT, false);
}

KltResult track_points(const ImagePyramid& from, const ImagePyramid& to,
                       const std::vector<cv::Point2f>& points,
                       const std::vector<cv::Point2f>& guesses, const KltOptions& options) {
  check(options);
  check_fits(from, options);
  check_fits(to, options);
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
  Flow forward = track_one_way(from, to, points, guesses.empty() ? points : guesses, options);
  const Flow backward = track_one_way(to, from, forward.points, points, options);

  result.tracked.assign(points.size(), 0);
  result.forward_backward_px.assign(points.size(), 0);
  const auto half = static_cast<float>(options.window_px / 2);
  const auto patch_inside = [&](const cv::Point2f& p) {
    return p.x >= half && p.x <= static_cast<float>(from.size().width - 1) - half && p.y >= half &&
           p.y <= static_cast<float>(from.size().height - 1) - half;
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    const cv::Point2f there_and_back = backward.points[i] - points[i];
    const float distance = std::hypot(there_and_back.x, there_and_back.y);
    result.forward_backward_px[i] = distance;
    const bool good = forward.found[i] != 0 && backward.found[i] != 0 && patch_inside(points[i]) &&
                      patch_inside(forward.points[i]) &&
                      distance <= static_cast<float>(options.max_forward_backward_px) &&
                      forward.residual[i] <= static_cast<float>(options.max_residual);
    result.tracked[i] = good ? 1 : 0;
  }
  result.points = std::move(forward.points);
  result.residual = std::move(forward.residual);
  return result;
}

}  // namespace lidar_upsampling
