// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "simulator/variation.h"

#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>

#include <cmath>

#include "simulator/footprint.h"
#include "simulator/world.h"

namespace lidar_upsampling::sim {
namespace {

const std::string kTown =
    "[ego]\ny_m = -5.1\nspeed_mps = 8\n"
    "[vehicle.a]\nx_m = 20\ny_m = -5.1\nspeed_mps = 9\nmotion = 1 -2 10\ncolor = 0.5 0 0\n"
    "[vehicle.b]\nx_m = 40\ny_m = 1.7\nyaw_deg = 180\nspeed_mps = 10\ncolor = 0 0 0.5\n"
    "[vehicle.parked]\nx_m = 60\ny_m = -5.1\ncolor = 0 0.5 0\n";

Scenario town(const std::string& more = "") {
  return scenario_from_config(mrpt::config::CConfigFileMemory(kTown + more));
}

TEST(Variation, another_seed_draws_other_speeds_places_and_colours) {
  const Scenario written = town(), one = drawn(written, 1), two = drawn(written, 2);
  EXPECT_NE(one.ego.motion.speed, two.ego.motion.speed);
  for (const std::size_t i : {0U, 1U}) {
    EXPECT_NE(one.vehicles[i].motion.speed, two.vehicles[i].motion.speed);
    EXPECT_NE(one.vehicles[i].motion.x, two.vehicles[i].motion.x);
    EXPECT_NE(one.vehicles[i].motion.y, two.vehicles[i].motion.y);
    EXPECT_NE(one.vehicles[i].color.value(), two.vehicles[i].color.value());
    EXPECT_NE(one.vehicles[i].color.value(), written.vehicles[i].color.value());
  }
  EXPECT_NE(one.appearance.sun, two.appearance.sun);
  EXPECT_NE(one.lidar.noise_m, two.lidar.noise_m);
  EXPECT_NE(one.cameras[0].noise, two.cameras[0].noise);
  EXPECT_NE(one.street.trees, two.street.trees);
}

TEST(Variation, the_same_seed_gives_the_same_situation) {
  const World a = build_world(drawn(town(), 7)), b = build_world(drawn(town(), 7));
  ASSERT_EQ(a.objects.size(), b.objects.size());
  for (std::size_t i = 0; i < a.objects.size(); ++i) {
    EXPECT_EQ(a.T_world_object(a.objects[i].id, 1).matrix(),
              b.T_world_object(b.objects[i].id, 1).matrix());
    EXPECT_EQ(a.objects[i].parts[0].color, b.objects[i].parts[0].color);
  }
}

TEST(Variation, nothing_is_drawn_further_than_the_scenario_lets) {
  const Scenario written = town("[variation]\nspeed_share = 0.05\nplace_m = 0.5\nacross_m = 0.1\n");
  for (std::uint32_t seed = 1; seed < 30; ++seed) {
    const Scenario scenario = drawn(written, seed);
    ASSERT_EQ(scenario.vehicles.size(), written.vehicles.size());
    for (std::size_t i = 0; i < written.vehicles.size(); ++i) {
      const MotionProfile &is = scenario.vehicles[i].motion, &was = written.vehicles[i].motion;
      EXPECT_LE(std::abs(is.speed - was.speed), 0.05 * was.speed + 1e-9);
      EXPECT_LE(std::abs(is.x - was.x), 0.5 + 1e-9);
      EXPECT_LE(std::abs(is.y - was.y), 0.1 + 1e-9);
    }
    EXPECT_LE(std::abs(scenario.cameras[0].noise / written.cameras[0].noise - 1), 0.3 + 1e-9);
    EXPECT_LE(std::abs(scenario.ego.motion.speed / written.ego.motion.speed - 1), 0.1 + 1e-9);
  }
}

TEST(Variation, a_scenario_that_forbids_it_all_keeps_its_traffic) {
  const Scenario written = town(
      "[variation]\nspeed_share = 0\nego_speed_share = 0\nplace_m = 0\nacross_m = 0\n"
      "type_share = 0\nlight_share = 0\nnoise_share = 0\nstreet_share = 0\ncolors = false\n");
  const Scenario scenario = drawn(written, 5);
  for (std::size_t i = 0; i < written.vehicles.size(); ++i) {
    EXPECT_EQ(state_at(scenario.vehicles[i].motion, 2).pose().matrix(),
              state_at(written.vehicles[i].motion, 2).pose().matrix());
    EXPECT_EQ(scenario.vehicles[i].color.value(), written.vehicles[i].color.value());
    EXPECT_EQ(scenario.vehicles[i].type, written.vehicles[i].type);
  }
  EXPECT_EQ(scenario.appearance.sun, 1);
  EXPECT_EQ(scenario.lidar.noise_m, written.lidar.noise_m);
}

TEST(Variation, what_stands_stays_standing_and_a_faster_one_goes_the_same_way) {
  const Scenario written = town(
      "[variation]\nplace_m = 0\nacross_m = 0\nspeed_share = 0.3\n"
      "[static]\nparked_cars = 0\n");
  const Scenario scenario = drawn(written, 3);
  EXPECT_EQ(scenario.vehicles[2].motion.speed, 0);
  const MotionProfile &is = scenario.vehicles[0].motion, &was = written.vehicles[0].motion;
  const double faster = is.speed / was.speed;
  EXPECT_GT(std::abs(faster - 1), 0.01);
  for (const double t : {0.5, 1.4, 2.5}) {
    const MotionState early = state_at(is, t / faster), late = state_at(was, t);
    EXPECT_NEAR(early.x, late.x, 1e-9);
    EXPECT_NEAR(early.y, late.y, 1e-9);
    EXPECT_NEAR(early.yaw, late.yaw, 1e-9);
  }
}

TEST(Variation, a_queue_bumper_to_bumper_is_drawn_without_a_collision) {
  std::string queue = "[ego]\ny_m = -5.1\nspeed_mps = 10\n[variation]\nplace_m = 3\n";
  for (int i = 1; i < 6; ++i) {
    queue += "[vehicle." + std::to_string(i) +
             "]\ny_m = -5.1\nspeed_mps = 10\nx_m = " + std::to_string(5.6 * i) + "\n";
  }
  const Scenario written = scenario_from_config(mrpt::config::CConfigFileMemory(queue));
  for (std::uint32_t seed = 1; seed < 20; ++seed) {
    const Scenario scenario = drawn(written, seed);
    std::vector<Footprint> all{ego_footprint(scenario.ego)};
    const World world = build_world(scenario);
    const std::size_t first = world.objects.size() - scenario.vehicles.size();
    for (std::size_t i = first; i < world.objects.size(); ++i) {
      all.push_back(footprint_of(world.objects[i]));
    }
    for (std::size_t a = 0; a < all.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        EXPECT_FALSE(ever_touch(all[a], all[b], scenario.duration_s, 0)) << seed;
      }
    }
  }
}

TEST(Variation, who_parks_where_the_traffic_passes_is_not_there) {
  const Scenario written = town("[vehicle.on_the_kerb]\nx_m = 30\ny_m = -7.8\nspeed_mps = 8\n");
  const Scenario scenario = drawn(written, 2);
  const World world = build_world(scenario);
  const Footprint way = footprint_of(world.objects.back());
  for (const Object& object : world.objects) {
    if (object.class_name.empty() || object.id == world.objects.back().id) continue;
    EXPECT_FALSE(ever_touch(way, footprint_of(object), scenario.duration_s, 0));
  }
}

TEST(Footprint, rectangles_touch_at_their_corners_only_when_they_really_do) {
  const Footprint still{4, 2, {0, 0, 0, 0, 0, {}}};
  // A corner at 2.12 m of its middle points at the other one's side.
  EXPECT_FALSE(ever_touch(still, {3, 3, {0, 3.2, M_PI / 4, 0, 0, {}}}, 0, 0));
  EXPECT_TRUE(ever_touch(still, {3, 3, {0, 3.1, M_PI / 4, 0, 0, {}}}, 0, 0));
  EXPECT_TRUE(ever_touch(still, {3, 3, {0, 3.2, M_PI / 4, 0, 0, {}}}, 0, 0.1));
  // One that comes by.
  EXPECT_TRUE(ever_touch(still, {4, 2, {-20, 0, 0, 0, 10, {}}}, 2, 0));
  EXPECT_FALSE(ever_touch(still, {4, 2, {-20, 0, 0, 0, 10, {}}}, 1, 0));
}

}  // namespace
}  // namespace lidar_upsampling::sim
