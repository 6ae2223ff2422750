// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "plugin/work_queue.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

#include "plugin/observed.h"

namespace lidar_upsampling {
namespace {

using Names = std::vector<std::string>;

// Empties a closed queue; late ones are marked with a star.
Names names_in(WorkQueue& queue) {
  queue.close();
  Names names;
  while (const auto next = queue.pop())
    names.push_back(name_of(*next->observation) + (next->is_late ? " *" : ""));
  return names;
}

QueueOptions at_most(std::size_t max_waiting) {
  QueueOptions options;
  options.max_waiting = max_waiting;
  return options;
}

TEST(WorkQueue, the_oldest_waiting_image_is_late_when_too_many_wait) {
  WorkQueue queue(at_most(2));
  for (const int ms : {0, 33, 67, 100}) queue.push(arrived("CAM0", ms, Role::image));
  EXPECT_EQ(names_in(queue), (Names{"CAM0 0 *", "CAM0 33 *", "CAM0 67", "CAM0 100"}));
}

TEST(WorkQueue, as_many_images_as_may_wait_are_none_too_many) {
  WorkQueue queue(at_most(2));
  for (const int ms : {0, 33}) queue.push(arrived("CAM0", ms, Role::image));
  EXPECT_EQ(names_in(queue), (Names{"CAM0 0", "CAM0 33"}));
}

TEST(WorkQueue, every_camera_and_the_lidar_have_their_own_share) {
  WorkQueue queue(at_most(1));
  queue.push(arrived("LIDAR", 0, Role::scan));
  for (const char* camera : {"CAM0", "CAM1"}) queue.push(arrived(camera, 1, Role::image));
  queue.push(arrived("LIDAR", 100, Role::scan));
  EXPECT_EQ(names_in(queue), (Names{"LIDAR 0 *", "CAM0 1", "CAM1 1", "LIDAR 100"}));
}

TEST(WorkQueue, what_is_no_work_is_never_late) {
  WorkQueue queue(at_most(1));
  for (const int ms : {0, 10, 20}) queue.push(arrived("POSE", ms, Role::other));
  EXPECT_EQ(names_in(queue), (Names{"POSE 0", "POSE 10", "POSE 20"}));
}

TEST(WorkQueue, observations_come_out_by_their_stamps_and_equal_ones_as_they_came) {
  WorkQueue queue(at_most(9));
  queue.push(arrived("CAM0", 50, Role::image));
  queue.push(arrived("LIDAR", 0, Role::scan));
  queue.push(arrived("POSE", 50, Role::other));
  queue.push(arrived("CAM1", 50, Role::image));
  EXPECT_EQ(names_in(queue), (Names{"LIDAR 0", "CAM0 50", "POSE 50", "CAM1 50"}));
}

TEST(WorkQueue, between_sources_the_scan_of_an_instant_precedes_its_image_and_follows_its_pose) {
  QueueOptions options = at_most(9);
  options.merge_window = std::chrono::milliseconds(1);
  WorkQueue queue(options);
  queue.push(arrived("CAM0", 0, Role::image));
  queue.push(arrived("LIDAR", 0, Role::scan));
  queue.push(arrived("POSE", 0, Role::other));
  EXPECT_EQ(names_in(queue), (Names{"POSE 0", "LIDAR 0", "CAM0 0"}));
}

TEST(WorkQueue, an_observation_is_held_back_for_an_earlier_one_that_arrives_within_the_window) {
  QueueOptions options = at_most(9);
  options.merge_window = std::chrono::hours(1);
  WorkQueue queue(options);
  Arrived long_ago = arrived("CAM0", 50, Role::image);
  long_ago.time -= std::chrono::hours(2);
  queue.push(arrived("LIDAR", 20, Role::scan));
  queue.push(std::move(long_ago));
  queue.push(arrived("POSE", 80, Role::other));
  // The image's time is over, and the scan must not come behind it; the pose's is not.
  EXPECT_EQ(name_of(*queue.pop()->observation), "LIDAR 20");
  EXPECT_EQ(name_of(*queue.pop()->observation), "CAM0 50");
  std::atomic<bool> is_out{false};
  std::thread waiting([&] {
    static_cast<void>(queue.pop());
    is_out = true;
  });
  EXPECT_FALSE(is_out);
  queue.close();
  waiting.join();
  EXPECT_TRUE(is_out);
}

TEST(WorkQueue, what_is_held_back_for_others_does_not_count_as_waiting_for_work) {
  QueueOptions options = at_most(1);
  options.merge_window = std::chrono::hours(1);
  WorkQueue queue(options);
  for (const int ms : {0, 33, 67}) queue.push(arrived("CAM0", ms, Role::image));
  EXPECT_EQ(names_in(queue), (Names{"CAM0 0", "CAM0 33", "CAM0 67"}));
}

TEST(WorkQueue, a_source_that_waits_for_room_makes_nothing_late) {
  WorkQueue queue(at_most(1));
  Names names;
  std::thread source([&] {
    for (const int ms : {0, 33, 67, 100}) {
      queue.wait_for_room();
      queue.push(arrived("CAM0", ms, Role::image));
    }
    queue.close();
  });
  while (const auto next = queue.pop())
    names.push_back(name_of(*next->observation) + (next->is_late ? " *" : ""));
  source.join();
  EXPECT_EQ(names, (Names{"CAM0 0", "CAM0 33", "CAM0 67", "CAM0 100"}));
}

TEST(WorkQueue, whoever_waits_goes_on_when_it_is_abandoned) {
  WorkQueue queue(at_most(1)), empty(at_most(1));
  queue.push(arrived("CAM0", 0, Role::image));
  std::thread source([&] { queue.wait_for_room(); });
  std::thread worker([&] { EXPECT_FALSE(empty.pop()); });
  queue.abandon();
  empty.abandon();
  source.join();
  worker.join();
}

}  // namespace
}  // namespace lidar_upsampling
