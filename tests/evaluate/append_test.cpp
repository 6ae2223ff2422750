// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <gtest/gtest.h>

#include "evaluation.h"

namespace lidar_upsampling {
namespace {

LogResult log_named(const std::string& reference, int num_virtual) {
  LogResult log;
  log.reference = reference;
  log.input = "dense.rawlog";
  log.num_virtual = num_virtual;
  log.notes = {"seen"};
  ScanResult scan;
  scan.objects.resize(1);
  scan.objects[0].object.id = "1";
  log.scans.add(scan);
  return log;
}

std::vector<std::string> first_ids(const LogResult& log) {
  std::vector<std::string> ids;
  log.scans.for_each([&](const ScanResult& scan) { ids.push_back(scan.objects[0].object.id); });
  return ids;
}

TEST(Append, one_log_stays_as_it_is) {
  LogResult total;
  append(total, log_named("in/04.rawlog", 3));
  EXPECT_EQ(first_ids(total), std::vector<std::string>{"1"});
  EXPECT_EQ(total.num_logs, 1);
}

TEST(Append, objects_of_several_logs_are_told_apart_by_their_logs_names) {
  LogResult total;
  append(total, log_named("in/04.rawlog", 3));
  append(total, log_named("in/47.rawlog", 4));
  append(total, log_named("in/56.rawlog", 5));
  EXPECT_EQ(total.scans.size(), 3U);
  EXPECT_EQ(first_ids(total), (std::vector<std::string>{"04/1", "47/1", "56/1"}));
  EXPECT_EQ(total.num_virtual, 12);
  EXPECT_EQ(total.num_logs, 3);
  EXPECT_EQ(total.notes.back(), "dense.rawlog: seen");
}

TEST(Append, logs_that_labels_alone_judge_count_together) {
  LogResult total;
  for (const std::string name : {"a.rawlog", "b.rawlog"}) {
    LogResult log;
    log.input = name;
    log.labels[Row::ours].emplace().num_images = 20;
    append(total, std::move(log));
  }
  EXPECT_EQ(total.num_logs, 2);
  EXPECT_EQ(total.labels[Row::ours]->num_images, 40);
}

}  // namespace
}  // namespace lidar_upsampling
