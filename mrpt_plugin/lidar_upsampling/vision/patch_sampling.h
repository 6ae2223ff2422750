// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <algorithm>
#include <array>
#include <opencv2/core/mat.hpp>

#include "lidar_upsampling/vision/patch_alignment.h"

namespace lidar_upsampling {

constexpr int kPatchSide_px = 2 * kPatchHalf_px + 1;

/// Whether there are pixels all around.
[[nodiscard]] inline bool inside(const cv::Mat& image, float x, float y) {
  return x >= 0 && y >= 0 && x < static_cast<float>(image.cols - 1) &&
         y < static_cast<float>(image.rows - 1);
}

/// A square of the picture whose pixels all lie alike between the picture's own.
/// @param out rows of `width` values.
template <int width, typename Pixel = float>
void cut_out(const cv::Mat& image, float x, float y, float* out) {
  constexpr int kWidth = (width + 3) / 4 * 4;  // vectors of four
  const int left = static_cast<int>(x), top = static_cast<int>(y);
  const float fx = x - static_cast<float>(left), fy = y - static_cast<float>(top);
  std::array<float, kWidth + 1> pixels{};
  std::array<std::array<float, kWidth>, 2> rows;
  std::array<float, kWidth> mixed;
  for (int v = 0; v <= width; ++v) {
    std::array<float, kWidth>&lower = rows[v % 2], &upper = rows[1 - v % 2];
    std::copy_n(image.ptr<Pixel>(top + v) + left, width + 1, pixels.begin());
    for (int u = 0; u < kWidth; ++u) lower[u] = pixels[u] + fx * (pixels[u + 1] - pixels[u]);
    if (v == 0) continue;
    for (int u = 0; u < kWidth; ++u) mixed[u] = upper[u] + fy * (lower[u] - upper[u]);
    out = std::copy_n(mixed.begin(), width, out);
  }
}

/// A row of a deformed patch, in loops over whole vectors.
class WarpedRow {
 public:
  /// @param x, y of its middle. @param by_x, by_y from pixel to pixel.
  WarpedRow(float x, float y, float by_x, float by_y) {
    for (int u = 0; u < kWidth; ++u) {
      const auto from_middle = static_cast<float>(u - kPatchHalf_px);
      const float px = x + by_x * from_middle, py = y + by_y * from_middle;
      left_[u] = static_cast<int>(px);
      top_[u] = static_cast<int>(py);
      fx_[u] = px - static_cast<float>(left_[u]);
      fy_[u] = py - static_cast<float>(top_[u]);
    }
  }

  void sample(const float* pixels, int step, float* out) const {
    Row above{}, above_right{}, below{}, below_right{}, mixed;
    for (int u = 0; u < kPatchSide_px; ++u) {
      const float* const upper = pixels + (top_[u] * step + left_[u]);
      above[u] = upper[0];
      above_right[u] = upper[1];
      below[u] = upper[step];
      below_right[u] = upper[step + 1];
    }
    for (int u = 0; u < kWidth; ++u) {
      const float at_left = above[u] + fy_[u] * (below[u] - above[u]);
      const float at_right = above_right[u] + fy_[u] * (below_right[u] - above_right[u]);
      mixed[u] = at_left + fx_[u] * (at_right - at_left);
    }
    std::copy_n(mixed.begin(), kPatchSide_px, out);
  }

 private:
  static constexpr int kWidth = (kPatchSide_px + 3) / 4 * 4;  // vectors of four
  using Row = std::array<float, kWidth>;
  std::array<int, kWidth> left_, top_;
  Row fx_, fy_;
};

}  // namespace lidar_upsampling
