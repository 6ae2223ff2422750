// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/vision/patch_alignment.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace lidar_upsampling {
namespace {

constexpr int kHalf = kPatchHalf_px;
constexpr int kWindow = 2 * kHalf + 1;
constexpr int kNumPixels = kWindow * kWindow;

// Expected changes of a patch: of its shape, per entry of the matrix, and of contrast; gray levels'
// noise.
constexpr double kAffineSigma = 0.08, kGainSigma = 0.2, kGraySigma = 4;

constexpr float kMaxAffine = 0.5F;      // a patch deformed more than this is another one
constexpr float kMinOwnShare = 0.2F;    // by weight: with less of its own surface a patch is lost
constexpr float kMaxCorrection_px = 2;  // from where the search starts
constexpr float kSettled_px = 0.01F;    // a step this short ends it
constexpr int kMaxIterations = 12;

/// Shift x, y; affine xx, xy, yx, yy; gain; bias.
using Parameters = Eigen::Matrix<float, 8, 1>;
using Pixels = std::array<float, kNumPixels>;
using Matrix8f = Eigen::Matrix<float, 8, 8>;

struct Template {
  Pixels gray, contrast;  ///< contrast: gray less its mean
  /// Of the weighted residuals, a column per pixel.
  Eigen::Matrix<float, 8, kNumPixels> jacobian;
};

bool inside(const cv::Mat& image, float x, float y) {
  return x >= 0 && y >= 0 && x < static_cast<float>(image.cols - 1) &&
         y < static_cast<float>(image.rows - 1);
}

/// A square of the picture whose pixels all lie alike between the picture's own.
/// @param out rows of `width` values.
void cut_out(const cv::Mat& image, float x, float y, int width, float* out) {
  const int left = static_cast<int>(x), top = static_cast<int>(y);
  const float fx = x - static_cast<float>(left), fy = y - static_cast<float>(top);
  std::array<float, kWindow + 3> upper, lower;
  const auto read = [&](int v, std::array<float, kWindow + 3>& row) {
    const float* from = image.ptr<float>(top + v) + left;
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
bool make_template(const cv::Mat& image, const cv::Point2f& point, const std::vector<float>& weight,
                   Template& result) {
  constexpr int width = kWindow + 2;
  constexpr float reach = kHalf + 1;
  if (!inside(image, point.x - reach, point.y - reach)) return false;
  if (!inside(image, point.x + reach, point.y + reach)) return false;
  std::array<float, width * width> gray;
  cut_out(image, point.x - reach, point.y - reach, width, gray.data());
  int i = 0;
  float sum = 0;
  for (int v = -kHalf; v <= kHalf; ++v) {
    for (int u = -kHalf; u <= kHalf; ++u, ++i) {
      const float* centre = gray.data() + (v + kHalf + 1) * width + u + kHalf + 1;
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

/// A row of a deformed patch, in loops over whole vectors.
class WarpedRow {
 public:
  /// @param x, y of its middle. @param by_x, by_y from pixel to pixel.
  WarpedRow(float x, float y, float by_x, float by_y) {
    for (int u = 0; u < kWidth; ++u) {
      const auto from_middle = static_cast<float>(u - kHalf);
      const float px = x + by_x * from_middle, py = y + by_y * from_middle;
      left_[u] = static_cast<int>(px);
      top_[u] = static_cast<int>(py);
      fx_[u] = px - static_cast<float>(left_[u]);
      fy_[u] = py - static_cast<float>(top_[u]);
    }
  }

  void sample(const float* pixels, int step, float* out) const {
    Row above{}, above_right{}, below{}, below_right{}, mixed;
    for (int u = 0; u < kWindow; ++u) {
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
    std::copy_n(mixed.begin(), kWindow, out);
  }

 private:
  static constexpr int kWidth = (kWindow + 3) / 4 * 4;  // vectors of four
  using Row = std::array<float, kWidth>;
  std::array<int, kWidth> left_, top_;
  Row fx_, fy_;
};

/// The patch of the second picture, deformed to the template's; false if it leaves the picture.
bool warp(const cv::Mat& image, const cv::Point2f& guess, const Parameters& p, Pixels& warped) {
  const float x0 = guess.x + p[0];
  const float y0 = guess.y + p[1];
  constexpr float reach = kHalf;
  const float reach_x = reach * (1 + std::abs(p[2]) + std::abs(p[3]));
  const float reach_y = reach * (1 + std::abs(p[4]) + std::abs(p[5]));
  if (!inside(image, x0 - reach_x, y0 - reach_y)) return false;
  if (!inside(image, x0 + reach_x, y0 + reach_y)) return false;
  if (p.segment<4>(2).isZero(0)) {
    cut_out(image, x0 - reach, y0 - reach, kWindow, warped.data());
    return true;
  }
  const float* const pixels = image.ptr<float>();
  const auto step = static_cast<int>(image.step1());
  for (int v = -kHalf; v <= kHalf; ++v) {
    const auto y = static_cast<float>(v);
    WarpedRow row(x0 + p[3] * y, y0 + y + p[5] * y, 1 + p[2], p[4]);
    row.sample(pixels, step, &warped[(v + kHalf) * kWindow]);
  }
  return true;
}

/// Of each pixel, falling from the middle.
std::vector<float> make_weights() {
  constexpr double sigma = 0.4 * kWindow;
  std::vector<float> weights;
  for (int v = -kHalf; v <= kHalf; ++v)
    for (int u = -kHalf; u <= kHalf; ++u)
      weights.push_back(static_cast<float>(std::exp(-0.5 * (u * u + v * v) / (sigma * sigma))));
  return weights;
}

}  // namespace

std::vector<float> own_pixels(const SurfaceMap& surfaces, std::int16_t label,
                              const cv::Point2f& point) {
  if (surfaces.label.empty() || label == SurfaceMap::kUnknown) return {};
  const cv::Point corner(cvRound(point.x) - kHalf, cvRound(point.y) - kHalf);
  const cv::Rect picture({}, surfaces.label.size());
  std::vector<float> own;
  for (int i = 0; i < kNumPixels; ++i) {
    const cv::Point pixel = corner + cv::Point(i % kWindow, i / kWindow);
    if (!picture.contains(pixel)) continue;
    const auto here = surfaces.label.at<std::int16_t>(pixel);
    if (here == label || here == SurfaceMap::kUnknown) continue;
    own.resize(kNumPixels, 1);
    own[i] = 0;
  }
  return own;
}

std::optional<Alignment> align_patch(const cv::Mat& from, const cv::Mat& to,
                                     const cv::Point2f& point, const cv::Point2f& guess,
                                     const std::vector<float>& own) {
  static const std::vector<float> kWeights = make_weights();
  std::vector<float> weights = kWeights;
  for (std::size_t i = 0; i < own.size(); ++i) weights[i] *= own[i];
  using Values = Eigen::Map<const Eigen::ArrayXf>;
  const Values weight(weights.data(), kNumPixels);
  const float weight_sum = weight.sum();
  if (weight_sum < kMinOwnShare * Values(kWeights.data(), kNumPixels).sum()) return std::nullopt;
  Template templ;
  if (!make_template(from, point, weights, templ)) return std::nullopt;
  const auto sq = [](double value) { return static_cast<float>(value * value); };
  Parameters prior;
  prior << 0, 0, Eigen::Vector4f::Constant(sq(kGraySigma / kAffineSigma)),
      sq(kGraySigma / kGainSigma), 0;
  Matrix8f normal = Matrix8f::Zero();
  normal.selfadjointView<Eigen::Lower>().rankUpdate(templ.jacobian);
  normal.diagonal() += prior;
  const Eigen::LLT<Matrix8f> solver(normal);
  if (solver.info() != Eigen::Success) return std::nullopt;

  Parameters p = Parameters::Zero();
  Pixels warped;
  const Values gray(templ.gray.data(), kNumPixels), contrast(templ.contrast.data(), kNumPixels);
  float residual = 0;
  for (int i = 0; i < kMaxIterations; ++i) {
    if (!warp(to, guess, p, warped)) return std::nullopt;
    Parameters gradient = prior.cwiseProduct(p);
    Eigen::Map<Eigen::ArrayXf> error(warped.data(), kNumPixels);
    error = weight * (error - gray - p[6] * contrast - p[7]);
    for (int k = 0; k < kNumPixels; ++k) gradient += error[k] * templ.jacobian.col(k);
    residual = error.abs().sum();
    const Parameters step = solver.solve(gradient);
    p -= step;
    if (!(p.head<2>().norm() < kMaxCorrection_px)) return std::nullopt;
    if (!(p.segment<4>(2).cwiseAbs().maxCoeff() < kMaxAffine)) return std::nullopt;
    if (step.head<2>().norm() < kSettled_px) break;
  }
  const Eigen::Matrix<float, 8, 2> by_shift = solver.solve(Matrix8f::Identity().leftCols<2>());
  return Alignment{guess + cv::Point2f(p[0], p[1]), residual / weight_sum,
                   sq(kGraySigma) * by_shift.topRows<2>()};
}

}  // namespace lidar_upsampling
