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

// Empties a closed queue; hurried ones are marked with a plus, late ones with a star.
Names names_in(WorkQueue& queue) {
  queue.close();
  Names names;
  while (const auto next = queue.pop())
    names.push_back(name_of(*next->observation) +
                    (next->is_late ? " *" : (next->is_hurried ? " +" : "")));
  return names;
}

QueueOptions within_hours(double hurry_after, double give_up_after) {
  QueueOptions options;
  options.hurry_after = std::chrono::duration<double, std::ratio<3600>>(hurry_after);
  options.give_up_after = std::chrono::duration<double, std::ratio<3600>>(give_up_after);
  return options;
}

Arrived hours_ago(int hours, Arrived arrived) {
  arrived.time -= std::chrono::hours(hours);
  return arrived;
}

TEST(WorkQueue, what_has_waited_too_long_for_the_work_is_hurried_and_then_late) {
  WorkQueue queue(within_hours(1.5, 3.5));
  queue.push(hours_ago(4, arrived("LIDAR", 0, Role::scan)));
  queue.push(hours_ago(4, arrived("CAM0", 0, Role::image)));
  for (const int hours : {3, 2, 1})
    queue.push(hours_ago(hours, arrived("CAM0", 100 - hours, Role::image)));
  queue.push(hours_ago(1, arrived("LIDAR", 100, Role::scan)));
  EXPECT_EQ(names_in(queue),
            (Names{"LIDAR 0 *", "CAM0 0 *", "CAM0 97 +", "CAM0 98 +", "CAM0 99", "LIDAR 100"}));
}

TEST(WorkQueue, however_many_wait_none_is_late_before_its_time) {
  WorkQueue queue(within_hours(1, 2));
  for (int ms = 0; ms < 100; ++ms) queue.push(arrived("CAM0", ms, Role::image));
  for (const std::string& name : names_in(queue)) EXPECT_EQ(name.find_first_of("+*"), name.npos);
}

TEST(WorkQueue, what_is_no_work_is_never_late) {
  WorkQueue queue(within_hours(1, 2));
  queue.push(hours_ago(3, arrived("POSE", 0, Role::other)));
  EXPECT_EQ(names_in(queue), (Names{"POSE 0"}));
}

TEST(WorkQueue, observations_come_out_by_their_stamps_and_equal_ones_as_they_came) {
  WorkQueue queue({});
  queue.push(arrived("CAM0", 50, Role::image));
  queue.push(arrived("LIDAR", 0, Role::scan));
  queue.push(arrived("POSE", 50, Role::other));
  queue.push(arrived("CAM1", 50, Role::image));
  EXPECT_EQ(names_in(queue), (Names{"LIDAR 0", "CAM0 50", "POSE 50", "CAM1 50"}));
}

TEST(WorkQueue, between_sources_the_scan_of_an_instant_precedes_its_image_and_follows_its_pose) {
  QueueOptions options;
  options.merge_window = std::chrono::milliseconds(1);
  WorkQueue queue(options);
  queue.push(arrived("CAM0", 0, Role::image));
  queue.push(arrived("LIDAR", 0, Role::scan));
  queue.push(arrived("POSE", 0, Role::other));
  EXPECT_EQ(names_in(queue), (Names{"POSE 0", "LIDAR 0", "CAM0 0"}));
}

TEST(WorkQueue, an_observation_is_held_back_for_an_earlier_one_that_arrives_within_the_window) {
  QueueOptions options;
  options.merge_window = std::chrono::hours(1);
  WorkQueue queue(options);
  queue.push(arrived("LIDAR", 20, Role::scan));
  queue.push(hours_ago(2, arrived("CAM0", 50, Role::image)));
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

TEST(WorkQueue, what_is_held_back_for_others_does_not_wait_for_work_meanwhile) {
  QueueOptions options = within_hours(1, 2);
  options.merge_window = std::chrono::hours(3);
  WorkQueue queue(options);
  queue.push(hours_ago(2, arrived("CAM0", 0, Role::image)));
  queue.push(hours_ago(6, arrived("CAM0", 33, Role::image)));
  EXPECT_EQ(names_in(queue), (Names{"CAM0 0", "CAM0 33 *"}));
}

TEST(WorkQueue, a_source_that_waits_for_room_goes_on_when_all_is_worked_on) {
  WorkQueue queue({});
  std::atomic<int> num_pushed{0};
  std::thread source([&] {
    for (const int ms : {0, 33, 67, 100}) {
      queue.wait_for_room();
      ++num_pushed;
      queue.push(arrived("CAM0", ms, Role::image));
    }
    queue.close();
  });
  int num_taken = 0;
  for (; queue.pop(); ++num_taken) EXPECT_LE(num_pushed, num_taken + 2);
  source.join();
  EXPECT_EQ(num_taken, 4);
}

TEST(WorkQueue, whoever_waits_goes_on_when_it_is_abandoned) {
  WorkQueue queue({}), empty({});
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
