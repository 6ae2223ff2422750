// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <optional>
#include <vector>

namespace lidar_upsampling {

struct AlignmentOptions {
  int window_px = 17;  ///< side of the square patch, odd, at most 31
  int max_iterations = 12;
  double epsilon_px = 0.01;      ///< a step this short ends the iteration
  double max_correction_px = 2;  ///< from where the search starts
  double affine_sigma = 0.08;    ///< expected change of a patch's shape, per entry of its matrix
  double gain_sigma = 0.2;       ///< expected change of contrast
  double gray_sigma = 4;         ///< expected noise, gray levels
};

struct Alignment {
  cv::Point2f point;   ///< on the second picture
  float residual = 0;  ///< mean absolute difference after the change of gain and bias, gray levels
};

/// @brief Brings patches of one picture to lie on another by an affine warp with a change of gain
/// and bias (Lucas-Kanade as in Baker & Matthews, IJCV 2004, the extra freedom held by Gaussian
/// priors): a patch that grows or turns, as on a vehicle coming nearer, pulls a mere shift aside.
class PatchAligner {
 public:
  /// @throw std::invalid_argument options out of range.
  explicit PatchAligner(const AlignmentOptions& options = {});

  /// @param from, to CV_8UC1 pictures.
  /// @param guess where the point may be on `to`, within a pixel or two.
  /// @return none if the patch leaves a picture or the search does not settle.
  [[nodiscard]] std::optional<Alignment> align(const cv::Mat& from, const cv::Mat& to,
                                               const cv::Point2f& point,
                                               const cv::Point2f& guess) const;

 private:
  AlignmentOptions options_;
  std::vector<float> weight_;  ///< of each pixel, falling from the middle
};

}  // namespace lidar_upsampling
