// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "test_world.h"

namespace lidar_upsampling::sim {
namespace {

World car_in_the_sun(const AppearanceSpec& appearance) {
  World world = empty_world();
  add_vehicle(world, "car", {9, 0, 0.5, 0, 0, {}});
  world.appearance = appearance;
  for (Object& object : world.objects) object.grain = static_cast<float>(appearance.grain);
  return world;
}

cv::Mat picture_of(const AppearanceSpec& appearance) {
  CameraSpec spec = test_camera();
  spec.noise = 0;
  return CameraRenderer(spec).render(car_in_the_sun(appearance), start_stamp(), 1).image.gray;
}

// What is left of the finest structure, on the road beside the car.
double roughness(const cv::Mat& picture) {
  cv::Mat edges;
  cv::Laplacian(picture(cv::Rect(590, 265, 55, 30)), edges, CV_32F);
  return cv::norm(edges, cv::NORM_L1) / static_cast<double>(edges.total());
}

TEST(Appearance, less_light_is_a_darker_picture) {
  const double day = cv::mean(picture_of({}))[0];
  const double overcast = cv::mean(picture_of({0, 1, 1}))[0];
  const double dusk = cv::mean(picture_of({0, 0.1, 1}))[0];
  EXPECT_LT(overcast, day - 10);
  EXPECT_LT(dusk, 0.5 * overcast);
}

TEST(Appearance, without_the_sun_nothing_throws_a_shadow) {
  // The sun stands behind the vehicle's right shoulder: the shadow falls ahead and to the left.
  const auto step_at_the_shadow = [](const cv::Mat& picture) {
    const cv::Rect strip(240, 220, 320, 12);
    double darkest = 0, brightest = 0;
    cv::Mat columns;
    cv::reduce(picture(strip), columns, 0, cv::REDUCE_AVG, CV_32F);
    cv::GaussianBlur(columns, columns, cv::Size(15, 1), 4);
    cv::minMaxLoc(columns, &darkest, &brightest);
    return brightest - darkest;
  };
  World world = car_in_the_sun({1, 1, 0});
  world.objects[1].motion = {6, 3, 0, 0, 0, {}};
  World dull = world;
  dull.appearance.sun = 0;
  CameraSpec spec = test_camera();
  spec.noise = 0;
  const CameraRenderer renderer(spec);
  const auto gray = [&](const World& w) { return renderer.render(w, start_stamp(), 1).image.gray; };
  const double with = step_at_the_shadow(gray(world)), without = step_at_the_shadow(gray(dull));
  EXPECT_GT(with, without + 10);
}

TEST(Appearance, without_grain_the_road_is_plain) {
  const double rough = roughness(picture_of({})), plain = roughness(picture_of({1, 1, 0}));
  EXPECT_GT(rough, 2);
  EXPECT_LT(plain, 0.2 * rough);
}

}  // namespace
}  // namespace lidar_upsampling::sim
