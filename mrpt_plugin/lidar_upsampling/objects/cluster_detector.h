// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include "lidar_upsampling/objects/detector.h"

namespace lidar_upsampling {

/// @brief The default, which needs no weights: clusters of the key scan that are as large as road
/// users, with the boxes of their visible points. Finds nothing on images that are no key images.
class ClusterDetector : public Detector {
 public:
  explicit ClusterDetector(const ClusterDetectorOptions& options) : options_(options) {}

  /// `points` of each detection holds its cluster, seen or not; class "car", "truck" or
  /// "person" by size, "object" where that says nothing.
  std::vector<Detection> detect(const DetectorInput& input) override;

 private:
  ClusterDetectorOptions options_;
};

}  // namespace lidar_upsampling
