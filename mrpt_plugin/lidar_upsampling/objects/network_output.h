// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// How a network of the YOLO families writes its boxes. C classes, N candidates, all float:
enum class NetworkLayout {
  region,      ///< v2-v4 by Darknet: N x (cx cy w h objectness scores), parts of the input
  rows,        ///< v5 by ONNX: 1 x N x (cx cy w h objectness scores), input pixels
  columns,     ///< v8 by ONNX: 1 x (cx cy w h scores) x N, input pixels
  anchor_free  ///< FastestDet: 1 x (objectness, 4 offsets, scores) x H x W cells
};

/// One candidate in parts of the network's input, the best class and its score.
struct NetworkBox {
  Box2d box;
  int class_id = 0;
  double score = 0;
};

/// @return the layout that fits an output's shape, if any does.
[[nodiscard]] std::optional<NetworkLayout> guess_layout(const cv::Mat& output, int num_classes);

/// @brief The candidates at or above `min_score` of one output blob.
/// @param input_size px; the layouts in pixels are divided by it.
/// @param wanted per class, whether it counts.
[[nodiscard]] std::vector<NetworkBox> decode_output(const cv::Mat& output, NetworkLayout layout,
                                                    cv::Size input_size,
                                                    const std::vector<bool>& wanted,
                                                    double min_score);

}  // namespace lidar_upsampling
