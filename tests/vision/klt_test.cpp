// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/vision/klt.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <random>

namespace lidar_upsampling {
namespace {

constexpr int kWidth = 320;
constexpr int kHeight = 200;

/// A texture known everywhere, not just at pixels: waves 7 to 50 px long in all directions.
class Texture {
 public:
  explicit Texture(std::uint32_t seed) {
    std::mt19937 generator(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int i = 0; i < 40; ++i) {
      const double length = 7 * std::pow(7, unit(generator));
      const double angle = 2 * M_PI * unit(generator);
      waves_.push_back({2 * M_PI / length * std::cos(angle), 2 * M_PI / length * std::sin(angle),
                        2 * M_PI * unit(generator)});
    }
  }

  [[nodiscard]] double at(const cv::Point2d& p) const {
    double sum = 0;
    for (const auto& wave : waves_) sum += std::sin(wave.kx * p.x + wave.ky * p.y + wave.phase);
    return 128 + 10 * sum;
  }

 private:
  struct Wave {
    double kx, ky, phase;
  };
  std::vector<Wave> waves_;
};

/// Where a point of the first picture is on the second: a turn and growth about the middle, a
/// shift.
struct Motion {
  double scale = 1;
  double turn = 0;
  cv::Point2d shift;

  [[nodiscard]] cv::Point2d apply(const cv::Point2d& p) const {
    const cv::Point2d d = p - centre();
    return centre() + shift + scale * rotated(d, turn);
  }
  [[nodiscard]] cv::Point2d undo(const cv::Point2d& p) const {
    return centre() + rotated((p - centre() - shift) / scale, -turn);
  }
  static cv::Point2d centre() { return {kWidth / 2., kHeight / 2.}; }
  static cv::Point2d rotated(const cv::Point2d& d, double angle) {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    return {c * d.x - s * d.y, s * d.x + c * d.y};
  }
};

struct Light {
  double gain = 1;
  double bias = 0;
  double noise = 1;
};

cv::Mat picture(const Motion& motion, const Light& light = {}, std::uint32_t texture = 1) {
  const Texture of(texture);
  std::mt19937 generator(99 + static_cast<std::uint32_t>(100 * motion.shift.x));
  std::normal_distribution<double> noise;
  cv::Mat image(kHeight, kWidth, CV_8UC1);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      const double gray = 128 + light.gain * (of.at(motion.undo(cv::Point2d(u, v))) - 128);
      image.at<std::uint8_t>(v, u) =
          cv::saturate_cast<std::uint8_t>(gray + light.bias + light.noise * noise(generator));
    }
  }
  return image;
}

std::vector<cv::Point2f> grid_of_points(int margin) {
  std::vector<cv::Point2f> points;
  for (int v = margin; v < kHeight - margin; v += 9) {
    for (int u = margin; u < kWidth - margin; u += 9) {
      points.emplace_back(
          static_cast<float>(u) + 0.01F * static_cast<float>((13 * u + 7 * v) % 100),
          static_cast<float>(v) + 0.01F * static_cast<float>((5 * u + 11 * v) % 100));
    }
  }
  return points;
}

struct Errors {
  double rms = 0;
  double tracked = 0;  ///< part of all
};

Errors measure(const KltResult& result, const std::vector<cv::Point2f>& points,
               const Motion& motion) {
  Errors errors;
  int count = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (result.tracked[i] == 0) continue;
    const cv::Point2d difference = cv::Point2d(result.points[i]) - motion.apply(points[i]);
    errors.rms += difference.dot(difference);
    ++count;
  }
  errors.rms = std::sqrt(errors.rms / std::max(1, count));
  errors.tracked = static_cast<double>(count) / static_cast<double>(points.size());
  return errors;
}

Errors track(const Motion& motion, const Light& light = {}) {
  const auto points = grid_of_points(40);
  const ImagePyramid from(picture({}));
  const ImagePyramid to(picture(motion, light));
  return measure(track_points(from, to, points), points, motion);
}

TEST(Klt, a_shift_is_found_to_a_twentieth_of_a_pixel) {
  for (const cv::Point2d& shift : {cv::Point2d(0, 0), cv::Point2d(0.5, 0.25),
                                   cv::Point2d(3.37, -1.81), cv::Point2d(-14.6, 9.3)}) {
    const Errors errors = track({1, 0, shift});
    EXPECT_LT(errors.rms, 0.05) << shift;
    EXPECT_GT(errors.tracked, 0.98) << shift;
  }
}

TEST(Klt, growth_and_turn_of_a_patch_do_not_pull_it_aside) {
  const Motion motion{1.05, 0.03, {2.3, -1.4}};
  const Errors aligned = track(motion);
  EXPECT_LT(aligned.rms, 0.08);
  EXPECT_GT(aligned.tracked, 0.95);
}

TEST(Klt, a_change_of_exposure_is_made_up_for) {
  const Errors errors = track({1, 0, {3.37, -1.81}}, {1.1, 6, 1});
  EXPECT_LT(errors.rms, 0.06);
  EXPECT_GT(errors.tracked, 0.9);
}

