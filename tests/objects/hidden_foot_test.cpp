// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/road_users.h"

#include <gtest/gtest.h>

#include "street_scan.h"

namespace lidar_upsampling {
namespace {

using testing::BoxObject;
using testing::Street;

// Of the box with index 0.
bool foot_of_first_is_hidden(const std::vector<BoxObject>& boxes) {
  const Street street = testing::make_street([](double, double) { return -1.8; }, boxes);
  const Ground ground = estimate_ground(street.scan);
  std::vector<int> cluster;
  for (std::size_t i = 0; i < street.truth.size(); ++i)
    if (street.truth[i] == 0 && street.scan.points[i].z() > -0.6F)
      cluster.push_back(static_cast<int>(i));
  EXPECT_GT(cluster.size(), 20U);
  return foot_is_hidden(street.scan, ground, cluster);
}

const BoxObject kTruck{{22, 0, -1.8}, 6, 2.3, 2, 0};
const BoxObject kCarBeforeIt{{13, 0, -1.8}, 4, 2.4, 1.2, 0};
const BoxObject kSign{{22, 0, -0.6}, 0.3, 2.3, 0.8, 0};

TEST(HiddenFoot, a_truck_behind_a_car_may_stand_on_the_ground) {
  EXPECT_TRUE(foot_of_first_is_hidden({kTruck, kCarBeforeIt}));
}

TEST(HiddenFoot, a_sign_does_not_for_the_road_is_seen_beneath_it) {
  EXPECT_FALSE(foot_of_first_is_hidden({kSign}));
}

}  // namespace
}  // namespace lidar_upsampling
