// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <GeographicLib/LocalCartesian.hpp>
#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <string>
#include <utility>

#include "street_objects.h"

namespace lidar_upsampling {
namespace {

void expect_close_to_truth(const StreetRun& street, const std::vector<VirtualScan>& scans,
                           double standing, double moving) {
  double worst_standing = 0, sum_moving = 0;
  for (const VirtualScan& scan : scans) {
    const PointErrors errors = point_errors(street, scan);
    worst_standing = std::max(worst_standing, errors.standing);
    sum_moving += errors.moving;
  }
  EXPECT_LT(worst_standing, standing);
  EXPECT_LT(sum_moving / static_cast<double>(scans.size()), moving);
}

TEST(LidarUpsampler, a_virtual_scan_comes_at_every_image_between_two_scans) {
  StreetRun street(kSmallRig);
  LidarUpsampler upsampler{moving_points()};
  const auto scans = street.run(upsampler);
  ASSERT_EQ(scans.size(), 6U);
  for (const VirtualScan& scan : scans) {
    const double age = seconds_between(scan.key_stamp, scan.scan.stamp);
    EXPECT_TRUE(std::abs(age - 1. / 30) < 1e-6 || std::abs(age - 2. / 30) < 1e-6) << age;
    EXPECT_EQ(scan.scan.label, "LIDAR_VIRTUAL");
    EXPECT_FALSE(scan.ego_extrapolated);
  }
}

TEST(LidarUpsampler, points_are_where_the_true_motion_puts_them) {
  StreetRun street;
  LidarUpsampler upsampler{moving_points()};
  expect_close_to_truth(street, street.run(upsampler), 0.02, 0.1);
}

TEST(LidarUpsampler, moving_cars_are_told_from_parked_ones) {
  StreetRun street;
  LidarUpsampler upsampler{moving_points()};
  const auto scans = street.run(upsampler);
  const auto moving = moving_objects(scans.back());
  ASSERT_GE(moving.size(), 2U);
  std::vector<double> speeds;
  for (const ObjectMotion* object : moving) speeds.push_back(object->velocity_lidar_k.x());
  EXPECT_TRUE(
      std::any_of(speeds.begin(), speeds.end(), [](double v) { return std::abs(v - 11) < 1; }));
  EXPECT_TRUE(
      std::any_of(speeds.begin(), speeds.end(), [](double v) { return std::abs(v + 9) < 1.5; }));
  EXPECT_TRUE(std::any_of(
      scans.back().objects.begin(), scans.back().objects.end(),
      [](const ObjectMotion& object) { return object.status == MotionStatus::stationary; }));
}

TEST(LidarUpsampler, what_stands_is_surer_of_its_place_than_a_picture_tells) {
  StreetRun street;
  LidarUpsampler upsampler{moving_points()};
  const auto scans = street.run(upsampler);
  std::vector<double> sigmas;
  for (const ObjectMotion& object : scans.back().objects)
    if (object.status == MotionStatus::stationary) sigmas.push_back(position_sigma(object));
  ASSERT_FALSE(sigmas.empty());
  EXPECT_GT(*std::min_element(sigmas.begin(), sigmas.end()), 0);
  EXPECT_LT(median(sigmas), 0.01);
}

double mean_error_of_moving_points(const StreetRun& street, const std::vector<VirtualScan>& scans) {
  double sum = 0;
  for (const VirtualScan& scan : scans) sum += point_errors(street, scan).moving;
  return sum / static_cast<double>(scans.size());
}

TEST(LidarUpsampler, clusters_that_are_no_candidates_are_told_once_for_each_real_scan) {
  StreetRun street(kSmallRig);
  Config config = moving_points();
  config.detector.clusters.max_range = 15;
  LidarUpsampler upsampler{config};
  std::map<Stamp, int> times;
  for (const VirtualScan& scan : street.run(upsampler)) {
    if (scan.other_clusters.empty()) continue;
    ++times[scan.key_stamp];
    EXPECT_TRUE(std::any_of(
        scan.other_clusters.begin(), scan.other_clusters.end(), [](const OtherCluster& cluster) {
          return std::string(cluster.why) == "too_far" && cluster.centroid_lidar_k.norm() > 15;
        }));
  }
  EXPECT_EQ(times.size(), 3U);
  for (const auto& [key_stamp, count] : times) EXPECT_EQ(count, 1);
}

TEST(LidarUpsampler, who_knows_the_next_scan_moves_cars_better) {
  StreetRun street;
  Config config = moving_points();
  LidarUpsampler causal{config};
  config.mode = "offline";
  LidarUpsampler offline{config};
  const auto blind = street.run(causal), knowing = street.run(offline, true, true);
  ASSERT_EQ(blind.size(), 10U);
  ASSERT_EQ(knowing.size(), 10U);
  EXPECT_LT(mean_error_of_moving_points(street, knowing),
            0.9 * mean_error_of_moving_points(street, blind));
}

TEST(LidarUpsampler, who_knows_scans_to_come_moves_cars_from_the_first_image_on) {
  StreetRun street;
  Config config = moving_points();
  LidarUpsampler causal{config};
  config.mode = "offline";
  LidarUpsampler offline{config};
  const auto blind = street.run(causal), knowing = street.run(offline, true, true);
  ASSERT_FALSE(blind.empty());
  ASSERT_FALSE(knowing.empty());
  EXPECT_LT(point_errors(street, knowing[0]).moving, 0.7 * point_errors(street, blind[0]).moving);
  std::vector<double> speeds;
  for (const ObjectMotion* object : moving_objects(knowing[0]))
    speeds.push_back(object->velocity_lidar_k.x());
  EXPECT_TRUE(
      std::any_of(speeds.begin(), speeds.end(), [](double v) { return std::abs(v - 11) < 1; }));
  EXPECT_TRUE(
      std::any_of(speeds.begin(), speeds.end(), [](double v) { return std::abs(v + 9) < 1; }));
}

TEST(LidarUpsampler, in_a_hurry_objects_go_on_as_they_were_seen_to_move) {
  StreetRun street;
  LidarUpsampler upsampler{moving_points()};
  constexpr double kLastImages_s = 0.4;
  street.hurried_from = shifted(street_begin(), kLastImages_s - 0.001);
  const auto scans = street.run(upsampler);
  ASSERT_EQ(scans.size(), 10U);
  EXPECT_EQ(upsampler.num_hurried(), 2U) << "on the image beside a scan nothing is followed anyhow";
  EXPECT_TRUE(moving_objects(scans.back()).empty());
  EXPECT_GE(std::count_if(scans.back().objects.begin(), scans.back().objects.end(),
                          [](const ObjectMotion& object) {
                            return object.status == MotionStatus::predicted;
                          }),
            2);
  EXPECT_LT(point_errors(street, scans.back()).moving, 0.15);
  EXPECT_LT(point_errors(street, scans.back()).standing, 0.02);
  for (const VirtualScan* scan : {&scans[8], &scans[9]})
    for (const StageTime& time : scan->timing)
      EXPECT_STRNE(time.stage, "points to follow") << "nobody will look for them";
}

TEST(LidarUpsampler, after_a_hurry_the_first_image_with_time_is_looked_at) {
  StreetRun street;
  LidarUpsampler with_time{moving_points()}, upsampler{moving_points()};
  const auto at_leisure = street.run(with_time);
  constexpr double kLastScan_s = 0.4;
  street.hurried_from = shifted(street_begin(), kLastScan_s - 0.001);
  street.hurried_until = shifted(street_begin(), kLastScan_s + 0.05);
  const auto scans = street.run(upsampler);
  ASSERT_EQ(scans.size(), 10U);
  EXPECT_EQ(upsampler.num_hurried(), 1U);
  EXPECT_TRUE(moving_objects(scans[8]).empty());
  EXPECT_FALSE(moving_objects(scans[9]).empty());
  EXPECT_NEAR(point_errors(street, scans[9]).moving, point_errors(street, at_leisure[9]).moving,
              0.005);
  EXPECT_LT(point_errors(street, scans.back()).standing, 0.02);
}

TEST(LidarUpsampler, point_fields_stay_with_their_points) {
  StreetRun street("[scenario]\nduration_s = 0.1\n");
  LidarUpsampler upsampler{moving_points()};
  const auto scans = street.run(upsampler);
  ASSERT_FALSE(scans.empty());
  const VirtualScan& scan = scans.front();
  const LidarScan key = street.scan_at(scan.key_stamp).scan;
  ASSERT_EQ(scan.scan.ring.size(), scan.scan.size());
  ASSERT_EQ(scan.scan.intensity.size(), scan.scan.size());
  for (std::size_t i = 0; i < scan.scan.size(); i += 37) {
    EXPECT_EQ(scan.scan.ring[i], key.ring[scan.source_index[i]]);
    EXPECT_EQ(scan.scan.column[i], key.column[scan.source_index[i]]);
    EXPECT_EQ(scan.scan.intensity[i], key.intensity[scan.source_index[i]]);
  }
}

TEST(LidarUpsampler, without_poses_the_camera_gives_the_ego_motion) {
  StreetRun street;
  LidarUpsampler upsampler{moving_points()};
  const auto scans = street.run(upsampler, false);
  ASSERT_EQ(scans.size(), 10U);
  EXPECT_EQ(upsampler.ego_motion().source(), EgoSource::camera);
  expect_close_to_truth(street, scans, 0.08, 0.15);
}

TEST(LidarUpsampler, cars_all_round_that_drive_as_fast_are_not_taken_for_the_world) {
  StreetRun street(
      "[lidar]\nmax_range_m = 10\n[static]\nparked_cars = 0\ntrees = 0\n[vehicle.lead]\nx_m = 7\n"
      "speed_mps = 9\n[vehicle.oncoming]\nx_m = 1\ny_m = 1.7\nyaw_deg = 0\nspeed_mps = 9\n"
      "[vehicle.behind]\nx_m = -7\ny_m = -1.7\nspeed_mps = 9\n");
  LidarUpsampler upsampler{moving_points()};
  expect_close_to_truth(street, street.run(upsampler), 0.02, 0.1);
}

TEST(LidarUpsampler, a_camera_with_unrelated_stamps_works_as_well) {
  StreetRun street("[scenario]\nduration_s = 1\n[camera.CAM0]\nrate_hz = 15\nphase_s = 0.0231\n");
  LidarUpsampler upsampler{moving_points()};
  const auto scans = street.run(upsampler);
  ASSERT_GE(scans.size(), 9U);
  expect_close_to_truth(street, scans, 0.02, 0.15);
}

TEST(LidarUpsampler, lens_distortion_is_taken_into_account) {
  StreetRun street(
      "[camera.CAM0]\ndistortion_model = plumb_bob\ndistortion = -0.28 0.09 0.001 -0.0005 -0.01 0 "
      "0 0\n");
  LidarUpsampler upsampler{moving_points()};
  expect_close_to_truth(street, street.run(upsampler), 0.02, 0.1);
}

TEST(LidarUpsampler, a_turn_that_smoothed_fixes_cut_moves_nothing_that_stands) {
  StreetRun street(
      "[scenario]\nduration_s = 1.4\n[ego]\nmotion = 0.9 0 15\n[vehicle.lead]\nspeed_mps = 0\n"
      "[vehicle.oncoming]\nspeed_mps = 0\n");
  LidarUpsampler upsampler{moving_points()};
  const GeographicLib::LocalCartesian world(49, 8.4, 115);
  std::mt19937 random(5);
  std::normal_distribution<double> noise_m(0, 0.03);
  for (const Stamp stamp : sim::stamps_of(10, 0, 2)) {
    Eigen::Vector3d at = street.world.T_world_vehicle(sim::time_of(stamp)).translation();
    at += Eigen::Vector3d(noise_m(random), noise_m(random), noise_m(random));
    GnssSample fix{stamp, 0, 0, 0, Eigen::Vector3d::Zero()};
    world.Reverse(at.x(), at.y(), at.z(), fix.latitude_deg, fix.longitude_deg, fix.height_m);
    upsampler.ego_motion().add_gnss(fix);
  }
  double worst = 0;
  for (const VirtualScan& scan : street.run(upsampler, false)) {
    if (scan.scan.stamp < shifted(street_begin(), 0.5))
      continue;  // it takes scans to know the fixes
    worst = std::max(worst, point_errors(street, scan).standing);
  }
  EXPECT_LT(worst, 0.02);
}

TEST(LidarUpsampler, each_beam_measures_what_the_sensor_would_have_measured) {
  StreetRun street("[scenario]\nduration_s = 0.2\n");
  LidarUpsampler upsampler{Config()};
  const auto scans = street.run(upsampler);
  ASSERT_FALSE(scans.empty());
  for (const VirtualScan& scan : scans) {
    ASSERT_EQ(scan.resampling, Resampling::done);
    const LidarScan truth = street.scan_at(scan.scan.stamp).scan;
    std::map<std::pair<int, int>, float> true_range;
    for (std::size_t i = 0; i < truth.size(); ++i)
      true_range[{truth.ring[i], truth.column[i]}] = truth.points[i].norm();
    std::vector<float> errors;
    for (std::size_t i = 0; i < scan.scan.size(); ++i) {
      const Eigen::Vector3f& point = scan.scan.points[i];
      ASSERT_NEAR(std::atan2(point.z(), point.head<2>().norm()),
                  street.scenario.lidar.elevations[scan.scan.ring[i]], 2e-3);
      const auto truly = true_range.find({scan.scan.ring[i], scan.scan.column[i]});
      if (truly != true_range.end()) errors.push_back(std::abs(point.norm() - truly->second));
    }
    ASSERT_GT(errors.size(), 20000U);
    std::nth_element(errors.begin(), errors.begin() + errors.size() * 3 / 4, errors.end());
    EXPECT_LT(errors[errors.size() * 3 / 4], 0.04F);  // ranges are noisy by 0.01 m
  }
}

TEST(LidarUpsampler, moving_objects_can_be_left_out) {
  StreetRun street;
  Config config;
  config.compose.objects = MovingObjects::drop;
  LidarUpsampler upsampler{config};
  const auto scans = street.run(upsampler);
  const VirtualScan& scan = scans.back();
  ASSERT_FALSE(moving_objects(scan).empty());
  EXPECT_LT(scan.scan.size(), street.scan_at(scan.key_stamp).scan.size());
  for (const ObjectMotion* object : moving_objects(scan))
    EXPECT_EQ(std::count(scan.track_id.begin(), scan.track_id.end(), object->track_id), 0);
}

TEST(LidarUpsampler, points_that_no_camera_sees_can_be_left_out) {
  StreetRun street("[scenario]\nduration_s = 0.1\n");
  Config config;
  config.compose.outside_view = OutsideView::drop;
  LidarUpsampler upsampler{config};
  const auto scans = street.run(upsampler);
  ASSERT_FALSE(scans.empty());
  for (const Eigen::Vector3f& point : scans.front().scan.points) ASSERT_GT(point.x(), 0);
}

TEST(LidarUpsampler, the_result_is_the_same_for_any_number_of_threads) {
  StreetRun street("[scenario]\nduration_s = 0.2\n");
  const auto run = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    LidarUpsampler upsampler{Config()};
    return street.run(upsampler);
  };
  const auto one = run(1), many = run(4);
  ASSERT_EQ(one.size(), many.size());
  for (std::size_t i = 0; i < one.size(); ++i)
    EXPECT_TRUE(one[i].scan.points == many[i].scan.points) << "virtual scan " << i;
}

TEST(LidarUpsampler, scans_and_images_out_of_order_do_no_harm) {
  StreetRun street(kSmallRig);
  LidarUpsampler upsampler{moving_points()};
  const auto first = street.scan_at(sim::stamp_of(1, 10, 0)).scan;
  EXPECT_FALSE(upsampler.insert_scan(first));
  EXPECT_FALSE(upsampler.insert_scan(street.scan_at(sim::stamp_of(0, 10, 0)).scan));
  EXPECT_FALSE(upsampler.insert_image(street.picture_at(0, sim::stamp_of(0, 30, 0))));
}

}  // namespace
}  // namespace lidar_upsampling
