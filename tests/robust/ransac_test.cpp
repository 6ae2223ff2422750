// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/robust/ransac.h"

#include <gtest/gtest.h>

#include <set>

namespace lidar_upsampling {
namespace {

/// The value that most numbers agree on.
struct Consensus {
  using Model = double;
  static constexpr std::size_t sample_size = 2;
  std::vector<double> values;
  std::vector<std::array<int, 2>> samples;

  [[nodiscard]] int num_data() const { return static_cast<int>(values.size()); }

  void generate_models(const std::array<int, 2>& sample, std::vector<double>* models) {
    samples.push_back(sample);
    models->push_back(0.5 * (values[static_cast<std::size_t>(sample[0])] +
                             values[static_cast<std::size_t>(sample[1])]));
  }

  [[nodiscard]] ModelScore score_model(double model) const {
    ModelScore score{0, 0};
    for (const double value : values) {
      score.cost += std::min(1., std::abs(value - model));
      if (std::abs(value - model) < 1) ++score.num_inliers;
    }
    return score;
  }

  static void refine_model(double& /*model*/) {}
};

struct RoundingConsensus : Consensus {
  static void refine_model(double& model) { model = std::round(model); }
};

std::vector<double> seven_of_ten() { return {5.1, 4.9, 5.2, 4.8, 5.05, 4.95, 5, 90, -40, 17}; }

TEST(Ransac, the_model_of_lowest_cost_wins) {
  Consensus estimator{seven_of_ten(), {}};
  const auto result = ransac(estimator, RansacOptions{});
  ASSERT_TRUE(result.model);
  EXPECT_NEAR(*result.model, 5, 0.1);
  EXPECT_EQ(result.score.num_inliers, 7);
  EXPECT_DOUBLE_EQ(result.score.cost, estimator.score_model(*result.model).cost);
}

TEST(Ransac, samples_hold_different_indices_and_reach_all_data) {
  Consensus estimator{seven_of_ten(), {}};
  RansacOptions options;
  options.min_iterations = 200;
  (void)ransac(estimator, options);
  std::set<int> drawn;
  for (const auto& sample : estimator.samples) {
    EXPECT_NE(sample[0], sample[1]);
    drawn.insert(sample.begin(), sample.end());
  }
  EXPECT_EQ(drawn.size(), estimator.values.size());
}

TEST(Ransac, the_same_seed_draws_the_same_samples_and_another_one_does_not) {
  Consensus first{seven_of_ten(), {}};
  Consensus second = first;
  Consensus other = first;
  RansacOptions options;
  (void)ransac(first, options);
  (void)ransac(second, options);
  options.seed = 2;
  (void)ransac(other, options);
  EXPECT_EQ(first.samples, second.samples);
  EXPECT_NE(first.samples, other.samples);
}

TEST(Ransac, stops_early_only_if_inliers_are_many) {
  RansacOptions options;
  options.min_iterations = 3;
  Consensus clean{{5, 5, 5, 5, 5, 5}, {}};
  EXPECT_EQ(ransac(clean, options).iterations, 3);
  Consensus scattered{{0, 10, 20, 30, 40, 50, 60, 70, 80, 90, 100, 110}, {}};
  EXPECT_EQ(ransac(scattered, options).iterations, options.max_iterations);
  // 0.7^2 of the samples are clean: ln(1 - 0.999) / ln(1 - 0.49) = 10.3.
  Consensus estimator{seven_of_ten(), {}};
  EXPECT_EQ(ransac(estimator, options).iterations, 11);
}

TEST(Ransac, local_optimisation_is_kept_where_it_lowers_the_cost) {
  RoundingConsensus estimator;
  estimator.values = {5.0, 5.0, 5.3, 90};
  EXPECT_DOUBLE_EQ(ransac(estimator, RansacOptions{}).model.value(), 5);
  estimator.values = {5.4, 5.4, 5.4, 90};
  EXPECT_DOUBLE_EQ(ransac(estimator, RansacOptions{}).model.value(), 5.4);
}

TEST(Ransac, a_good_initial_model_survives_and_a_bad_one_does_not) {
  Consensus estimator{{4.5, 5.5, 4.6, 5.4, 90, -90}, {}};
  RansacOptions options;
  options.min_iterations = options.max_iterations = 1;
  EXPECT_DOUBLE_EQ(ransac(estimator, options, 5.0).model.value(), 5);
  options.max_iterations = 300;
  EXPECT_NEAR(ransac(estimator, options, 60.0).model.value(), 5, 0.5);
}

TEST(Ransac, too_few_data_give_no_model) {
  Consensus estimator{{5}, {}};
  EXPECT_FALSE(ransac(estimator, RansacOptions{}).model);
}

TEST(Ransac, options_out_of_range_are_refused) {
  Consensus estimator{seven_of_ten(), {}};
  RansacOptions options;
  options.confidence = 1;
  EXPECT_THROW((void)ransac(estimator, options), std::invalid_argument);
  options = {};
  options.min_iterations = options.max_iterations + 1;
  EXPECT_THROW((void)ransac(estimator, options), std::invalid_argument);
}

}  // namespace
}  // namespace lidar_upsampling
