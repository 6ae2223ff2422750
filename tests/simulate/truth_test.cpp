// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "simulator/truth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "test_world.h"

namespace lidar_upsampling::sim {
namespace {

std::vector<TrueBox> boxes_in(const World& world) {
  const CameraRenderer renderer(test_camera());
  return true_boxes(world, renderer, renderer.render(world, start_stamp(), 1));
}

TEST(TrueBoxes, a_box_is_tight_about_what_is_seen) {
  World world = empty_world();
  const int id = add_vehicle(world, "car", {15, 1, 0, 0, 0, {}});
  const auto boxes = boxes_in(world);
  ASSERT_EQ(boxes.size(), 1U);
  EXPECT_EQ(boxes[0].object, id);
  EXPECT_EQ(boxes[0].class_name, "car");
  EXPECT_NEAR(boxes[0].hidden, 0, 1e-9);
  // The rear, 2.15 m nearer than the middle, is as wide as the car but for its rounded corners.
  EXPECT_NEAR(boxes[0].box.width(), 700 * 1.8 / (15 - 2.15 - 0.27), 8);
  EXPECT_NEAR(boxes[0].box.bottom, 140 + 700 * 1.65 / (15 - 1.3 - 0.35 - 0.27), 4);
}

TEST(TrueBoxes, what_is_half_hidden_says_so_and_what_is_mostly_hidden_has_none) {
  World world = empty_world();
  const int hidden = add_vehicle(world, "car", {20, 0.3, 0, 0, 0, {}});
  const int front = add_vehicle(world, "car", {12, -0.7, 0, 0, 0, {}});
  const auto both = boxes_in(world);
  EXPECT_EQ(both.size(), 2U);
  for (const TrueBox& box : both) {
    if (box.object == front) {
      EXPECT_NEAR(box.hidden, 0, 1e-9);
    }
    if (box.object == hidden) {
      EXPECT_GT(box.hidden, 0.3);
      EXPECT_LT(box.hidden, 0.8);
    }
  }
  world.objects[front] = make_vehicle("truck", 1);
  world.objects[front].id = front;
  world.objects[front].motion.x = 12;
  const auto boxes = boxes_in(world);
  ASSERT_EQ(boxes.size(), 1U);
  EXPECT_EQ(boxes[0].object, front);
}

TEST(TruthTables, an_object_has_the_centre_of_its_box_and_its_velocity) {
  World world = empty_world();
  add_vehicle(world, "car", {3, 4, M_PI / 2, 0, 5, {{0, 0, 0.2}}});
  std::ostringstream table;
  write_objects_header(table);
  write_objects(table, world, start_stamp());
  std::istringstream lines(table.str());
  std::string header, row;
  std::getline(lines, header);
  std::getline(lines, row);
  EXPECT_EQ(std::count(header.begin(), header.end(), ','), std::count(row.begin(), row.end(), ','));
  const double height = world.objects[1].shape.height;
  std::ostringstream expected;
  expected << start_stamp().time_since_epoch().count() << ",1,car,3.000000,4.000000,";
  EXPECT_EQ(row.substr(0, expected.str().size()), expected.str());
  EXPECT_NEAR(std::stod(row.substr(expected.str().size())), 0.5 * height, 1e-6);
  EXPECT_NE(row.find(",0.000000,5.000000,0.000000,0.200000,1"), std::string::npos) << row;
}

TEST(TruthTables, boxes_are_rows_that_a_detector_could_have_written) {
  World world = empty_world();
  add_vehicle(world, "car", {15, 1, 0, 0, 0, {}});
  const CameraRenderer renderer(test_camera());
  const RenderedImage picture = renderer.render(world, start_stamp(), 1);
  std::ostringstream table;
  write_boxes(table, picture.image, true_boxes(world, renderer, picture));
  EXPECT_EQ(table.str().rfind(
                "CAM0," + std::to_string(start_stamp().time_since_epoch().count()) + ",car,1,", 0),
            0U)
      << table.str();
}

}  // namespace
}  // namespace lidar_upsampling::sim
