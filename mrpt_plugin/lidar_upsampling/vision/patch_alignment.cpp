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

#include "lidar_upsampling/vision/patch_sampling.h"

namespace lidar_upsampling {
namespace {

constexpr int kHalf = kPatchHalf_px, kWindow = kPatchSide_px;
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

}  // namespace

struct PatchParts {
  alignas(16) Pixels weight;  // as Eigen's sum begins where the memory is aligned
  float weight_sum = 0;
  Pixels gray, off_mean;                         // off_mean: gray less its mean
  Eigen::Matrix<float, 8, kNumPixels> jacobian;  // of the weighted residuals, a column per pixel
  Parameters prior;
  Eigen::LLT<Matrix8f> solver;
  float contrast = 0;          // as of an Alignment
  Eigen::Matrix2f covariance;  // likewise
};

namespace {

/// False if the patch with the pixels around it leaves the picture.
bool cut_template(const cv::Mat& image, const cv::Point2f& point, PatchParts& result) {
  constexpr int width = kWindow + 2;
  constexpr float reach = kHalf + 1;
  if (!inside(image, point.x - reach, point.y - reach)) return false;
  if (!inside(image, point.x + reach, point.y + reach)) return false;
  std::array<float, width * width> gray;
  cut_out<width>(image, point.x - reach, point.y - reach, gray.data());
  int i = 0;
  float sum = 0;
  for (int v = -kHalf; v <= kHalf; ++v) {
    for (int u = -kHalf; u <= kHalf; ++u, ++i) {
      const float* centre = gray.data() + (v + kHalf + 1) * width + u + kHalf + 1;
      const float gx = 0.5F * result.weight[i] * (centre[1] - centre[-1]);
      const float gy = 0.5F * result.weight[i] * (centre[width] - centre[-width]);
      const auto x = static_cast<float>(u);
      const auto y = static_cast<float>(v);
      result.gray[i] = *centre;
      sum += *centre;
      result.jacobian.col(i) << gx, gy, gx * x, gx * y, gy * x, gy * y, 0, -result.weight[i];
    }
  }
  const float mean = sum / static_cast<float>(i);
  for (int k = 0; k < i; ++k) {
    result.off_mean[k] = result.gray[k] - mean;
    result.jacobian(6, k) = -result.weight[k] * result.off_mean[k];
  }
  return true;
}

/// Whether the deformed patch lies in the second picture.
bool is_inside(const cv::Mat& image, const cv::Point2f& guess, const Parameters& p) {
  const float x0 = guess.x + p[0];
  const float y0 = guess.y + p[1];
  constexpr float reach = kHalf;
  const float reach_x = reach * (1 + std::abs(p[2]) + std::abs(p[3]));
  const float reach_y = reach * (1 + std::abs(p[4]) + std::abs(p[5]));
  return inside(image, x0 - reach_x, y0 - reach_y) && inside(image, x0 + reach_x, y0 + reach_y);
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

using Values = Eigen::Map<const Eigen::ArrayXf>;

float sq(double value) { return static_cast<float>(value * value); }

/// False if the patch leaves the picture or shows hardly anything of its own.
bool make_parts(const cv::Mat& image, const cv::Point2f& point, const std::vector<float>& own,
                PatchParts& result) {
  static const std::vector<float> kWeights = make_weights();
  static const float kWhole = Values(kWeights.data(), kNumPixels).sum();
  std::copy(kWeights.begin(), kWeights.end(), result.weight.begin());
  for (std::size_t i = 0; i < own.size(); ++i) result.weight[i] *= own[i];
  result.weight_sum = Values(result.weight.data(), kNumPixels).sum();
  if (result.weight_sum < kMinOwnShare * kWhole) return false;
  if (!cut_template(image, point, result)) return false;
  result.prior << 0, 0, Eigen::Vector4f::Constant(sq(kGraySigma / kAffineSigma)),
      sq(kGraySigma / kGainSigma), 0;
  Matrix8f normal = Matrix8f::Zero();
  normal.selfadjointView<Eigen::Lower>().rankUpdate(result.jacobian);
  normal.diagonal() += result.prior;
  result.solver.compute(normal);
  const Eigen::Matrix<float, 8, 2> by_shift =
      result.solver.solve(Matrix8f::Identity().leftCols<2>());
  result.covariance = sq(kGraySigma) * by_shift.topRows<2>();
  const Values weight(result.weight.data(), kNumPixels);
  result.contrast =
      (weight * Values(result.off_mean.data(), kNumPixels)).abs().sum() / result.weight_sum;
  return result.solver.info() == Eigen::Success;
}

/// Weighted differences of the deformed patch and the template, and what they say of the
/// parameters. Row by row, as the sums of one row wait for each other while the next is warped.
void compare(const cv::Mat& image, const cv::Point2f& guess, const Parameters& p,
             const PatchParts& patch, Pixels& error, Parameters& gradient) {
  const float x0 = guess.x + p[0], y0 = guess.y + p[1];
  const bool is_shift = p.segment<4>(2).isZero(0);
  if (is_shift) cut_out<kWindow>(image, x0 - kHalf, y0 - kHalf, error.data());
  const float* const pixels = image.ptr<float>();
  const auto step = static_cast<int>(image.step1());
  for (int v = -kHalf; v <= kHalf; ++v) {
    using Row = Eigen::Array<float, kWindow, 1>;
    using Part = Eigen::Map<const Row>;
    const int first = (v + kHalf) * kWindow;
    if (!is_shift) {
      const auto y = static_cast<float>(v);
      const WarpedRow row(x0 + p[3] * y, y0 + y + p[5] * y, 1 + p[2], p[4]);
      row.sample(pixels, step, &error[first]);
    }
    Eigen::Map<Row> differences(&error[first]);
    differences = Part(&patch.weight[first]) * (differences - Part(&patch.gray[first]) -
                                                p[6] * Part(&patch.off_mean[first]) - p[7]);
    for (int k = first; k < first + kWindow; ++k) gradient += error[k] * patch.jacobian.col(k);
  }
}

std::optional<Alignment> align_from(const cv::Mat& image, const cv::Point2f& guess,
                                    const PatchParts& patch) {
  Parameters p = Parameters::Zero();
  Pixels error;
  for (int i = 0; i < kMaxIterations; ++i) {
    if (!is_inside(image, guess, p)) return std::nullopt;
    Parameters gradient = patch.prior.cwiseProduct(p);
    compare(image, guess, p, patch, error, gradient);
    const Parameters step = patch.solver.solve(gradient);
    p -= step;
    if (!(p.head<2>().norm() < kMaxCorrection_px)) return std::nullopt;
    if (!(p.segment<4>(2).cwiseAbs().maxCoeff() < kMaxAffine)) return std::nullopt;
    if (step.head<2>().norm() < kSettled_px) break;
  }
  const float residual = Values(error.data(), kNumPixels).abs().sum();
  return Alignment{guess + cv::Point2f(p[0], p[1]), residual / patch.weight_sum, patch.contrast,
                   patch.covariance};
}

}  // namespace

std::vector<float> own_pixels(const SurfaceMap& surfaces, std::int16_t label,
                              const cv::Point2f& point) {
  if (surfaces.label.empty() || label == SurfaceMap::kUnknown) return {};
  const int left = cvRound(point.x) - kHalf, top = cvRound(point.y) - kHalf;
  const int first = std::max(0, -left), end = std::min(kWindow, surfaces.label.cols - left);
  std::vector<float> own;
  for (int v = std::max(0, -top); v < std::min(kWindow, surfaces.label.rows - top); ++v) {
    const std::int16_t* const row = surfaces.label.ptr<std::int16_t>(top + v);
    for (int u = first; u < end; ++u) {
      const std::int16_t here = row[left + u];
      if (here == label || here == SurfaceMap::kUnknown) continue;
      own.resize(kNumPixels, 1);
      own[v * kWindow + u] = 0;
    }
  }
  return own;
}

PatchReference::PatchReference(const cv::Mat& from, const cv::Point2f& point,
                               const std::vector<float>& own)
    : is_made_(true), shows_others_(!own.empty()) {
  auto parts = std::make_unique<PatchParts>();
  if (make_parts(from, point, own, *parts)) parts_ = std::move(parts);
}

std::optional<Alignment> PatchReference::align(const cv::Mat& to,
                                               const std::vector<cv::Point2f>& guesses) const {
  std::optional<Alignment> best;
  if (!parts_) return best;
  for (const cv::Point2f& guess : guesses) {
    auto found = align_from(to, guess, *parts_);
    if (found && (!best || found->residual < best->residual)) best = std::move(found);
  }
  return best;
}

std::optional<Alignment> align_patch(const cv::Mat& from, const cv::Mat& to,
                                     const cv::Point2f& point, const cv::Point2f& guess,
                                     const std::vector<float>& own) {
  return PatchReference(from, point, own).align(to, {guess});
}

}  // namespace lidar_upsampling
