// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/ground.h"

#include <gtest/gtest.h>

#include "street_scan.h"

namespace lidar_upsampling {
namespace {

using testing::BoxObject;
using testing::flat;
using testing::kOnGround;
using testing::make_street;
using testing::Street;

struct Shares {
  double ground_found;  ///< of the true ground's points
  double object_kept;   ///< of the boxes' points higher than 0.25 m above the ground
};

Shares compare(const Street& street, const Ground& ground,
               const std::function<double(double, double)>& height) {
  double num_ground = 0;
  double found = 0;
  double num_object = 0;
  double kept = 0;
  for (std::size_t i = 0; i < street.scan.size(); ++i) {
    const Eigen::Vector3f& p = street.scan.points[i];
    if (street.truth[i] == kOnGround) {
      ++num_ground;
      found += ground.is_ground[i];
    } else if (p.z() - height(p.x(), p.y()) > 0.25) {
      ++num_object;
      kept += ground.is_ground[i] == 0 ? 1 : 0;
    }
  }
  return {found / num_ground, kept / num_object};
}

const std::vector<BoxObject> kCars{{{9, 3, -1.6}, 4.2, 1.8, 1.4, 0.1},
                                   {{15, -0.5, -1.6}, 4.4, 1.8, 1.5, 0},
                                   {{-12, 4, -1.6}, 8, 2.5, 3, 0.05},
                                   {{8, -6, -1.7}, 0.5, 0.5, 1.7, 0}};

TEST(Ground, flat_road_is_found_and_the_cars_on_it_are_kept) {
  const Street street = make_street(flat, kCars);
  const Ground ground = estimate_ground(street.scan);
  ASSERT_EQ(ground.status, GroundStatus::found);
  EXPECT_NEAR(ground.plane.d, 1.8, 0.06);
  EXPECT_GT(ground.plane.normal.z(), 0.9995);
  const Shares shares = compare(street, ground, flat);
  EXPECT_GT(shares.ground_found, 0.995);
  EXPECT_GT(shares.object_kept, 0.99);
}

TEST(Ground, is_found_on_a_slope) {
  const auto slope = [](double x, double y) { return -1.8 + 0.1 * x - 0.03 * y; };
  std::vector<BoxObject> cars = kCars;
  for (BoxObject& car : cars) car.center.z() = 0.2 + slope(car.center.x(), car.center.y());
  const Street street = make_street(slope, cars);
  const Ground ground = estimate_ground(street.scan);
  ASSERT_EQ(ground.status, GroundStatus::found);
  const Shares shares = compare(street, ground, slope);
  EXPECT_GT(shares.ground_found, 0.98);
  EXPECT_GT(shares.object_kept, 0.97);
}

TEST(Ground, is_followed_up_a_hill_that_leaves_the_near_plane) {
  const auto hill = [](double x, double /*y*/) {
    return -1.8 + (x > 12 ? 0.002 * (x - 12) * (x - 12) : 0.);  // 1.6 m at 40 m
  };
  std::vector<BoxObject> cars{{{30, 3, hill(30, 3) + 0.15}, 4.2, 1.8, 1.5, 0}};
  const Street street = make_street(hill, cars);
  const Ground ground = estimate_ground(street.scan);
  ASSERT_EQ(ground.status, GroundStatus::found);
  int beyond = 0;
  int followed = 0;
  for (std::size_t i = 0; i < street.scan.size(); ++i) {
    const Eigen::Vector3f& p = street.scan.points[i];
    if (street.truth[i] != kOnGround || p.x() < 25 || p.x() > 40) continue;
    ++beyond;
    followed += ground.is_ground[i];
  }
  ASSERT_GT(beyond, 200);
  EXPECT_GT(followed, 0.9 * beyond);
  EXPECT_GT(compare(street, ground, hill).object_kept, 0.9);
}

TEST(Ground, the_lowest_ring_on_a_car_far_away_is_the_cars) {
  std::vector<BoxObject> cars;
  for (const double x : {36., 41., 47., 53., 58., 66., 70.})  // rings lie up to half a metre apart
    cars.push_back({{x, 6 * std::sin(x), -1.8}, 4.2, 1.8, 1.5, 0});
  const Street street = make_street(flat, cars);
  const Ground ground = estimate_ground(street.scan);
  int of_cars = 0, lost = 0;
  for (std::size_t i = 0; i < street.scan.size(); ++i) {
    if (street.truth[i] == kOnGround) continue;
    ++of_cars;
    lost += ground.is_ground[i];
  }
  ASSERT_GT(of_cars, 100);
  EXPECT_EQ(lost, 0);
  EXPECT_GT(compare(street, ground, flat).ground_found, 0.995);
}

TEST(Ground, is_found_by_sixteen_rings) {
  const Street street = make_street(flat, kCars, 16);
  const Ground ground = estimate_ground(street.scan);
  ASSERT_EQ(ground.status, GroundStatus::found);
  const Shares shares = compare(street, ground, flat);
  EXPECT_GT(shares.ground_found, 0.98);
  EXPECT_GT(shares.object_kept, 0.98);
}

TEST(Ground, echoes_from_below_do_not_pull_it_down) {
  Street street = make_street(flat, kCars);
  for (std::size_t i = 0; i < street.scan.size(); i += 50) street.scan.points[i].z() -= 1.2F;
  const Ground ground = estimate_ground(street.scan);
  ASSERT_EQ(ground.status, GroundStatus::found);
  int kept = 0;
  for (std::size_t i = 1; i < street.scan.size(); i += 50) {
    kept += street.truth[i] == kOnGround && ground.is_ground[i] == 0 ? 1 : 0;
  }
  EXPECT_LT(kept, 0.02 * static_cast<double>(street.scan.size()) / 50);
}

TEST(Ground, a_wall_alone_is_no_ground) {
  LidarScan scan;
  for (int y = -50; y < 50; ++y) {
    for (int z = -20; z < 50; ++z) {
      scan.points.emplace_back(4, 0.05F * static_cast<float>(y), 0.05F * static_cast<float>(z));
    }
  }
  const Ground ground = estimate_ground(scan);
  EXPECT_EQ(ground.status, GroundStatus::none);
  EXPECT_TRUE(ground.is_ground.empty());
}

TEST(Ground, an_empty_scan_has_none) {
  EXPECT_EQ(estimate_ground(LidarScan{}).status, GroundStatus::none);
}

TEST(Ground, a_cell_of_no_size_is_refused) {
  GroundOptions options;
  options.cell_size = 0;
  EXPECT_THROW(static_cast<void>(estimate_ground(LidarScan{}, options)), std::invalid_argument);
}

}  // namespace
}  // namespace lidar_upsampling
