// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <gtest/gtest.h>

#include <algorithm>

#include "street_run.h"

namespace lidar_upsampling {
namespace {

/// A scanner that turns while we drive: an oncoming car on the left is met well before the stamp.
constexpr const char* kSweep = R"(
[ego]
speed_mps = 12
[lidar]
sweep = true
[scenario]
duration_s = 0.4
[vehicle.far_lane]
x_m = 24
y_m = 5.1
yaw_deg = 180
speed_mps = 9
)";

struct SweepErrors {
  double standing = 0, moving = 0;  ///< m, mean of all virtual scans
};

/// Distances of virtual points from where the truth takes them, each from its own instant on:
/// of what stands the median (a parked car that is dragged along is another matter), of moving
/// objects in view the mean.
SweepErrors sweep_errors(StreetRun& street, ScanTime scan_time, bool with_poses = true) {
  Config config = moving_points();
  config.sweep.scan_time = scan_time;
  LidarUpsampler upsampler{config};
  const auto scans = street.run(upsampler, with_poses);
  SweepErrors errors;
  double num_moving = 0;
  for (const VirtualScan& scan : scans) {
    const sim::SimulatedScan& key = street.scan_at(scan.key_stamp);
    std::vector<double> standing;
    for (std::size_t i = 0; i < scan.scan.size(); ++i) {
      const int source = scan.source_index[i], object = key.object[source];
      const bool moves = street.world.objects[object].moves();
      if (moves && key.scan.points[source].x() < 0) continue;  // behind: no camera sees it
      const Eigen::Vector3d truth =
          street.true_motion(moves ? object : -1, shifted(scan.key_stamp, key.scan.time_s[source]),
                             scan.scan.stamp) *
          key.scan.points[source].cast<double>();
      const double error = (scan.scan.points[i].cast<double>() - truth).norm();
      if (moves) {
        errors.moving += error;
        ++num_moving;
      } else {
        standing.push_back(error);
      }
    }
    errors.standing += median(standing) / static_cast<double>(scans.size());
  }
  errors.moving /= num_moving;
  return errors;
}

TEST(SweepingLidar, points_are_taken_from_their_own_instants) {
  StreetRun street(kSweep);
  const SweepErrors none = sweep_errors(street, ScanTime::none);
  const SweepErrors azimuth = sweep_errors(street, ScanTime::azimuth);
  const SweepErrors points = sweep_errors(street, ScanTime::points);
  EXPECT_EQ(sweep_errors(street, ScanTime::as_told).moving, points.moving);
  EXPECT_GT(none.standing, 0.1);
  EXPECT_LT(azimuth.standing, 0.003);
  EXPECT_LT(points.standing, 0.003);
  EXPECT_LT(azimuth.moving, 0.7 * none.moving);
  EXPECT_LT(points.moving, 0.7 * none.moving);
}

TEST(SweepingLidar, that_sits_tilted_does_as_well_as_a_level_one) {
  const std::string street =
      std::string(kSweep) + "[lidar]\nrings = 96\nfov_up_deg = 14\nfov_down_deg = -35\n";
  StreetRun level(street), tilted(street + "orientation_deg = 0 10 0\n");
  const SweepErrors upright = sweep_errors(level, ScanTime::points);
  const SweepErrors aslant = sweep_errors(tilted, ScanTime::points);
  EXPECT_LT(aslant.standing, 0.003);
  EXPECT_LT(aslant.moving, 1.2 * upright.moving + 0.01);
}

TEST(SweepingLidar, without_poses_the_rate_between_scans_straightens_them) {
  StreetRun street(kSweep);
  const SweepErrors none = sweep_errors(street, ScanTime::none, false);
  const SweepErrors points = sweep_errors(street, ScanTime::points, false);
  EXPECT_LT(points.standing, 0.5 * none.standing);  // the first scan stays as it is
}

TEST(SweepingLidar, virtual_scans_are_of_one_instant) {
  StreetRun street(std::string(kSweep) + "[scenario]\nduration_s = 0.1\n");
  Config config = moving_points();
  config.sweep.scan_time = ScanTime::none;
  LidarUpsampler as_it_is{config};
  const auto sheared = street.run(as_it_is);
  ASSERT_FALSE(sheared.empty());
  EXPECT_EQ(sheared.front().scan.time_s.size(), sheared.front().scan.size());
  config.sweep.scan_time = ScanTime::points;
  LidarUpsampler upsampler{config};
  const auto straight = street.run(upsampler);
  ASSERT_FALSE(straight.empty());
  EXPECT_TRUE(straight.front().scan.time_s.empty());
}

TEST(SweepingLidar, times_that_the_log_does_not_have_are_asked_for_in_vain) {
  StreetRun street("[scenario]\nduration_s = 0.1\n");
  Config config = moving_points();
  config.sweep.scan_time = ScanTime::points;
  LidarUpsampler upsampler{config};
  EXPECT_THROW((void)upsampler.insert_scan(street.scan_at(sim::start_stamp()).scan),
               std::runtime_error);
}

}  // namespace
}  // namespace lidar_upsampling
