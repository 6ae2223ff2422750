// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/sightings.h"

#include <gtest/gtest.h>

#include <numeric>

namespace lidar_upsampling {
namespace {

using Cloud = std::vector<Eigen::Vector3f>;

constexpr double kRingStep_deg = 0.4;

// Something upright, 0.5 m wide, 10 m ahead.
Cloud upright(float y) {
  Cloud points;
  for (float z = -1; z < 0.5F; z += 0.1F)
    for (float across = -0.2F; across < 0.25F; across += 0.1F)
      points.emplace_back(10, y + across, z);
  return points;
}

Cloud both_of(Cloud a, const Cloud& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::vector<int> first_indices(std::size_t count) {
  std::vector<int> indices(count);
  std::iota(indices.begin(), indices.end(), 0);
  return indices;
}

/// A key scan of a post, with someone beside it who is said to walk off to the right.
class Walker {
 public:
  Walker() {
    scan_.points = both_of(post_, walker_);
    seen_ = std::make_unique<const SeenSpace>(scan_.points, kRingStep_deg);
    KnownMotion motion;
    motion.velocity_at_rest = {0, -1.5, 0};
    expected_.push_back({"person", walker_, motion, 0.05, false});
    next_is_of(both_of(post_, upright(-0.15F)));
    camera_.width = 1200;
    camera_.height = 400;
    camera_.fx = camera_.fy = 700;
    camera_.cx = 600;
    camera_.cy = 200;
    T_camera_lidar_.linear() << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  }

  void next_is_of(const Cloud& points) {
    next_ = std::make_unique<NextScan>(NextScan{shifted(Stamp{}, 0.1), Surface(points),
                                                Pose::Identity(), SeenSpace(points, kRingStep_deg),
                                                nullptr, kRingStep_deg});
  }
  void is_shown() { expected_[0].is_shown = true; }
  void camera_looks_back() { T_camera_lidar_.linear() << 0, 1, 0, 0, 0, -1, -1, 0, 0; }

  /// @param sighted number of points that were taken for one object; 0: none was.
  [[nodiscard]] std::vector<Sighting> find(std::size_t sighted) const {
    std::vector<Sighting> sightings;
    if (sighted > 0) sightings.push_back({{}, first_indices(sighted), {}});
    find_expected(sightings,
                  {scan_, segments_, *seen_, Pose::Identity(), nullptr, {}, next_.get(), expected_},
                  camera_, T_camera_lidar_);
    return sightings;
  }

  [[nodiscard]] std::size_t num_post() const { return post_.size(); }
  [[nodiscard]] std::size_t num_all() const { return scan_.size(); }

 private:
  Cloud post_ = upright(0.8F), walker_ = upright(0);
  LidarScan scan_;
  SceneSegments segments_;
  std::unique_ptr<const SeenSpace> seen_;
  std::unique_ptr<NextScan> next_;
  std::vector<ExpectedMover> expected_;
  CameraModel camera_;
  Pose T_camera_lidar_ = Pose::Identity();
};

TEST(FindExpected, a_mover_is_parted_from_what_stays_behind) {
  const Walker walker;
  const auto sightings = walker.find(walker.num_all());
  ASSERT_EQ(sightings.size(), 2U);
  EXPECT_EQ(sightings[0].points.size(), walker.num_post());
  EXPECT_FALSE(sightings[0].foreseen);
  EXPECT_EQ(sightings[1].points.size(), walker.num_all() - walker.num_post());
  ASSERT_TRUE(sightings[1].foreseen);
  EXPECT_EQ(sightings[1].foreseen->velocity_at_rest.y(), -1.5);
  EXPECT_EQ(sightings[1].detection.class_name, "person");
  EXPECT_GT(sightings[1].detection.box.width(), 20);
}

TEST(FindExpected, where_nothing_stays_behind_all_of_it_is_the_mover) {
  Walker walker;
  walker.next_is_of(both_of(upright(0.3F), upright(-0.5F)));
  const auto sightings = walker.find(walker.num_all());
  ASSERT_EQ(sightings.size(), 1U);
  EXPECT_EQ(sightings[0].points.size(), walker.num_all());
  EXPECT_TRUE(sightings[0].foreseen);
}

TEST(FindExpected, who_was_no_sighting_becomes_one) {
  const Walker walker;
  EXPECT_EQ(walker.find(0).size(), 1U);
  EXPECT_EQ(walker.find(walker.num_post()).size(), 2U);
}

TEST(FindExpected, whom_the_picture_does_not_show_is_none_of_this_cameras) {
  Walker walker;
  walker.camera_looks_back();
  EXPECT_TRUE(walker.find(0).empty());
}

TEST(FindExpected, who_has_been_seen_to_move_is_left_as_it_is_sighted) {
  Walker walker;
  walker.is_shown();
  EXPECT_TRUE(walker.find(0).empty());
  const auto sightings = walker.find(walker.num_all());
  ASSERT_EQ(sightings.size(), 1U);
  EXPECT_EQ(sightings[0].points.size(), walker.num_all());
}

}  // namespace
}  // namespace lidar_upsampling
