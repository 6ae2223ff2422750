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

namespace lidar_upsampling {
namespace {

constexpr int kMaxWindow = 31;
constexpr int kMaxPixels = kMaxWindow * kMaxWindow;

/// A patch deformed more than this is another one.
constexpr float kMaxAffine = 0.5F;

/// Shift x, y; affine xx, xy, yx, yy; gain; bias.
using Parameters = Eigen::Matrix<float, 8, 1>;
using Pixels = Eigen::Matrix<float, Eigen::Dynamic, 1, 0, kMaxPixels, 1>;
using PixelJacobian = Eigen::Matrix<float, Eigen::Dynamic, 8, 0, kMaxPixels, 8>;

struct Template {
  Pixels gray;
  Pixels contrast;         ///< gray less its mean
  PixelJacobian jacobian;  ///< of the weighted residuals
};

bool inside(const cv::Mat& image, float x, float y) {
  return x >= 0 && y >= 0 && x < static_cast<float>(image.cols - 1) &&
         y < static_cast<float>(image.rows - 1);
}

float interpolate(const cv::Mat& image, float x, float y) {
  const int left = static_cast<int>(x);
  const int top = static_cast<int>(y);
  const float fx = x - static_cast<float>(left);
  const float fy = y - static_cast<float>(top);
  const std::uint8_t* upper = image.data + static_cast<std::size_t>(top) * image.step[0] + left;
  const std::uint8_t* lower = upper + image.step[0];
  const float above = static_cast<float>(upper[0]) + fx * static_cast<float>(upper[1] - upper[0]);
  const float below = static_cast<float>(lower[0]) + fx * static_cast<float>(lower[1] - lower[0]);
  return above + fy * (below - above);
}

/// False if the patch with the pixels around it leaves the picture.
bool make_template(const cv::Mat& image, const cv::Point2f& point, int half,
                   const Eigen::Map<const Eigen::VectorXf>& weight, Template& result) {
  const int width = 2 * half + 3;
  const auto reach = static_cast<float>(half + 1);
  if (!inside(image, point.x - reach, point.y - reach)) return false;
  if (!inside(image, point.x + reach, point.y + reach)) return false;
  std::array<float, (kMaxWindow + 2) * (kMaxWindow + 2)> gray;
  float* next = gray.data();
  for (int v = 0; v < width; ++v) {
    for (int u = 0; u < width; ++u) {
      *next++ = interpolate(image, point.x - reach + static_cast<float>(u),
                            point.y - reach + static_cast<float>(v));
    }
  }
  result.gray.resize(weight.size());
  result.jacobian.resize(weight.size(), 8);
  int i = 0;
  for (int v = -half; v <= half; ++v) {
    for (int u = -half; u <= half; ++u, ++i) {
      const float* centre = gray.data() + (v + half + 1) * width + u + half + 1;
      const float gx = 0.5F * weight[i] * (centre[1] - centre[-1]);
      const float gy = 0.5F * weight[i] * (centre[width] - centre[-width]);
      const auto x = static_cast<float>(u);
      const auto y = static_cast<float>(v);
      result.gray[i] = *centre;
      result.jacobian.row(i).head<6>() << gx, gy, gx * x, gx * y, gy * x, gy * y;
    }
  }
  result.contrast = result.gray.array() - result.gray.mean();
  result.jacobian.col(6) = -weight.cwiseProduct(result.contrast);
  result.jacobian.col(7) = -weight;
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
  int i = 0;
  for (int v = -half; v <= half; ++v) {
    const auto y = static_cast<float>(v);
    for (int u = -half; u <= half; ++u, ++i) {
      const auto x = static_cast<float>(u);
      warped[i] = interpolate(image, x0 + x + p[2] * x + p[3] * y, y0 + y + p[4] * x + p[5] * y);
    }
  }
  return true;
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

std::optional<Alignment> PatchAligner::align(const cv::Mat& from, const cv::Mat& to,
                                             const cv::Point2f& point,
                                             const cv::Point2f& guess) const {
  const int half = options_.window_px / 2;
  const Eigen::Map<const Eigen::VectorXf> weight(weight_.data(),
                                                 static_cast<Eigen::Index>(weight_.size()));
  Template templ;
  if (!make_template(from, point, half, weight, templ)) return std::nullopt;
  const auto sq = [](double value) { return static_cast<float>(value * value); };
  Parameters prior;
  prior << 0, 0, Eigen::Vector4f::Constant(sq(options_.gray_sigma / options_.affine_sigma)),
      sq(options_.gray_sigma / options_.gain_sigma), 0;
  Eigen::Matrix<float, 8, 8> normal = templ.jacobian.transpose() * templ.jacobian;
  normal.diagonal() += prior;
  const Eigen::LLT<Eigen::Matrix<float, 8, 8>> solver(normal);
  if (solver.info() != Eigen::Success) return std::nullopt;

  Parameters p = Parameters::Zero();
  Pixels residual(weight.size());
  for (int i = 0; i < options_.max_iterations; ++i) {
    if (!warp(to, guess, half, p, residual)) return std::nullopt;
    residual -= templ.gray + p[6] * templ.contrast;
    residual = (residual.array() - p[7]) * weight.array();
    const Parameters step =
        solver.solve(templ.jacobian.transpose() * residual + prior.cwiseProduct(p));
    p -= step;
    if (!(p.head<2>().norm() < static_cast<float>(options_.max_correction_px))) return std::nullopt;
    if (!(p.segment<4>(2).cwiseAbs().maxCoeff() < kMaxAffine)) return std::nullopt;
    if (step.head<2>().norm() < static_cast<float>(options_.epsilon_px)) break;
  }
  return Alignment{guess + cv::Point2f(p[0], p[1]), residual.lpNorm<1>() / weight.sum()};
}

}  // namespace lidar_upsampling
