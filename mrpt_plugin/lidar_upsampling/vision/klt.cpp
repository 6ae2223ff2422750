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
#include <optional>
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

/// What aligns better, from where Lucas-Kanade has ended or, of a patch that shows others, too,
/// which pull it along, from the guess.
std::optional<Alignment> aligned(const PatchAligner& aligner, const cv::Mat& from,
                                 const cv::Mat& to, const cv::Point2f& point,
                                 const std::optional<cv::Point2f>& end, const cv::Point2f& guess,
                                 const std::vector<float>& own) {
  std::optional<Alignment> best;
  if (end) best = aligner.align(from, to, point, *end, own);
  if (own.empty()) return best;
  const auto other = aligner.align(from, to, point, guess, own);
  return other && (!best || other->residual < best->residual) ? other : best;
}

void align_all(const ImagePyramid& from, const ImagePyramid& to,
               const std::vector<cv::Point2f>& points, const std::vector<cv::Point2f>& guesses,
               const AlignmentOptions& options, const PointLabels* labels, KltResult& result) {
  const PatchAligner aligner(options);
  constexpr std::size_t kGrainSize = 32;
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, points.size(), kGrainSize),
      [&](const tbb::blocked_range<std::size_t>& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
          std::vector<float> own;
          if (labels != nullptr)
            own = aligner.own_pixels(labels->surfaces, labels->of_point[i], points[i]);
          if (result.tracked[i] == 0 && own.empty()) continue;
          std::optional<cv::Point2f> end;
          if (result.tracked[i] != 0) end = result.points[i];
          const auto found = aligned(aligner, from.levels().front(), to.levels().front(), points[i],
                                     end, guesses[i], own);
          result.tracked[i] = found ? 1 : 0;
          if (!found) continue;
          result.points[i] = found->point;
          result.residual[i] = found->residual;
          result.covariance[i] = found->covariance;
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
                       const std::vector<cv::Point2f>& guesses, const KltOptions& options,
                       const PointLabels* labels) {
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
  const std::vector<cv::Point2f>& starts = guesses.empty() ? points : guesses;
  Flow forward = track_one_way(from, to, points, starts, options.pyramid_levels, options);
  result.forward_backward_px = there_and_back(from, to, points, forward, options);
  result.tracked.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    result.tracked[i] =
        result.forward_backward_px[i] <= static_cast<float>(options.max_forward_backward_px) ? 1
                                                                                             : 0;
  result.points = std::move(forward.points);
  result.residual = std::move(forward.residual);
  result.covariance.assign(points.size(), Eigen::Matrix2f::Zero());
  if (options.align) align_all(from, to, points, starts, options.alignment, labels, result);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (result.residual[i] > static_cast<float>(options.max_residual)) result.tracked[i] = 0;
  }
  return result;
}

}  // namespace lidar_upsampling
