// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <gtest/gtest.h>

#include "simulator/noise.h"
#include "test_world.h"

namespace lidar_upsampling::sim {
namespace {

TEST(Noise, octaves_finer_than_the_filter_are_gone) {
  const NoiseSpectrum spectrum{1, 8, 1};
  double coarse = 0, sharp = 0;
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d a(0.37 * i, 0.11 * i, 0.5), b = a + Eigen::Vector3d(0.02, 0, 0);
    coarse += std::abs(fractal_noise(a, 1, spectrum, 0.5) - fractal_noise(b, 1, spectrum, 0.5));
    sharp += std::abs(fractal_noise(a, 1, spectrum, 0.004) - fractal_noise(b, 1, spectrum, 0.004));
    EXPECT_EQ(fractal_noise(a, 1, spectrum, 1), 0);
  }
  EXPECT_LT(coarse, 0.1 * sharp);
}

TEST(Noise, a_stripe_covers_its_share_of_the_filter) {
  EXPECT_FLOAT_EQ(stripe(0.5, 0, 1, 0.1), 1);
  EXPECT_FLOAT_EQ(stripe(0, 0, 1, 0.1), 0.5);
  EXPECT_FLOAT_EQ(stripe(2, 0, 1, 0.1), 0);
  EXPECT_FLOAT_EQ(stripe(0.5, 0, 1, 4), 0.25);
  EXPECT_FLOAT_EQ(stripes(0.5, 2, 1, 0.1), 1);
  EXPECT_FLOAT_EQ(stripes(-0.5, 2, 1, 0.1), 0);
  EXPECT_NEAR(stripes(0.123, 0.01, 0.004, 1), 0.4, 1e-3);
}

TEST(Noise, its_gaussian_is_one) {
  double sum = 0, sq_sum = 0;
  for (std::uint32_t i = 0; i < 20000; ++i) {
    const double g = gaussian(7, i);
    sum += g;
    sq_sum += g * g;
  }
  EXPECT_NEAR(sum / 20000, 0, 0.03);
  EXPECT_NEAR(sq_sum / 20000, 1, 0.04);
}

TEST(Vehicles, every_type_fills_its_box_and_stays_in_it) {
  for (const char* const type : {"car", "van", "truck", "bus"}) {
    for (std::uint32_t seed = 0; seed < 3; ++seed) {
      const Object vehicle = make_vehicle(type, seed);
      Eigen::AlignedBox3d extent;
      for (const Part& part : vehicle.parts) {
        for (const Eigen::Vector3d& v : part.solid.vertices) extent.extend(v);
      }
      const VehicleShape& s = vehicle.shape;
      EXPECT_NEAR(extent.sizes().x(), s.length, 0.03) << type;
      EXPECT_NEAR(extent.sizes().y(), s.width, 0.06) << type;
      EXPECT_NEAR(extent.max().z(), s.height, 0.01) << type;
      EXPECT_NEAR(extent.min().z(), 0, 0.02) << type;
    }
  }
  EXPECT_THROW((void)make_vehicle("tank", 1), std::invalid_argument);
}

TEST(Solids, planes_corners_and_distances_fit_together) {
  const Solid prism = upright_prism({1, 2, 3}, 0.5, 0.5, 2, 6);
  EXPECT_EQ(prism.vertices.size(), 12U);
  EXPECT_NEAR(signed_distance(prism, {1, 2, 5.5}), 0.5, 1e-12);
  EXPECT_LT(signed_distance(prism, {1, 2, 4}), -0.4);
  for (const Eigen::Vector3d& v : prism.vertices) EXPECT_NEAR(signed_distance(prism, v), 0, 1e-9);
  EXPECT_THROW((void)cut(prism, {{Eigen::Vector3d::UnitZ(), -9}}), std::invalid_argument);
}

}  // namespace
}  // namespace lidar_upsampling::sim
