// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <opencv2/dnn.hpp>
#include <string>
#include <vector>

#include "lidar_upsampling/objects/detector.h"
#include "lidar_upsampling/objects/network_output.h"

namespace lidar_upsampling {

/// @brief Boxes of the wanted classes by a network through cv::dnn, on the processor.
class NetworkDetector : public Detector {
 public:
  /// @brief Loads the model and runs it once, so that a wrong file or setting shows at start.
  /// @throw std::runtime_error a missing or unreadable file, an output of no known layout.
  /// @throw std::invalid_argument a setting out of range, a wanted class the network does not know.
  explicit NetworkDetector(const NetworkDetectorOptions& options);

  std::vector<Detection> detect(const DetectorInput& input) override;

 private:
  [[nodiscard]] std::vector<cv::Mat> run(const cv::Mat& picture);
  [[nodiscard]] cv::Size fitted_size(cv::Size picture) const;

  NetworkDetectorOptions options_;
  std::vector<std::string> class_names_;
  std::vector<bool> wanted_;  ///< per class
  cv::dnn::Net net_;
  std::vector<std::string> output_names_;
  cv::Size input_size_;
  NetworkLayout layout_ = NetworkLayout::region;
};

}  // namespace lidar_upsampling
