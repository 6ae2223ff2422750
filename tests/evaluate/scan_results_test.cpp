// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <gtest/gtest.h>

#include "evaluation.h"
#include "io/test_folder.h"

namespace lidar_upsampling {
namespace {

constexpr int kNumScans = 2000;  // of more than one block

ObjectResult object_numbered(int number) {
  ObjectResult result;
  result.object.id = std::to_string(number);
  result.object.class_name = std::string(static_cast<std::size_t>(number % 50), 'c');
  result.object.points.resize(20);
  result.num_points = 20;
  result.object.motion.centroid_k = {1. * number, 2, 3};
  result.object.motion.T_lidar_t_lidar_k.translation() << 4, 5, number;
  result.object.moving = number % 2 == 0;
  if (number % 5 == 0) result.object.excluded = "ambiguous";
  if (number % 3 != 0)
    result.estimates[Row::ours].emplace(Eigen::Translation3d(0, 0.1 * number, 0));
  result.errors[Row::ours] = ObjectError{0.1 * number, 2, 3, {}};
  result.errors[Row::ego] = ObjectError{1, 2, 3, 0.01 * number};
  return result;
}

ScanResult scan_numbered(int number) {
  ScanResult scan;
  scan.stamp = Stamp(Stamp::duration(2000 + number));
  scan.key_stamp = Stamp(Stamp::duration(1000 + number));
  scan.dt = 1. / (1 + number);
  scan.points_told = number % 2 == 0;
  for (int i = 0; i < number % 4; ++i) scan.objects.push_back(object_numbered(10 * number + i));
  if (number % 2 == 0) scan.clouds[Row::ours] = CloudResult{{1, 2, 3, 1. * number}, {}};
  if (number % 3 == 0) scan.flow[Row::hold] = ThreeWayEpe{{}, 1. * number, {}};
  if (number % 7 == 0) scan.sampled[Row::paper].inliers.resize(5);
  scan.moving_points_m[Row::oracle] = number;
  return scan;
}

void expect_same(const ObjectResult& object, const ObjectResult& expected) {
  EXPECT_EQ(object.object.id, expected.object.id);
  EXPECT_EQ(object.object.class_name, expected.object.class_name);
  EXPECT_EQ(object.object.excluded, expected.object.excluded);
  EXPECT_EQ(object.object.moving, expected.object.moving);
  EXPECT_EQ(object.object.motion.centroid_k, expected.object.motion.centroid_k);
  EXPECT_EQ(object.object.motion.T_lidar_t_lidar_k.matrix(),
            expected.object.motion.T_lidar_t_lidar_k.matrix());
  EXPECT_EQ(object.num_points, expected.num_points);
  ASSERT_EQ(object.estimates[Row::ours].has_value(), expected.estimates[Row::ours].has_value());
  if (object.estimates[Row::ours]) {
    EXPECT_EQ(object.estimates[Row::ours]->matrix(), expected.estimates[Row::ours]->matrix());
  }
  EXPECT_EQ(object.errors[Row::ours]->position_m, expected.errors[Row::ours]->position_m);
  EXPECT_EQ(object.errors[Row::ego]->depth_share, expected.errors[Row::ego]->depth_share);
  EXPECT_FALSE(object.errors[Row::hold]);
}

TEST(ScanResults, come_back_as_they_were_and_in_their_order_each_time) {
  const TestFolder folder;
  ScanResults scans(folder / "page.html");
  for (int i = 0; i < kNumScans; ++i) scans.add(scan_numbered(i));
  EXPECT_EQ(scans.size(), std::size_t{kNumScans});
  EXPECT_EQ(scans.first_key_stamp(), scan_numbered(0).key_stamp);
  for (const char* time : {"first", "second"}) {
    int number = 0;
    scans.for_each([&](const ScanResult& scan) {
      const ScanResult expected = scan_numbered(number++);
      ASSERT_EQ(scan.objects.size(), expected.objects.size()) << time;
      for (std::size_t i = 0; i < scan.objects.size(); ++i)
        expect_same(scan.objects[i], expected.objects[i]);
      EXPECT_EQ(scan.stamp, expected.stamp);
      EXPECT_EQ(scan.dt, expected.dt);
      EXPECT_EQ(scan.points_told, expected.points_told);
      EXPECT_EQ(scan.clouds[Row::ours].has_value(), expected.clouds[Row::ours].has_value());
      EXPECT_EQ(scan.flow[Row::hold].has_value(), expected.flow[Row::hold].has_value());
      EXPECT_EQ(scan.sampled[Row::paper].inliers.size(),
                expected.sampled[Row::paper].inliers.size());
      EXPECT_EQ(scan.moving_points_m[Row::oracle], expected.moving_points_m[Row::oracle]);
    });
    EXPECT_EQ(number, kNumScans) << time;
  }
}

TEST(ScanResults, leave_nothing_beside_what_is_written) {
  const TestFolder folder;
  {
    ScanResults scans(folder / "page.html");
    for (int i = 0; i < kNumScans; ++i) scans.add(scan_numbered(i));
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace lidar_upsampling
