// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/metrics/emd.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "clouds.h"

namespace lidar_upsampling {
namespace {

using testing::lidar_like_cloud;
using Points = std::vector<Eigen::Vector3f>;

const Points kFour{{0, 0, 0}, {1, 0, 0}, {5, 5, 1}, {30, 0, 0}};
const Points kOtherFour{{0.25, 0, 0}, {0.5, 0.5, 0}, {6, 4, 0}, {0, 40, 2}};

Points shifted_by(Points points, const Eigen::Vector3f& step) {
  for (auto& point : points) {
    point += step;
  }
  return points;
}

/// Straight from the published definition, in double and without any short cut.
struct DefinedEmd {
  Eigen::MatrixXd sq_distance;
  Eigen::VectorXd left_first, left_second, share_first, share_second;
  EarthMoverDistance sum;

  DefinedEmd(const Points& first, const Points& second)
      : sq_distance(first.size(), second.size()),
        left_first(Eigen::VectorXd::Ones(first.size())),
        left_second(left_first),
        share_first(left_first),
        share_second(left_first) {
    for (int k = 0; k < sq_distance.rows(); ++k) {
      for (int l = 0; l < sq_distance.cols(); ++l) {
        sq_distance(k, l) = (first[k].cast<double>() - second[l].cast<double>()).squaredNorm();
      }
    }
    for (int j = 7; j >= -1; --j) {
      match(-std::pow(4., j));
    }
    match(0);
    sum.squared_m2 /= static_cast<double>(first.size());
    sum.plain_m /= static_cast<double>(first.size());
  }

  void match(double level) {
    const Eigen::MatrixXd weight = (level * sq_distance).array().exp();
    share_first = left_first.array() / (1e-9 + (weight * left_second).array());
    const Eigen::ArrayXd offered = left_second.array() * (weight.transpose() * share_first).array();
    share_second = (left_second.array() / (offered + 1e-9)).min(1) * left_second.array();
    left_second = (left_second.array() - offered).max(0);
    const Eigen::MatrixXd moved = share_first.asDiagonal() * weight * share_second.asDiagonal();
    sum.squared_m2 += moved.cwiseProduct(sq_distance).sum();
    sum.plain_m += moved.cwiseProduct(sq_distance.cwiseSqrt()).sum();
    left_first = (left_first - moved.rowwise().sum()).cwiseMax(0);
  }
};

double cheapest_permutation(const Points& first, const Points& second) {
  std::vector<int> order(first.size());
  std::iota(order.begin(), order.end(), 0);
  double best = std::numeric_limits<double>::infinity();
  do {
    double sum = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
      sum += (first[i].cast<double>() - second[order[i]].cast<double>()).squaredNorm();
    }
    best = std::min(best, sum);
  } while (std::next_permutation(order.begin(), order.end()));
  return best / static_cast<double>(first.size());
}

TEST(ApproximateEmd, of_a_single_pair_is_their_distance) {
  const auto emd = approximate_emd({{1, 2, 3}}, {{1, 4, 3}});
  EXPECT_NEAR(emd.squared_m2, 4, 1e-5);
  EXPECT_NEAR(emd.plain_m, 2, 1e-5);
}

TEST(ApproximateEmd, spreads_evenly_what_lies_far_away) {
  // 40 and 60 m from each: every weight but the last temperature's is nothing.
  const auto emd = approximate_emd({{0, 0, 0}, {100, 0, 0}}, {{40, 0, 0}, {60, 0, 0}});
  EXPECT_NEAR(emd.squared_m2, (1600 + 3600) / 2., 1e-2);
  EXPECT_NEAR(emd.plain_m, (40 + 60) / 2., 1e-4);
}

TEST(ApproximateEmd, agrees_with_figures_computed_once_from_its_definition) {
  const auto emd = approximate_emd(kFour, kOtherFour);
  EXPECT_NEAR(emd.squared_m2, 626.8906236, 1e-2);
  EXPECT_NEAR(emd.plain_m, 13.18228539, 1e-4);
}

TEST(ApproximateEmd, agrees_with_its_definition_whatever_the_size) {
  // Blocks of the fast version hold 32 points.
  for (const int count : {2, 31, 32, 33, 65, 500}) {
    for (const float reach : {6.F, 60.F}) {
      const Points first = lidar_like_cloud(count, 1, reach);
      const Points second = shifted_by(lidar_like_cloud(count, 2, reach), {0.4F, 0.1F, 0});
      const auto emd = approximate_emd(first, second);
      const auto expected = DefinedEmd(first, second).sum;
      EXPECT_NEAR(emd.squared_m2, expected.squared_m2, 2e-5 * expected.squared_m2) << count;
      EXPECT_NEAR(emd.plain_m, expected.plain_m, 2e-5 * expected.plain_m) << count;
    }
  }
}

TEST(ApproximateEmd, of_nearly_the_same_cloud_is_nearly_nothing) {
  const Points points = lidar_like_cloud(400, 3);
  const auto emd = approximate_emd(points, shifted_by(points, {0, 0, 0.01F}));
  const auto expected = DefinedEmd(points, shifted_by(points, {0, 0, 0.01F})).sum;
  EXPECT_NEAR(emd.squared_m2, expected.squared_m2, 1e-4 * expected.squared_m2);
  EXPECT_LT(emd.plain_m, 0.05);
}

TEST(ApproximateEmd, does_not_depend_on_the_number_of_threads) {
  const Points first = lidar_like_cloud(700, 4), second = lidar_like_cloud(700, 5);
  const auto parallel = approximate_emd(first, second);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const auto serial = approximate_emd(first, second);
  EXPECT_EQ(parallel.squared_m2, serial.squared_m2);
  EXPECT_EQ(parallel.plain_m, serial.plain_m);
}

TEST(ApproximateEmd, names_both_sizes_where_they_differ) {
  EXPECT_THROW(static_cast<void>(approximate_emd({}, {})), std::invalid_argument);
  try {
    static_cast<void>(approximate_emd(lidar_like_cloud(17, 1), lidar_like_cloud(18, 1)));
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("17 and 18"), std::string::npos) << error.what();
  }
}

