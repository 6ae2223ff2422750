// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <optional>
#include <vector>

namespace lidar_upsampling {

/// @brief Which surface the pixels of a picture show, so that a patch near a silhouette is compared
/// where it shows its own: what lies before or behind moves otherwise.
struct SurfaceMap {
  static constexpr std::int16_t kUnknown = -1;  ///< counts as anybody's
  cv::Mat label;  ///< CV_16S, of the picture's size; empty: nothing is known
};

constexpr int kPatchHalf_px = 8;  ///< of a patch's side, without its middle

struct Alignment {
  cv::Point2f point;   ///< on the second picture
  float residual = 0;  ///< mean absolute difference after the change of gain and bias, gray levels
  float contrast = 0;  ///< mean absolute difference of the first picture's patch from its mean
  /// Of the point, px^2, by the texture and the expected noise, whatever the change of shape.
  Eigen::Matrix2f covariance = Eigen::Matrix2f::Zero();
};

/// @brief Brings a patch of 17 pixels' side of one picture to lie on another by an affine warp with
/// a change of gain and bias (Lucas-Kanade as in Baker & Matthews, IJCV 2004, the extra freedom
/// held by Gaussian priors): a patch that grows or turns, as on a vehicle coming nearer, pulls a
/// mere shift aside.
/// @param from, to CV_32FC1 pictures, gray levels.
/// @param guess where the point may be on `to`, within a pixel or two.
/// @param own of each pixel of the patch on `from`, row by row, 1 or 0: what is not its own is not
/// compared; empty: all of it is.
/// @return none if the patch leaves a picture, shows hardly anything of its own, or the search does
/// not settle.
[[nodiscard]] std::optional<Alignment> align_patch(const cv::Mat& from, const cv::Mat& to,
                                                   const cv::Point2f& point,
                                                   const cv::Point2f& guess,
                                                   const std::vector<float>& own = {});

struct PatchParts;

/// @brief A patch of the first picture with all that is the same wherever it is looked for, 13 KB:
/// half of what an alignment takes, and therefore kept for the next picture or guess.
class PatchReference {
 public:
  PatchReference() = default;  ///< of no patch
  /// @param from, own as of align_patch().
  PatchReference(const cv::Mat& from, const cv::Point2f& point, const std::vector<float>& own);

  /// Whether it was made of a patch, of which something can be aligned or not.
  [[nodiscard]] bool is_made() const { return is_made_; }
  /// Whether some of its pixels show another surface.
  [[nodiscard]] bool shows_others() const { return shows_others_; }
  /// @brief From each of the guesses, what then looks most alike.
  /// @return as of align_patch(); none without a guess.
  [[nodiscard]] std::optional<Alignment> align(const cv::Mat& to,
                                               const std::vector<cv::Point2f>& guesses) const;

 private:
  std::shared_ptr<const PatchParts> parts_;  // null: nothing of it can be aligned
  bool is_made_ = false, shows_others_ = false;
};

/// @brief What of such a patch shows its own surface; all of it, if `label` is kUnknown.
/// @return empty if all does.
[[nodiscard]] std::vector<float> own_pixels(const SurfaceMap& surfaces, std::int16_t label,
                                            const cv::Point2f& point);

}  // namespace lidar_upsampling