TEST(Klt, a_guess_leads_over_a_way_too_long_to_search) {
  const Motion motion{1, 0, {-95.3, 0.6}};
  std::vector<cv::Point2f> points;
  std::vector<cv::Point2f> guesses;
  for (const auto& point : grid_of_points(40)) {
    if (point.x < 140) continue;
    points.push_back(point);
    guesses.emplace_back(point.x - 93, point.y);
  }
  const ImagePyramid from(picture({}));
  const ImagePyramid to(picture(motion));
  const Errors guided = measure(track_points(from, to, points, guesses), points, motion);
  EXPECT_GT(guided.tracked, 0.95);
  EXPECT_LT(guided.rms, 0.05);
}

TEST(Klt, points_that_are_covered_by_something_else_are_not_tracked) {
  cv::Mat second = picture({1, 0, {2, 1}});
  const cv::Rect cover(100, 50, 100, 80);
  picture({}, {}, 2)(cover).copyTo(second(cover));
  std::vector<cv::Point2f> covered;
  for (const auto& point : grid_of_points(40)) {
    if (point.x > 115 && point.x < 185 && point.y > 65 && point.y < 115) covered.push_back(point);
  }
  ASSERT_GT(covered.size(), 20U);
  const auto result = track_points(ImagePyramid(picture({})), ImagePyramid(second), covered);
  EXPECT_LT(cv::countNonZero(result.tracked), 0.1 * static_cast<double>(covered.size()));
}

TEST(Klt, a_patch_that_leaves_the_picture_is_not_tracked) {
  const Motion motion{1, 0, {10, 0}};
  const std::vector<cv::Point2f> points{{6, 100}, {160, 6.5F}, {kWidth - 14, 100}, {160, 100}};
  const auto result =
      track_points(ImagePyramid(picture({})), ImagePyramid(picture(motion)), points);
  EXPECT_EQ(result.tracked, (std::vector<std::uint8_t>{0, 0, 0, 1}));
}

TEST(Klt, a_flat_area_is_not_tracked) {
  const cv::Mat flat(kHeight, kWidth, CV_8UC1, cv::Scalar(100));
  const auto result = track_points(ImagePyramid(flat), ImagePyramid(flat), {{100, 100}});
  EXPECT_EQ(result.tracked[0], 0);
}

TEST(Klt, the_result_does_not_depend_on_the_number_of_threads) {
  const auto points = grid_of_points(20);
  const ImagePyramid from(picture({}));
  const ImagePyramid to(picture({1.02, 0.01, {1.3, 0.7}}));
  const auto parallel = track_points(from, to, points);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
  const int num_threads = cv::getNumThreads();
  cv::setNumThreads(1);
  const auto serial = track_points(from, to, points);
  cv::setNumThreads(num_threads);
  EXPECT_EQ(parallel.tracked, serial.tracked);
  EXPECT_EQ(parallel.points, serial.points);
  EXPECT_EQ(parallel.residual, serial.residual);
}

TEST(Klt, patches_that_are_kept_are_found_on_further_pictures_where_new_ones_are) {
  const auto points = grid_of_points(20);
  const ImagePyramid from(picture({}));
  std::vector<PatchReference> kept(points.size());
  std::vector<PatchReference*> references;
  references.reserve(kept.size());
  for (PatchReference& reference : kept) references.push_back(&reference);
  for (const double shift : {0.3, 0.8}) {
    const ImagePyramid to(picture({1.01, 0.01, {shift, shift}}));
    const KltResult anew = align_points({from, to, points, points}, {});
    const KltResult again = align_points({from, to, points, points, nullptr, references}, {});
    EXPECT_GT(std::count(anew.tracked.begin(), anew.tracked.end(), 1), 50);
    EXPECT_EQ(again.tracked, anew.tracked);
    EXPECT_EQ(again.points, anew.points);
  }
}

TEST(Klt, no_points_give_an_empty_result) {
  const ImagePyramid pyramid(picture({}));
  const auto result = track_points(pyramid, pyramid, {});
  EXPECT_TRUE(result.points.empty());
  EXPECT_TRUE(result.tracked.empty());
}

TEST(Klt, wrong_input_is_refused) {
  const cv::Mat image = picture({});
  const ImagePyramid pyramid(image);
  EXPECT_THROW((void)track_points(pyramid, pyramid, {{50, 50}}, {{1, 1}, {2, 2}}),
               std::invalid_argument);
  EXPECT_THROW(
      (void)track_points(pyramid, ImagePyramid(image(cv::Rect(0, 0, 100, 100))), {{50, 50}}),
      std::invalid_argument);
  PatchReference one;
  EXPECT_THROW((void)align_points({pyramid, pyramid, {}, {}, nullptr, {&one}}, {}),
               std::invalid_argument);
  EXPECT_THROW(ImagePyramid{cv::Mat()}, std::invalid_argument);
  EXPECT_THROW((ImagePyramid{cv::Mat(100, 100, CV_8UC3)}), std::invalid_argument);
  KltOptions even_window;
  even_window.window_px = 14;
  EXPECT_THROW((ImagePyramid{image, even_window}), std::invalid_argument);
}

}  // namespace
}  // namespace lidar_upsampling
