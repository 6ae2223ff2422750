// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace lidar_upsampling {

struct RansacOptions {
  int min_iterations = 20;
  int max_iterations = 300;
  double confidence = 0.999;  ///< of having drawn one sample without outliers, in (0, 1)
  std::uint32_t seed = 1;
};

struct ModelScore {
  double cost = std::numeric_limits<double>::infinity();
  int num_inliers = 0;
};

template <typename Model>
struct RansacResult {
  std::optional<Model> model;  ///< none if no sample gave a model of finite cost
  ModelScore score;            ///< of the model
  int iterations = 0;
};

/// @throw std::invalid_argument
inline void check(const RansacOptions& options) {
  if (options.min_iterations < 0 || options.max_iterations < 1 ||
      options.min_iterations > options.max_iterations) {
    throw std::invalid_argument("ransac: need 0 <= min_iterations (" +
                                std::to_string(options.min_iterations) + ") <= max_iterations (" +
                                std::to_string(options.max_iterations) + "), the latter positive");
  }
  if (!(options.confidence > 0 && options.confidence < 1)) {
    throw std::invalid_argument("ransac: confidence must be between 0 and 1, not " +
                                std::to_string(options.confidence));
  }
}

namespace ransac_detail {

/// N different indices below `num_data`. The standard's distributions differ between libraries,
/// this does not.
template <std::size_t N>
std::array<int, N> draw_sample(int num_data, std::mt19937& generator) {
  std::array<int, N> sample{};
  for (std::size_t i = 0; i < N; ++i) {
    const auto drawn_before = sample.begin() + static_cast<std::ptrdiff_t>(i);
    do {
      const std::uint64_t wide =
          static_cast<std::uint64_t>(generator()) * static_cast<std::uint64_t>(num_data);
      sample[i] = static_cast<int>(wide >> 32);
    } while (std::find(sample.begin(), drawn_before, sample[i]) != drawn_before);
  }
  return sample;
}

/// Samples needed to draw an all-inlier one with the wanted confidence (Fischler & Bolles 1981).
inline int needed_iterations(double inlier_ratio, std::size_t sample_size,
                             const RansacOptions& options) {
  const double all_inliers = std::pow(inlier_ratio, static_cast<double>(sample_size));
  if (all_inliers >= 1) return options.min_iterations;
  const double needed = std::log1p(-options.confidence) / std::log1p(-all_inliers);
  if (!(needed < options.max_iterations)) return options.max_iterations;
  return std::max(options.min_iterations, static_cast<int>(std::ceil(needed)));
}

template <typename Estimator>
void keep_better(Estimator& estimator, typename Estimator::Model model,
                 RansacResult<typename Estimator::Model>& best) {
  const auto keep_if_better = [&] {
    const ModelScore score = estimator.score_model(model);
    if (!(score.cost < best.score.cost)) return false;
    best.model = model;
    best.score = score;
    return true;
  };
  if (!keep_if_better()) return;
  estimator.refine_model(model);
  keep_if_better();
}

}  // namespace ransac_detail

/// @brief The one hypothesise-and-test loop; the estimator of lowest cost wins (Fischler & Bolles
/// 1981; with `refine_model` as the local optimisation of Chum, Matas & Kittler 2003).
///
/// An estimator has a type `Model`, `static constexpr std::size_t sample_size`, `int num_data()`,
/// `void generate_models(const std::array<int, sample_size>&, std::vector<Model>*)`,
/// `ModelScore score_model(const Model&)` and `void refine_model(Model&)`, called for each new best
/// model and kept where it lowers the cost.
/// @param initial scored before all samples, if given.
/// @throw std::invalid_argument options out of range.
template <typename Estimator>
RansacResult<typename Estimator::Model> ransac(
    Estimator& estimator, const RansacOptions& options,
    const std::optional<typename Estimator::Model>& initial = std::nullopt) {
  check(options);
  RansacResult<typename Estimator::Model> best;
  if (initial) ransac_detail::keep_better(estimator, *initial, best);
  const int num_data = estimator.num_data();
  if (num_data < static_cast<int>(Estimator::sample_size)) return best;

  std::mt19937 generator(options.seed);
  std::vector<typename Estimator::Model> models;
  const auto needed = [&] {
    return ransac_detail::needed_iterations(static_cast<double>(best.score.num_inliers) / num_data,
                                            Estimator::sample_size, options);
  };
  for (int limit = needed(); best.iterations < limit; ++best.iterations) {
    models.clear();
    estimator.generate_models(
        ransac_detail::draw_sample<Estimator::sample_size>(num_data, generator), &models);
    for (const auto& model : models) ransac_detail::keep_better(estimator, model, best);
    limit = needed();
  }
  return best;
}

}  // namespace lidar_upsampling
