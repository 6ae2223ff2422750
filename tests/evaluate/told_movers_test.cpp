// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "told_movers.h"

#include <gtest/gtest.h>

namespace lidar_upsampling {
namespace {

// A car drives and another one is parked; the report tells of one object at one image.
ToldMovers told_of(const Eigen::Vector3d& place, const std::string& status,
                   std::int64_t stamp = 7) {
  LogResult log;
  ScanResult scan;
  scan.stamp = Stamp(Stamp::duration(7));
  ObjectResult driving, parked;
  driving.object.moving = true;
  driving.object.motion.centroid_k = {20, 0, 0};
  parked.object.motion.centroid_k = {20, 15, 0};
  scan.objects = {driving, parked};
  log.scans.push_back(scan);
  RunReport report;
  ReportedObject row;
  row.stamp = stamp;
  row.status = status;
  row.position = place;
  report.objects.push_back(row);
  return told_movers(log, report, 40);
}

TEST(ToldMovers, a_piece_of_what_moves_is_near_it) {
  EXPECT_EQ(told_of({23, 1, 0}, "moving").near, 1);
  EXPECT_EQ(told_of({23, 1, 0}, "predicted").near, 1);
}

TEST(ToldMovers, what_is_told_to_move_where_nothing_does_is_elsewhere) {
  EXPECT_EQ(told_of({20, 15, 0}, "moving").elsewhere, 1);
  EXPECT_EQ(told_of({20, 15, 0}, "moving").near, 0);
}

TEST(ToldMovers, what_stands_lies_out_of_range_or_was_not_evaluated_does_not_count) {
  for (const ToldMovers& movers :
       {told_of({20, 15, 0}, "stationary"), told_of({45, 0, 0}, "moving"),
        told_of({20, 15, 0}, "moving", 8)})
    EXPECT_EQ(movers.near + movers.elsewhere, 0);
}

TEST(ToldMovers, are_told_of_where_there_are_true_objects_only) {
  EXPECT_NE(to_text(ToldMovers{3, 1}, true).find("3 near one that does, 1 elsewhere"),
            std::string::npos);
  EXPECT_EQ(to_text(ToldMovers{3, 1}, false), "");
}

}  // namespace
}  // namespace lidar_upsampling
