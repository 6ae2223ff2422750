// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "simulator/motion.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace lidar_upsampling::sim {
namespace {

// Explicit small steps, against the closed form.
MotionState integrated(const MotionProfile& profile, double t) {
  constexpr double dt = 1e-5;
  MotionState s{profile.x, profile.y, profile.yaw, profile.z, profile.speed, 0};
  for (int i = 0; i < std::lround(t / dt); ++i) {
    MotionPhase phase;
    for (const MotionPhase& p : profile.phases) {
      if (p.t <= (i + 0.5) * dt) phase = p;
    }
    const double before = s.speed;
    s.speed = std::max(0., s.speed + phase.acceleration * dt);
    const double mean = 0.5 * (before + s.speed);
    const double turned = mean > 0 ? phase.yaw_rate * dt : 0;
    s.x += mean * dt * std::cos(s.yaw + 0.5 * turned);
    s.y += mean * dt * std::sin(s.yaw + 0.5 * turned);
    s.yaw += turned;
  }
  return s;
}

TEST(Motion, the_closed_form_is_what_small_steps_lead_to) {
  const MotionProfile profile{1, 2, 0.3, 0, 8, {{0.2, 1.5, 0.4}, {0.9, -6, -0.7}, {1.8, 0, 0.2}}};
  for (const double t : {0.1, 0.2, 0.55, 1.3, 2.9, 4.}) {
    const MotionState exact = state_at(profile, t), stepped = integrated(profile, t);
    EXPECT_NEAR(exact.x, stepped.x, 1e-4) << t;
    EXPECT_NEAR(exact.y, stepped.y, 1e-4) << t;
    EXPECT_NEAR(exact.yaw, stepped.yaw, 1e-4) << t;
    EXPECT_NEAR(exact.speed, stepped.speed, 1e-4) << t;
  }
}

TEST(Motion, braking_ends_at_a_standstill) {
  const MotionProfile profile{0, 0, 0, 0, 10, parse_phases("1 -5 10")};
  const MotionState at_rest = state_at(profile, 10);
  EXPECT_EQ(at_rest.speed, 0);
  EXPECT_EQ(at_rest.yaw_rate, 0);
  EXPECT_EQ(state_at(profile, 20).x, at_rest.x);
  EXPECT_EQ(state_at(profile, 20).yaw, at_rest.yaw);
}

TEST(Motion, a_steady_turn_is_a_circle) {
  const MotionProfile profile{0, 0, 0, 0, 6, {{0, 0, 0.5}}};
  const MotionState half = state_at(profile, M_PI / 0.5);
  EXPECT_NEAR(half.x, 0, 1e-9);
  EXPECT_NEAR(half.y, 24, 1e-9);
  EXPECT_NEAR(half.velocity().x(), -6, 1e-9);
}

TEST(Motion, phases_are_read_by_name_or_as_numbers) {
  EXPECT_TRUE(parse_phases("constant").empty());
  EXPECT_LT(parse_phases("brake").at(0).acceleration, 0);
  const auto phases = parse_phases("0 1 0; 2.5 -3 90");
  ASSERT_EQ(phases.size(), 2U);
  EXPECT_EQ(phases[1].t, 2.5);
  EXPECT_NEAR(phases[1].yaw_rate, M_PI / 2, 1e-12);
  EXPECT_THROW((void)parse_phases("fast"), std::invalid_argument);
  EXPECT_THROW((void)parse_phases("0 1"), std::invalid_argument);
  EXPECT_THROW((void)parse_phases("2 1 0; 1 0 0"), std::invalid_argument);
}

}  // namespace
}  // namespace lidar_upsampling::sim
