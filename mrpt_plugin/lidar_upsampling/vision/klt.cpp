// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/vision/klt.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
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
                   int levels, const KltOptions& options) {
  Flow flow;
  if (points.empty()) return flow;
  flow.points = guesses;
  const cv::TermCriteria stop(cv::TermCriteria::COUNT + cv::TermCriteria::EPS,
                              options.max_iterations, options.epsilon_px);
  cv::calcOpticalFlowPyrLK(from.levels(), to.levels(), points, flow.points, flow.found,
                           flow.residual, cv::Size(options.window_px, options.window_px), levels,
                           stop, cv::OPTFLOW_USE_INITIAL_FLOW, options.min_eigenvalue);
  return flow;
}

bool patch_inside(const cv::Size& size, const cv::Point2f& point, int window_px) {
  const int pixels = window_px / 2;
  const auto half = static_cast<float>(pixels);
  return point.x >= half && point.x <= static_cast<float>(size.width - 1) - half &&
         point.y >= half && point.y <= static_cast<float>(size.height - 1) - half;
}

// How far from where it started a point ends; infinitely far if it was not found both ways.
std::vector<float> there_and_back(const ImagePyramid& from, const ImagePyramid& to,
                                  const std::vector<cv::Point2f>& points, const Flow& forward,
                                  const KltOptions& options) {
  // The way back starts at its end, so that coarse levels have nothing to say.
  constexpr int kLevels = 1;
  std::vector<std::size_t> found;
  std::vector<cv::Point2f> begins, ends;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (forward.found[i] == 0 || !patch_inside(from.size(), points[i], options.window_px) ||
        !patch_inside(to.size(), forward.points[i], options.window_px))
      continue;
    found.push_back(i);
    begins.push_back(points[i]);
    ends.push_back(forward.points[i]);
  }
  const Flow back =
      track_one_way(to, from, ends, begins, std::min(kLevels, options.pyramid_levels), options);
  std::vector<float> distance(points.size(), std::numeric_limits<float>::infinity());
  for (std::size_t k = 0; k < found.size(); ++k) {
    if (back.found[k] == 0) continue;
    const cv::Point2f offset = back.points[k] - begins[k];
    distance[found[k]] = std::hypot(offset.x, offset.y);
  }
  return distance;
}

void align_all(const ImagePyramid& from, const ImagePyramid& to,
               const std::vector<cv::Point2f>& points, const AlignmentOptions& options,
               KltResult& result) {
  const PatchAligner aligner(options);
  constexpr std::size_t kGrainSize = 32;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), kGrainSize),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t i = range.begin(); i < range.end(); ++i) {
                        if (result.tracked[i] == 0) continue;
                        const auto aligned =
                            aligner.align(from.levels().front(), to.levels().front(), points[i],
                                          result.points[i]);
                        result.tracked[i] = aligned ? 1 : 0;
                        if (!aligned) continue;
                        result.points[i] = aligned->point;
                        result.residual[i] = aligned->residual;
                      }
                    });
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
  if (!(options.smoothing_px >= 0)) {
    complain("smoothing_px must not be negative", options.smoothing_px);
  }
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
  cv::Mat smooth = gray;
  if (options.smoothing_px > 0) {
    smooth = cv::Mat();
    cv::GaussianBlur(gray, smooth, cv::Size(), options.smoothing_px);
  }
  cv::buildOpticalFlowPyramid(smooth, levels_, cv::Size(window_px_, window_px_), pyramid_levels_,
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
  Flow forward = track_one_way(from, to, points, guesses.empty() ? points : guesses,
                               options.pyramid_levels, options);
  result.forward_backward_px = there_and_back(from, to, points, forward, options);
  result.tracked.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    result.tracked[i] =
        result.forward_backward_px[i] <= static_cast<float>(options.max_forward_backward_px) ? 1
                                                                                             : 0;
  result.points = std::move(forward.points);
  result.residual = std::move(forward.residual);
  if (options.align) align_all(from, to, points, options.alignment, result);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (result.residual[i] > static_cast<float>(options.max_residual)) result.tracked[i] = 0;
  }
  return result;
}

}  // namespace lidar_upsampling
