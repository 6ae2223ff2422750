// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "figures.h"

#include <gtest/gtest.h>

#include "report.h"

namespace lidar_upsampling {
namespace {

ObjectResult object_at(double range, bool moving, double ours, double ego) {
  ObjectResult result;
  result.object.id = "1";
  result.num_points = 50;
  result.object.moving = moving;
  result.object.motion.centroid_k = {range, 0, 0};
  result.errors[Row::ours] = ObjectError{ours, 10 * ours, 0.1, 0.02};
  result.errors[Row::ego] = ObjectError{ego, 10 * ego, 0.2, 0.04};
  return result;
}

LogResult log_of(const std::vector<ObjectResult>& objects) {
  LogResult log;
  ScanResult scan;
  scan.dt = 0.1;
  scan.objects = objects;
  log.scans.add(scan);
  return log;
}

TEST(Figures, moving_and_standing_objects_are_summed_up_apart) {
  const auto figures =
      compute_figures(log_of({object_at(10, true, 0.1, 0.4), object_at(20, true, 0.3, 0.6),
                              object_at(30, false, 0.05, 0.01)}));
  const RowFigures& ours = figures.rows[Row::ours];
  EXPECT_EQ(ours.moving.position_m.count, 2);
  EXPECT_NEAR(ours.moving.position_m.mean, 0.2, 1e-12);
  EXPECT_NEAR(ours.moving.velocity_mps.mean, 2, 1e-12);
  EXPECT_NEAR(ours.moving.depth_percent.mean, 2, 1e-12);
  EXPECT_NEAR(ours.moving.yaw_deg.mean, 0.1 * 180 / M_PI, 1e-9);
  EXPECT_NEAR(ours.standing.position_m.mean, 0.05, 1e-12);
  EXPECT_NEAR(figures.rows[Row::ego].moving.position_m.mean, 0.5, 1e-12);
}

TEST(Figures, an_object_that_ours_does_not_tell_counts_in_no_row_and_is_reported) {
  ObjectResult lost = object_at(10, true, 0, 0.9);
  lost.errors[Row::ours].reset();
  ObjectResult excluded = object_at(10, true, 5, 5);
  excluded.object.excluded = "ambiguous";
  const auto figures = compute_figures(log_of({object_at(10, true, 0.1, 0.4), lost, excluded}));
  EXPECT_EQ(figures.rows[Row::ego].moving.position_m.count, 1);
  EXPECT_EQ(figures.left_out.at("not_recovered"), 1);
  EXPECT_EQ(figures.left_out.at("ambiguous"), 1);
}

TEST(Figures, a_baseline_that_beats_ours_is_named_with_the_reason_where_one_is_known) {
  const auto figures =
      compute_figures(log_of({object_at(10, true, 0.1, 0.4), object_at(30, false, 0.05, 0.01)}));
  const std::string by = ": ego (it is given the reference's own ego-motion)";
  EXPECT_EQ(figures.beaten,
            (std::vector<std::string>{"static objects, mean" + by, "static objects, median" + by,
                                      "static objects, p95" + by}));
}

TEST(Figures, a_baseline_that_is_better_in_the_middle_alone_is_named_too) {
  const auto figures =
      compute_figures(log_of({object_at(10, true, 0.1, 0.05), object_at(10, true, 0.1, 0.05),
                              object_at(10, true, 0.1, 0.9)}));
  EXPECT_EQ(figures.beaten, std::vector<std::string>{"moving objects, median: ego"});
}

TEST(Figures, errors_fall_into_bins_of_range_and_horizon) {
  const auto figures =
      compute_figures(log_of({object_at(5, true, 0.1, 0.4), object_at(25, true, 0.3, 0.6)}));
  const auto find = [&](const std::string& key) {
    for (const Binned& binned : figures.binned)
      if (binned.key == key && binned.moving) return binned;
    return Binned{};
  };
  const Binned by_range = find("range");
  ASSERT_EQ(by_range.bins.size(), 2U);
  EXPECT_EQ(by_range.bins[0].to, 10);
  EXPECT_NEAR(by_range.bins[1].rows[Row::ours].mean, 0.3, 1e-12);
  const Binned by_horizon = find("horizon");
  ASSERT_EQ(by_horizon.bins.size(), 1U);
  EXPECT_NEAR(0.5 * (by_horizon.bins[0].from + by_horizon.bins[0].to), 0.1, 1e-9);
  EXPECT_EQ(by_horizon.bins[0].rows[Row::ours].count, 2);
}

TEST(Figures, the_spread_of_sampled_measures_is_that_between_seeds_not_between_scans) {
  LogResult log;
  for (const double offset : {0., 10.}) {
    ScanResult scan;
    for (const double by_seed : {1., 3.}) {
      SampledDistances distances;
      distances.emd.squared_m2 = offset + by_seed;
      scan.sampled[Row::ours].all.push_back(distances);
    }
    log.scans.add(scan);
  }
  const SeededFigure emd = compute_figures(log).rows[Row::ours].sampled.emd_m2;
  EXPECT_EQ(emd.num_scans, 2);
  EXPECT_NEAR(emd.mean, 7, 1e-12);
  EXPECT_NEAR(emd.spread, std::sqrt(2.), 1e-12);
}

TEST(Table, names_every_row_that_has_figures_and_what_beats_ours) {
  const LogResult log = log_of({object_at(10, true, 0.1, 0.4), object_at(30, false, 0.05, 0.01)});
  const std::string table = to_table(log, compute_figures(log), std::nullopt);
  EXPECT_NE(table.find("  ours "), std::string::npos);
  EXPECT_NE(table.find("  ego "), std::string::npos);
  EXPECT_EQ(table.find("\n  hold "), std::string::npos);
  EXPECT_NE(table.find("a baseline beats ours: static objects, mean: ego"), std::string::npos);
}

TEST(Table, published_figures_stand_in_the_protocols_table_marked_as_such) {
  LogResult log;
  ScanResult scan;
  scan.sampled[Row::ours].all.push_back({});
  log.scans.add(scan);
  const std::string table = to_table(log, compute_figures(log), find_protocol("kitti-odometry"));
  EXPECT_NE(table.find("PointINet (offline) *"), std::string::npos);
  EXPECT_NE(table.find("as published"), std::string::npos);
}

}  // namespace
}  // namespace lidar_upsampling
