// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/vision/patch_alignment.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>

namespace lidar_upsampling {
namespace {

constexpr int kMaxWindow = 31;
constexpr int kMaxPixels = kMaxWindow * kMaxWindow;

/// A patch deformed more than this is another one.
constexpr float kMaxAffine = 0.5F;

/// Shift x, y; affine xx, xy, yx, yy; gain; bias.
using Parameters = Eigen::Matrix<float, 8, 1>;
using Pixels = std::array<float, kMaxPixels>;

struct Template {
  Pixels gray, contrast;  ///< contrast: gray less its mean
  /// Of the weighted residuals, a column per pixel.
  Eigen::Matrix<float, 8, kMaxPixels> jacobian;
};

bool inside(const cv::Mat& image, float x, float y) {
  return x >= 0 && y >= 0 && x < static_cast<float>(image.cols - 1) &&
         y < static_cast<float>(image.rows - 1);
}

const std::uint8_t* pixel_at(const cv::Mat& image, int left, int top) {
  return image.data + static_cast<std::size_t>(top) * image.step[0] + left;
}

/// A square of the picture whose pixels all lie alike between the picture's own.
/// @param out rows of `width` values.
void cut_out(const cv::Mat& image, float x, float y, int width, float* out) {
  const int left = static_cast<int>(x), top = static_cast<int>(y);
  const float fx = x - static_cast<float>(left), fy = y - static_cast<float>(top);
  std::array<float, kMaxWindow + 3> upper, lower;
  const auto read = [&](int v, std::array<float, kMaxWindow + 3>& row) {
    const std::uint8_t* from = pixel_at(image, left, top + v);
    for (int u = 0; u <= width; ++u) row[u] = from[u];
    for (int u = 0; u < width; ++u) row[u] += fx * (row[u + 1] - row[u]);
  };
  read(0, upper);
  for (int v = 1; v <= width; ++v, out += width) {
    read(v, lower);
    for (int u = 0; u < width; ++u) out[u] = upper[u] + fy * (lower[u] - upper[u]);
    std::swap(upper, lower);
  }
}

/// False if the patch with the pixels around it leaves the picture.
bool make_template(const cv::Mat& image, const cv::Point2f& point, int half,
                   const std::vector<float>& weight, Template& result) {
  const int width = 2 * half + 3;
  const auto reach = static_cast<float>(half + 1);
  if (!inside(image, point.x - reach, point.y - reach)) return false;
  if (!inside(image, point.x + reach, point.y + reach)) return false;
  std::array<float, (kMaxWindow + 2) * (kMaxWindow + 2)> gray;
  cut_out(image, point.x - reach, point.y - reach, width, gray.data());
  int i = 0;
  float sum = 0;
  for (int v = -half; v <= half; ++v) {
    for (int u = -half; u <= half; ++u, ++i) {
      const float* centre = gray.data() + (v + half + 1) * width + u + half + 1;
      const float gx = 0.5F * weight[i] * (centre[1] - centre[-1]);
      const float gy = 0.5F * weight[i] * (centre[width] - centre[-width]);
      const auto x = static_cast<float>(u);
      const auto y = static_cast<float>(v);
      result.gray[i] = *centre;
      sum += *centre;
      result.jacobian.col(i) << gx, gy, gx * x, gx * y, gy * x, gy * y, 0, -weight[i];
    }
  }
  const float mean = sum / static_cast<float>(i);
  for (int k = 0; k < i; ++k) {
    result.contrast[k] = result.gray[k] - mean;
    result.jacobian(6, k) = -weight[k] * result.contrast[k];
  }
  return true;
}

/// The patch of the second picture, deformed to the template's; false if it leaves the picture.
bool warp(const cv::Mat& image, const cv::Point2f& guess, int half, const Parameters& p,
          Pixels& warped) {
  const float x0 = guess.x + p[0];
  const float y0 = guess.y + p[1];
  const auto reach = static_cast<float>(half);
  const float reach_x = reach * (1 + std::abs(p[2]) + std::abs(p[3]));
  const float reach_y = reach * (1 + std::abs(p[4]) + std::abs(p[5]));
  if (!inside(image, x0 - reach_x, y0 - reach_y)) return false;
  if (!inside(image, x0 + reach_x, y0 + reach_y)) return false;
  if (p.segment<4>(2).isZero(0)) {
    cut_out(image, x0 - reach, y0 - reach, 2 * half + 1, warped.data());
    return true;
  }
  const std::uint8_t* const pixels = image.data;
  const auto step = static_cast<std::ptrdiff_t>(image.step[0]);
  int i = 0;
  for (int v = -half; v <= half; ++v) {
    const auto y = static_cast<float>(v);
    const float row_x = x0 + p[3] * y, row_y = y0 + y + p[5] * y;
    for (int u = -half; u <= half; ++u, ++i) {
      const float px = row_x + (1 + p[2]) * static_cast<float>(u);
      const float py = row_y + p[4] * static_cast<float>(u);
      const int left = static_cast<int>(px), top = static_cast<int>(py);
      const float fx = px - static_cast<float>(left), fy = py - static_cast<float>(top);
      const std::uint8_t* upper = pixels + top * step + left;
      const std::uint8_t* lower = upper + step;
      const int above = upper[0], below = lower[0];
      const float at_left = static_cast<float>(above) + fy * static_cast<float>(below - above);
      const int above_right = upper[1], below_right = lower[1];
      const float at_right =
          static_cast<float>(above_right) + fy * static_cast<float>(below_right - above_right);
      warped[i] = at_left + fx * (at_right - at_left);
    }
  }
  return true;
}

/// J J' of the first columns; only the lower triangle is filled. In blocks that fit into registers.
Eigen::Matrix<float, 8, 8> squared(const Eigen::Matrix<float, 8, kMaxPixels>& jacobian, int size) {
  Eigen::Matrix<float, 8, 8> result;
  for (const auto& [row, column] : {std::pair(0, 0), std::pair(4, 0), std::pair(4, 4)}) {
    Eigen::Vector4f a = Eigen::Vector4f::Zero(), b = a, c = a, d = a;
    for (int k = 0; k < size; ++k) {
      const Eigen::Vector4f left = jacobian.col(k).segment<4>(row);
      const Eigen::Vector4f right = jacobian.col(k).segment<4>(column);
      a += right[0] * left;
      b += right[1] * left;
      c += right[2] * left;
      d += right[3] * left;
    }
    result.block<4, 4>(row, column) << a, b, c, d;
  }
  return result;
}

}  // namespace

PatchAligner::PatchAligner(const AlignmentOptions& options) : options_(options) {
  if (options.window_px < 3 || options.window_px > kMaxWindow || options.window_px % 2 == 0) {
    throw std::invalid_argument("patch alignment: window_px must be odd and within [3, 31], not " +
                                std::to_string(options.window_px));
  }
  const auto positive = [](const char* name, double value) {
    if (value > 0) return;
    throw std::invalid_argument(std::string("patch alignment: ") + name +
                                " must be positive, not " + std::to_string(value));
  };
  positive("max_iterations", options.max_iterations);
  positive("epsilon_px", options.epsilon_px);
  positive("max_correction_px", options.max_correction_px);
  positive("affine_sigma", options.affine_sigma);
  positive("gain_sigma", options.gain_sigma);
  positive("gray_sigma", options.gray_sigma);
  const int half = options.window_px / 2;
  const double sigma = 0.4 * options.window_px;
  for (int v = -half; v <= half; ++v) {
    for (int u = -half; u <= half; ++u) {
      weight_.push_back(static_cast<float>(std::exp(-0.5 * (u * u + v * v) / (sigma * sigma))));
    }
  }
}

std::vector<float> PatchAligner::own_pixels(const SurfaceMap& surfaces, std::int16_t label,
                                            const cv::Point2f& point) const {
  if (surfaces.label.empty() || label == SurfaceMap::kUnknown) return {};
  const int half = options_.window_px / 2;
  const int left = cvRound(point.x) - half, top = cvRound(point.y) - half;
  std::vector<float> own;
  for (int v = 0, i = 0; v <= 2 * half; ++v) {
    for (int u = 0; u <= 2 * half; ++u, ++i) {
      if (left + u < 0 || top + v < 0 || left + u >= surfaces.label.cols ||
          top + v >= surfaces.label.rows)
        continue;
      const std::int16_t here = surfaces.label.at<std::int16_t>(top + v, left + u);
      if (here == label || here == SurfaceMap::kUnknown) continue;
      own.resize(weight_.size(), 1);
      own[i] = 0;
    }
  }
  return own;
}

std::optional<Alignment> PatchAligner::align(const cv::Mat& from, const cv::Mat& to,
                                             const cv::Point2f& point, const cv::Point2f& guess,
                                             const std::vector<float>& own) const {
  const int half = options_.window_px / 2;
  const int size = static_cast<int>(weight_.size());
  std::vector<float> of_own = own;
  for (std::size_t i = 0; i < own.size(); ++i) of_own[i] *= weight_[i];
  const std::vector<float>& weights = own.empty() ? weight_ : of_own;
  const Eigen::Map<const Eigen::ArrayXf> weight(weights.data(), size);
  const Eigen::Map<const Eigen::ArrayXf> whole(weight_.data(), size);
  const float weight_sum = weight.sum();
  if (weight_sum < static_cast<float>(options_.min_own_share) * whole.sum()) return std::nullopt;
  Template templ;
  if (!make_template(from, point, half, weights, templ)) return std::nullopt;
  const auto sq = [](double value) { return static_cast<float>(value * value); };
  Parameters prior;
  prior << 0, 0, Eigen::Vector4f::Constant(sq(options_.gray_sigma / options_.affine_sigma)),
      sq(options_.gray_sigma / options_.gain_sigma), 0;
  Eigen::Matrix<float, 8, 8> normal = squared(templ.jacobian, size);
  normal.diagonal() += prior;
  const Eigen::LLT<Eigen::Matrix<float, 8, 8>> solver(normal);
  if (solver.info() != Eigen::Success) return std::nullopt;

  Parameters p = Parameters::Zero();
  Pixels warped;
  const Eigen::Map<const Eigen::ArrayXf> gray(templ.gray.data(), size);
  const Eigen::Map<const Eigen::ArrayXf> contrast(templ.contrast.data(), size);
  float residual = 0;
  for (int i = 0; i < options_.max_iterations; ++i) {
    if (!warp(to, guess, half, p, warped)) return std::nullopt;
    Parameters gradient = prior.cwiseProduct(p);
    Eigen::Map<Eigen::ArrayXf> error(warped.data(), size);
    error = weight * (error - gray - p[6] * contrast - p[7]);
    for (int k = 0; k < size; ++k) gradient += error[k] * templ.jacobian.col(k);
    residual = error.abs().sum();
    const Parameters step = solver.solve(gradient);
    p -= step;
    if (!(p.head<2>().norm() < static_cast<float>(options_.max_correction_px))) return std::nullopt;
    if (!(p.segment<4>(2).cwiseAbs().maxCoeff() < kMaxAffine)) return std::nullopt;
    if (step.head<2>().norm() < static_cast<float>(options_.epsilon_px)) break;
  }
  const Eigen::Matrix<float, 8, 2> by_shift =
      solver.solve(Eigen::Matrix<float, 8, 8>::Identity().leftCols<2>());
  return Alignment{guess + cv::Point2f(p[0], p[1]), residual / weight_sum,
                   sq(options_.gray_sigma) * by_shift.topRows<2>()};
}

}  // namespace lidar_upsampling
