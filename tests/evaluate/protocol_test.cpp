// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "protocol.h"

#include <gtest/gtest.h>

namespace lidar_upsampling {
namespace {

TEST(Protocol, each_name_finds_a_protocol_with_published_figures_for_every_column) {
  ASSERT_EQ(protocol_names().size(), 5U);
  for (const std::string& name : protocol_names()) {
    const Protocol protocol = find_protocol(name);
    EXPECT_EQ(protocol.name, name);
    ASSERT_FALSE(protocol.published.empty());
    for (const Published& row : protocol.published)
      EXPECT_EQ(row.figures.size(), protocol.columns.size()) << name << ", " << row.method;
  }
}

TEST(Protocol, an_unknown_name_is_answered_with_those_there_are) {
  try {
    (void)find_protocol("kitti");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("kitti-raw-trajectories"), std::string::npos);
  }
}

TEST(Protocol, people_and_bicycles_are_no_vehicles) {
  EXPECT_TRUE(is_vehicle("Car"));
  EXPECT_TRUE(is_vehicle("VEHICLE"));
  EXPECT_TRUE(is_vehicle("cluster"));
  EXPECT_FALSE(is_vehicle("Pedestrian"));
  EXPECT_FALSE(is_vehicle("BICYCLIST"));
}

}  // namespace
}  // namespace lidar_upsampling