TEST(ExactEmd, agrees_with_figures_made_by_hand) {
  // Crosswise 0 -> 1 and 10 -> 12, not 0 -> 12 and 10 -> 1.
  const auto emd = exact_emd({{0, 0, 0}, {10, 0, 0}}, {{12, 0, 0}, {1, 0, 0}});
  EXPECT_DOUBLE_EQ(emd.squared_m2, 2.5);
  EXPECT_DOUBLE_EQ(emd.plain_m, 1.5);
  EXPECT_NEAR(exact_emd(kFour, kOtherFour).squared_m2, 460.890625, 1e-9);
}

TEST(ExactEmd, is_the_cheapest_of_all_permutations) {
  for (int count = 1; count <= 7; ++count) {
    for (unsigned seed = 0; seed < 20; ++seed) {
      const Points first = lidar_like_cloud(count, seed, 10);
      const Points second = shifted_by(lidar_like_cloud(count, seed + 100, 10), {3, 0, 0});
      EXPECT_NEAR(exact_emd(first, second).squared_m2, cheapest_permutation(first, second), 1e-9);
    }
  }
}

TEST(ExactEmd, of_a_shuffled_and_shifted_cloud_is_the_shift) {
  const Points points = lidar_like_cloud(600, 6);
  Points moved = shifted_by(points, {3, 4, 0});
  std::reverse(moved.begin(), moved.end());
  const auto emd = exact_emd(points, moved);
  EXPECT_NEAR(emd.squared_m2, 25, 1e-4);
  EXPECT_NEAR(emd.plain_m, 5, 1e-5);
}

TEST(ExactEmd, stands_points_on_top_of_each_other) {
  Points first(100, {0, 0, 0}), second(100, {0, 0, 0});
  std::fill(second.begin() + 60, second.end(), Eigen::Vector3f(2, 0, 0));
  EXPECT_NEAR(exact_emd(first, second).squared_m2, 0.4 * 4, 1e-9);
}

TEST(ExactEmd, is_below_the_approximation) {
  const Points first = lidar_like_cloud(300, 7), second = lidar_like_cloud(300, 8);
  const double exact = exact_emd(first, second).squared_m2;
  EXPECT_LT(exact, approximate_emd(first, second).squared_m2);
  EXPECT_GT(exact, 0);
}

TEST(ExactEmd, names_its_bound) {
  EXPECT_THROW(static_cast<void>(exact_emd({}, {})), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(exact_emd({{0, 0, 0}}, {})), std::invalid_argument);
  const Points many(kMaxExactEmdPoints + 1, {0, 0, 0});
  try {
    static_cast<void>(exact_emd(many, many));
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("at most 2048"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace lidar_upsampling
