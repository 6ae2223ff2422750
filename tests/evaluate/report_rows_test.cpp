// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "io/test_folder.h"
#include "rawlog-densify/report.h"

namespace lidar_upsampling {
namespace {

ReportRow row_of(int number) {
  ReportRow row;
  row.stamp = Stamp(mrpt::Clock::duration(132000000000000000LL + number));
  row.num_points = static_cast<std::size_t>(number);
  row.object.track_id = number;
  row.object.class_name = std::string(static_cast<std::size_t>(number % 50), 'c');
  row.object.camera_label = number % 3 == 0 ? "" : "/cam";
  row.object.status = MotionStatus::moving;
  row.object.T_lidar_t_lidar_k.translation() << number, 2, 3;
  row.object.velocity_lidar_k << 0.1 * number, 0, 0;
  row.object.rmse_px = 1. / (1 + number);
  if (number % 2 == 0) row.box.emplace().size << 4, 2, 1.5;
  return row;
}

// Of more than one block.
DensifyReport report_with(const TestFolder& folder, int num_rows) {
  DensifyReport report;
  report.rows = std::make_shared<ReportRows>(folder / "report.json");
  for (int i = 0; i < num_rows; ++i) {
    report.rows->add(row_of(i));
    if (i % 7 == 0) report.rows->add(row_of(i).stamp, {{1, 2, 3}, {4, 2, 1}, 9, "too_far"});
  }
  return report;
}

TEST(ReportRows, come_back_as_they_were_and_in_their_order) {
  const TestFolder folder;
  const DensifyReport report = report_with(folder, 3000);
  int num_rows = 0, num_clusters = 0;
  report.rows->for_each(
      [&](const ReportRow& row) {
        const ReportRow expected = row_of(num_rows++);
        ASSERT_EQ(row.object.track_id, expected.object.track_id);
        EXPECT_EQ(row.stamp, expected.stamp);
        EXPECT_EQ(row.object.class_name, expected.object.class_name);
        EXPECT_EQ(row.object.rmse_px, expected.object.rmse_px);
        EXPECT_EQ(row.box.has_value(), expected.box.has_value());
        EXPECT_TRUE(row.object.T_lidar_t_lidar_k.isApprox(expected.object.T_lidar_t_lidar_k));
      },
      [&](Stamp, const OtherCluster& cluster) {
        ++num_clusters;
        EXPECT_STREQ(cluster.why, "too_far");
      });
  EXPECT_EQ(num_rows, 3000);
  EXPECT_EQ(num_clusters, 429);
}

TEST(Report, as_a_stream_is_the_document_byte_for_byte) {
  for (const int num_rows : {0, 1, 2, 3000}) {
    const TestFolder folder;
    DensifyReport report = report_with(folder, num_rows);
    report.input = "a \"b\"\n.rawlog";
    report.warn("a kind");
    std::ostringstream text;
    write_json(report, text);
    nlohmann::json document = to_json(report);
    // Each looks for itself how much else the machine does.
    document["machine"]["load"] = nlohmann::json::parse(text.str())["machine"]["load"];
    EXPECT_TRUE(text.str() == document.dump(1) + "\n") << num_rows;
  }
}

Eigen::Vector3d vector_of(const nlohmann::json& json) {
  return {json[0].get<double>(), json[1].get<double>(), json[2].get<double>()};
}

// Rear and right side of a car, 10 m ahead.
VirtualScan car_that_turns(double yaw_rate, double speed, double dt) {
  VirtualScan scan;
  ObjectMotion object;
  for (int i = 0; i <= 40; ++i)
    for (const float height : {-1.5F, -0.5F}) {
      scan.scan.points.emplace_back(10.F, 2 - 0.04F * static_cast<float>(i), height);
      scan.scan.points.emplace_back(10 + 0.1F * static_cast<float>(i), 0.4F, height);
    }
  for (int i = 0; i < static_cast<int>(scan.scan.size()); ++i) {
    object.points.push_back(i);
    scan.source_index.push_back(i);
  }
  object.track_id = 1;
  object.camera_label = "CAM";
  object.status = MotionStatus::moving;
  object.centroid_lidar_k = mean_of(scan.scan.points);
  object.yaw_rate = yaw_rate;
  // Its middle goes straight ahead.
  const Eigen::Vector3d middle(12, 1.2, -1);
  const Eigen::Vector3d arm = object.centroid_lidar_k - middle;
  object.velocity_lidar_k =
      speed * Eigen::Vector3d::UnitX() + yaw_rate * Eigen::Vector3d::UnitZ().cross(arm);
  scan.scan.stamp = shifted(scan.key_stamp, dt);
  scan.objects.push_back(object);
  return scan;
}

TEST(Report, tells_of_a_car_that_turns_how_its_middle_goes_as_labels_do) {
  const TestFolder folder;
  DensifyReport report;
  report.rows = std::make_shared<ReportRows>(folder / "report.json");
  report.add(car_that_turns(0.8, 6, 0.05));
  // Its points' centroid, at the rear, goes 0.8 m/s to the side.
  const auto told = to_json(report)["objects"][0];
  EXPECT_LT((vector_of(told["velocity_m_s"]) - Eigen::Vector3d(6, 0, 0)).norm(), 0.25);
}

TEST(Report, tells_place_and_velocity_in_the_frame_at_the_image_so_that_one_takes_the_other_back) {
  const TestFolder folder;
  DensifyReport report;
  report.rows = std::make_shared<ReportRows>(folder / "report.json");
  const Pose T_ego(Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitZ()));  // the vehicle turns
  ReportRow row = row_of(1);                                           // without a box
  row.object.centroid_lidar_k << 10, -3, 1;
  row.object.velocity_lidar_k << 8, 1, 0;
  row.object.T_mov.translation() = 0.1 * row.object.velocity_lidar_k;
  row.object.T_lidar_t_lidar_k = T_ego * row.object.T_mov;
  report.rows->add(row);

  const auto told = to_json(report)["objects"][0];
  const Eigen::Vector3d position = vector_of(told["position_m"]);
  const Eigen::Vector3d velocity = vector_of(told["velocity_m_s"]);
  EXPECT_TRUE((position - 0.1 * velocity).isApprox(T_ego * row.object.centroid_lidar_k, 1e-9));
  EXPECT_NEAR(velocity.norm(), row.object.velocity_lidar_k.norm(), 1e-9);
}

TEST(Report, warnings_of_a_kind_are_one_with_a_count_and_the_first_one) {
  DensifyReport report;
  for (const char* file : {"a.png", "b.png", "c.png"}) report.warn("an image was left out", file);
  report.warn("a scan was left out", "it is empty");
  const auto warnings = to_json(report)["warnings"];
  EXPECT_EQ(warnings.size(), 2U);
  EXPECT_EQ(warnings["an image was left out: a.png (the first of them)"], 3);
  EXPECT_EQ(warnings["a scan was left out: it is empty"], 1);
}

TEST(Durations, have_the_quantiles_of_the_values_to_half_a_percent) {
  Durations durations, others;
  for (int i = 1; i <= 1000; ++i) (i % 2 == 0 ? durations : others).add(0.1 * i);
  durations.add(others);
  EXPECT_EQ(durations.count(), 1000U);
  EXPECT_NEAR(durations.total_ms(), 50050, 1e-6);
  EXPECT_NEAR(durations.quantile(0.5), 50, 0.3);
  EXPECT_NEAR(durations.quantile(0.95), 95, 0.6);
  EXPECT_EQ(Durations().quantile(0.5), 0);
}

}  // namespace
}  // namespace lidar_upsampling
