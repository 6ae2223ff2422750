// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/network_output.h"

#include <cmath>

namespace lidar_upsampling {
namespace {

struct BestClass {
  int id = -1;
  double score = 0;
};

/// `stride` floats lie between the scores of one candidate.
BestClass best_class(const float* scores, std::size_t stride, const std::vector<bool>& wanted) {
  BestClass best;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const double score = scores[i * stride];
    if (wanted[i] && score > best.score) best = {static_cast<int>(i), score};
  }
  return best;
}

Box2d box_around(double cx, double cy, double width, double height) {
  return {cx - width / 2, cy - height / 2, cx + width / 2, cy + height / 2};
}

/// Candidates whose numbers lie `stride` apart, the next candidate `step` further.
struct Candidates {
  const float* data;
  int count;
  std::size_t stride, step;
  bool has_objectness;       ///< before the scores
  bool scale_by_objectness;  ///< Darknet's region layer has already done so
  cv::Size2d unit;           ///< of the coordinates
};

std::vector<NetworkBox> decode(const Candidates& c, const std::vector<bool>& wanted,
                               double min_score) {
  std::vector<NetworkBox> boxes;
  const int first_score = c.has_objectness ? 5 : 4;
  for (int i = 0; i < c.count; ++i) {
    const float* candidate = c.data + i * c.step;
    BestClass best = best_class(candidate + first_score * c.stride, c.stride, wanted);
    if (c.scale_by_objectness) best.score *= candidate[4 * c.stride];
    if (best.id < 0 || best.score < min_score) continue;
    const auto at = [&](int k) { return static_cast<double>(candidate[k * c.stride]); };
    boxes.push_back({box_around(at(0) / c.unit.width, at(1) / c.unit.height, at(2) / c.unit.width,
                                at(3) / c.unit.height),
                     best.id, best.score});
  }
  return boxes;
}

double sigmoid(double x) { return 1 / (1 + std::exp(-x)); }

/// FastestDet, as its authors publish it: centres by tanh about the cell, sizes by a sigmoid of the
/// picture, and a score of objectness^0.6 times class^0.4.
std::vector<NetworkBox> decode_anchor_free(const cv::Mat& output, const std::vector<bool>& wanted,
                                           double min_score) {
  std::vector<NetworkBox> boxes;
  const int height = output.size[2];
  const int width = output.size[3];
  const std::size_t plane = static_cast<std::size_t>(height) * width;
  const auto* data = output.ptr<float>();
  for (int cell = 0; cell < height * width; ++cell) {
    const float* candidate = data + cell;
    const BestClass best = best_class(candidate + 5 * plane, plane, wanted);
    if (best.id < 0) continue;
    const double score = std::pow(candidate[0], 0.6) * std::pow(best.score, 0.4);
    if (!(score >= min_score)) continue;
    const int row = cell / width;
    const int column = cell % width;
    const double cx = (column + std::tanh(candidate[plane])) / width;
    const double cy = (row + std::tanh(candidate[2 * plane])) / height;
    boxes.push_back(
        {box_around(cx, cy, sigmoid(candidate[3 * plane]), sigmoid(candidate[4 * plane])), best.id,
         score});
  }
  return boxes;
}

}  // namespace

std::optional<NetworkLayout> guess_layout(const cv::Mat& output, int num_classes) {
  const auto& size = output.size;
  if (output.type() != CV_32F) return std::nullopt;
  if (output.dims == 2 && size[1] == 5 + num_classes) return NetworkLayout::region;
  if (output.dims == 3 && size[0] == 1) {
    if (size[2] == 5 + num_classes) return NetworkLayout::rows;
    if (size[1] == 4 + num_classes) return NetworkLayout::columns;
  }
  if (output.dims == 4 && size[0] == 1 && size[1] == 5 + num_classes) {
    return NetworkLayout::anchor_free;
  }
  return std::nullopt;
}

std::vector<NetworkBox> decode_output(const cv::Mat& output, NetworkLayout layout,
                                      cv::Size input_size, const std::vector<bool>& wanted,
                                      double min_score) {
  const std::size_t num_classes = wanted.size();
  const auto* data = output.ptr<float>();
  const cv::Size2d pixels(input_size.width, input_size.height);
  switch (layout) {
    case NetworkLayout::region:
      return decode({data, output.size[0], 1, num_classes + 5, true, false, {1, 1}}, wanted,
                    min_score);
    case NetworkLayout::rows:
      return decode({data, output.size[1], 1, num_classes + 5, true, true, pixels}, wanted,
                    min_score);
    case NetworkLayout::columns:
      return decode(
          {data, output.size[2], static_cast<std::size_t>(output.size[2]), 1, false, false, pixels},
          wanted, min_score);
    case NetworkLayout::anchor_free:
      return decode_anchor_free(output, wanted, min_score);
  }
  return {};
}

}  // namespace lidar_upsampling
