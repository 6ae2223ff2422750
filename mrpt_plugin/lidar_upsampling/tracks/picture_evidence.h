// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

#include "lidar_upsampling/tracks/hypotheses.h"

namespace lidar_upsampling {

/// One of the ways in which the object may move.
struct Way {
  double probability = 0;
  TrackState state;         ///< at the instant, as the filter has it
  MotionExpected expected;  ///< then, with scans to come
  bool is_told = false;     ///< by earlier pictures since its last sight, whose errors this one has
};

/// What a picture makes of the hypotheses.
struct PictureEvidence {
  MotionFit parked;
  std::vector<MotionFit> moving;  ///< each way
  std::vector<double> right;      ///< probability of each way and of a right picture, if it moves
  std::vector<double> wrong;      ///< likewise, but the points were found at wrong places
  double log_parked = 0, log_moving = 0;  ///< evidence
};

/// @brief What the picture tells if nothing is expected of the object.
/// @param of_ego the ego-motion's error.
/// @param starts as below; the track's own motion is one besides.
[[nodiscard]] MotionFit fit_of_any(const ObjectTrack& track, const ImageFactor& image,
                                   const MotionQuestion& question, const Matrix6d& of_ego,
                                   std::vector<Twist> starts, const TrackOptions& options);

/// @brief Fits every hypothesis to the picture, and weighs them: rightly asked, or with points that
/// were found at wrong places.
/// @param parked, ways what is expected, with all that the points may have wrong alike.
/// @param of_any as above.
/// @param starts motions from which the picture may be explained, besides.
[[nodiscard]] PictureEvidence evidence_of_picture(
    const ImageFactor& image, const MotionQuestion& question, const std::vector<Way>& ways,
    const MotionExpected& parked, const MotionFit& of_any, const std::vector<Twist>& starts,
    const TrackOptions& options);

}  // namespace lidar_upsampling
