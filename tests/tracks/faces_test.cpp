// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/tracks/faces.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lidar_upsampling {
namespace {

const Eigen::Vector2d kAhead(1, 0), kAside(0, 1);

// The rear of a car 20 m ahead, by so many rings.
Faces rear_by_rings(int rings) {
  std::vector<Eigen::Vector3f> points;
  for (int ring = 0; ring < rings; ++ring)
    for (float y = -0.8F; y <= 0.8F; y += 0.1F) points.emplace_back(20, y, -0.3F * ring);
  return Faces(Surface(points));
}

TEST(Faces, are_known_by_their_normals) {
  const Faces rear = rear_by_rings(5);
  EXPECT_EQ(rear.share_across(kAhead), 1);
  EXPECT_EQ(rear.share_across(kAside), 0);
}

TEST(Faces, that_one_ring_alone_shows_are_known_from_above) {
  const Faces rear = rear_by_rings(1);
  EXPECT_EQ(rear.share_across(kAhead), 1);
  EXPECT_EQ(rear.share_across(kAside), 0);
}

TEST(Faces, that_one_column_of_beams_alone_shows_may_look_anywhere) {
  std::vector<Eigen::Vector3f> column;
  for (int ring = 0; ring < 12; ++ring)
    column.emplace_back(60 + 0.02F * static_cast<float>(ring % 3), 17, 0.3F * ring);
  const Faces wall{Surface(column)};
  EXPECT_EQ(wall.share_across(kAhead), 0);
  EXPECT_EQ(wall.share_across(kAside), 0);
}

TEST(Faces, of_a_bush_are_none) {
  std::vector<Eigen::Vector3f> bush;
  for (int i = 0; i < 300; ++i)  // in a ball, evenly enough
    bush.emplace_back(8 + 0.5F * std::sin(1.7F * i) * std::cos(0.3F * i), 0.5F * std::sin(2.9F * i),
                      0.5F * std::cos(1.1F * i));
  EXPECT_LT(Faces(Surface(bush)).share_across(kAhead), 0.4);
}

}  // namespace
}  // namespace lidar_upsampling
