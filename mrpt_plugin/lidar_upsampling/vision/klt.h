// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <vector>

#include "lidar_upsampling/vision/patch_alignment.h"

namespace lidar_upsampling {

struct KltOptions {
  int window_px = 15;      ///< side of the square patch, odd
  int pyramid_levels = 3;  ///< halvings above the full picture
  int max_iterations = 15;
  double epsilon_px = 0.02;              ///< a step this short ends the iteration
  double max_forward_backward_px = 0.5;  ///< distance from the point after tracking there and back
  double min_eigenvalue = 5e-4;  ///< of the gradient matrix, in cv::calcOpticalFlowPyrLK's units
  double max_residual = 15;      ///< mean absolute difference of the patches, gray levels
  bool align_first = true;  ///< what is where it is expected is not searched for; off: the paper
};

/// @throw std::invalid_argument
void check(const KltOptions& options);

/// @brief A picture at falling sizes with its gradients, made once and shared by all that track on
/// it.
class ImagePyramid {
 public:
  /// @param gray CV_8UC1; it is copied.
  /// @throw std::invalid_argument an empty picture, one of another type, options out of range.
  explicit ImagePyramid(const cv::Mat& gray, const KltOptions& options = {});

  /// Picture, gradients, picture, ... as OpenCV wants them.
  [[nodiscard]] const std::vector<cv::Mat>& levels() const { return levels_; }
  /// The full picture, CV_32FC1.
  [[nodiscard]] const cv::Mat& full() const { return full_; }
  [[nodiscard]] cv::Size size() const { return levels_.front().size(); }

 private:
  std::vector<cv::Mat> levels_;
  cv::Mat full_;
};

/// One entry per point; where `tracked` is 0 the others mean nothing.
struct KltResult {
  std::vector<cv::Point2f> points;
  std::vector<std::uint8_t> tracked;
  std::vector<float> residual;  ///< mean absolute difference of the patches, gray levels
  std::vector<Eigen::Matrix2f> covariance;  ///< px^2, as Alignment's
};

/// Of which surface of the first picture each point is.
struct PointLabels {
  const SurfaceMap& surfaces;
  std::vector<std::int16_t> of_point;
};

/// What is to be followed from one picture to another.
struct Patches {
  const ImagePyramid &from, &to;     ///< of one size
  std::vector<cv::Point2f> points;   ///< pixels on the first picture
  std::vector<cv::Point2f> guesses;  ///< where they may be on the second, as many
  /// Where patches show more than their own surface, only that is compared; null: they show one.
  const PointLabels* labels = nullptr;
  /// Of each on the first picture, made now where they are not yet; none: they are not kept.
  std::vector<PatchReference*> references = {};
};

/// @brief Brings the patches to lie where they are guessed, by align_patch(); those that do not
/// look alike there are not tracked. A point whose patch leaves either picture is never tracked.
/// @throw std::invalid_argument pictures of different sizes; guesses or references of another
/// number.
[[nodiscard]] KltResult align_points(const Patches& patches, const KltOptions& options);

/// @brief Searches for them by pyramidal Lucas-Kanade (Bouguet 2001), there and back (Kalal et al.,
/// ICPR 2010), and aligns them then, from where it ends or, if a patch shows others, too, from the
/// guess, whichever fits better.
/// @throw std::invalid_argument as above. @throw cv::Exception a pyramid made for a smaller window.
[[nodiscard]] KltResult search_points(const Patches& patches, const KltOptions& options);

/// @brief The points of surfaces of which most are not found: they seem to be elsewhere, and what
/// looks alike does so by chance. A surface that is where it was expected has its other points
/// hidden, or lit otherwise.
/// @param surface of each point.
[[nodiscard]] std::vector<std::size_t> points_elsewhere(const std::vector<int>& surface,
                                                        const std::vector<std::uint8_t>& found);

/// @brief Aligns the points of one surface, or searches for them if they are elsewhere.
/// @param guesses none: where they are on the first picture.
/// @throw std::invalid_argument, cv::Exception as above.
[[nodiscard]] KltResult track_points(const ImagePyramid& from, const ImagePyramid& to,
                                     const std::vector<cv::Point2f>& points,
                                     const std::vector<cv::Point2f>& guesses = {},
                                     const KltOptions& options = {},
                                     const PointLabels* labels = nullptr);

}  // namespace lidar_upsampling
