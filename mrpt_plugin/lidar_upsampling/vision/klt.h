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

/// @brief Follows points from one picture to another: by align_patch() from where each is expected,
/// and where most of a surface does not look alike there, by pyramidal Lucas-Kanade (Bouguet 2001),
/// there and back (Kalal et al., ICPR 2010), aligned then. A point whose patch leaves either
/// picture is not tracked.
/// @param points pixels on the first picture.
/// @param guesses where they may be on the second; as many as points, or none.
/// @param labels where patches show more than their own surface, only that is compared, from where
/// Lucas-Kanade ends or from the guess, whichever fits better; null: patches show one surface.
/// @throw std::invalid_argument pictures of different sizes; guesses of another number.
/// @throw cv::Exception a pyramid made for a smaller window.
[[nodiscard]] KltResult track_points(const ImagePyramid& from, const ImagePyramid& to,
                                     const std::vector<cv::Point2f>& points,
                                     const std::vector<cv::Point2f>& guesses = {},
                                     const KltOptions& options = {},
                                     const PointLabels* labels = nullptr);

}  // namespace lidar_upsampling
