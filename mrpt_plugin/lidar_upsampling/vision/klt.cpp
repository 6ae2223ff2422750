// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/vision/klt.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>
#include <stdexcept>
#include <string>

#include "lidar_upsampling/checks.h"

namespace lidar_upsampling {
namespace {

constexpr std::size_t kPatchesAtOnce = 32;
constexpr float kAlike = 0.4F;    // of its contrast, by which a patch may differ from where it lies
constexpr double kIsThere = 0.5;  // of a surface's points that look alike where they are expected
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

std::vector<float> own_of(const Patches& patches, std::size_t i) {
  if (patches.labels == nullptr) return {};
  return own_pixels(patches.labels->surfaces, patches.labels->of_point[i], patches.points[i]);
}

/// The one that is kept, or else made for the time being.
const PatchReference& reference_of(const Patches& patches, std::size_t i, PatchReference& for_now) {
  PatchReference& reference = patches.references.empty() ? for_now : *patches.references[i];
  if (!reference.is_made())
    reference = PatchReference(patches.from.full(), patches.points[i], own_of(patches, i));
  return reference;
}

KltResult nothing_tracked(const Patches& patches) {
  const std::size_t count = patches.points.size();
  return {patches.guesses, std::vector<std::uint8_t>(count, 0), std::vector<float>(count, 0),
          std::vector<Eigen::Matrix2f>(count, Eigen::Matrix2f::Zero())};
}

void note(const Alignment& alignment, std::size_t i, KltResult& result) {
  result.tracked[i] = 1;
  result.points[i] = alignment.point;
  result.residual[i] = alignment.residual;
  result.covariance[i] = alignment.covariance;
}

/// Calls `align_one` for each of so many points.
template <typename Align>
void for_each_patch(std::size_t count, const Align& align_one) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, kPatchesAtOnce),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t i = range.begin(); i < range.end(); ++i) align_one(i);
                    });
}

void drop_unlike(KltResult& result, const KltOptions& options) {
  for (std::size_t i = 0; i < result.tracked.size(); ++i)
    if (result.residual[i] > static_cast<float>(options.max_residual)) result.tracked[i] = 0;
}

void check(const Patches& patches) {
  const cv::Size from = patches.from.size(), to = patches.to.size();
  if (from != to)
    throw std::invalid_argument("klt: pictures of different sizes, " + std::to_string(from.width) +
                                " x " + std::to_string(from.height) + " and " +
                                std::to_string(to.width) + " x " + std::to_string(to.height));
  const auto check_number = [&](std::size_t number, const char* what) {
    if (number != patches.points.size())
      throw std::invalid_argument("klt: " + std::to_string(number) + what +
                                  std::to_string(patches.points.size()) + " points");
  };
  check_number(patches.guesses.size(), " guesses for ");
  if (!patches.references.empty()) check_number(patches.references.size(), " references for ");
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

KltResult align_points(const Patches& patches, const KltOptions& options) {
  check(options);
  check(patches);
  KltResult result = nothing_tracked(patches);
  for_each_patch(patches.points.size(), [&](std::size_t i) {
    PatchReference for_now;
    const auto found =
        reference_of(patches, i, for_now).align(patches.to.full(), {patches.guesses[i]});
    if (found && found->residual < kAlike * found->contrast) note(*found, i, result);
  });
  drop_unlike(result, options);
  return result;
}

KltResult search_points(const Patches& patches, const KltOptions& options) {
  check(options);
  check(patches);
  KltResult result = nothing_tracked(patches);
  if (patches.points.empty()) return result;
  Flow flow = track_one_way(patches.from, patches.to, patches.points, patches.guesses,
                            options.pyramid_levels, options);
  flow.found = come_back(patches.from, patches.to, patches.points, flow, options);
  constexpr float kSameStart_px = 0.25F;  // as steps are whole pixels at first, they end alike
  for_each_patch(patches.points.size(), [&](std::size_t i) {
    if (flow.found[i] == 0 && patches.labels == nullptr) return;
    PatchReference for_now;
    const PatchReference& reference = reference_of(patches, i, for_now);
    const cv::Point2f& guess = patches.guesses[i];
    const cv::Point2f apart = guess - flow.points[i];
    const bool is_new = flow.found[i] == 0 || std::hypot(apart.x, apart.y) > kSameStart_px;
    std::vector<cv::Point2f> starts;
    if (flow.found[i] != 0) starts.push_back(flow.points[i]);
    if (reference.shows_others() && is_new) starts.push_back(guess);
    if (const auto best = reference.align(patches.to.full(), starts)) note(*best, i, result);
  });
  drop_unlike(result, options);
  return result;
}

std::vector<std::size_t> points_elsewhere(const std::vector<int>& surface,
                                          const std::vector<std::uint8_t>& found) {
  struct Count {
    int all = 0, found = 0;
  };
  std::map<int, Count> surfaces;
  for (std::size_t i = 0; i < found.size(); ++i) {
    Count& count = surfaces[surface[i]];
    ++count.all;
    count.found += found[i];
  }
  std::vector<std::size_t> which;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Count& count = surfaces[surface[i]];
    if (count.found < kIsThere * count.all) which.push_back(i);
  }
  return which;
}

KltResult track_points(const ImagePyramid& from, const ImagePyramid& to,
                       const std::vector<cv::Point2f>& points,
                       const std::vector<cv::Point2f>& guesses, const KltOptions& options,
                       const PointLabels* labels) {
  const Patches patches{from, to, points, guesses.empty() ? points : guesses, labels};
  KltResult result = align_points(patches, options);
  const std::vector<int> one_surface(points.size(), 0);
  return points_elsewhere(one_surface, result.tracked).empty() ? result
                                                               : search_points(patches, options);
}

}  // namespace lidar_upsampling
