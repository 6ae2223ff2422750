// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <random>
#include <set>

#include "io/test_folder.h"
#include "kitti2rawlog/hdl64_rings.h"
#include "kitti2rawlog/kitti_calibration.h"
#include "kitti2rawlog/kitti_drive.h"
#include "kitti2rawlog/kitti_frames.h"
#include "kitti_day.h"
#include "run_tool.h"

namespace lidar_upsampling::kitti {
namespace {

std::int64_t ticks(const std::string& text) {
  return parse_stamp(text).value().time_since_epoch().count();
}

TEST(KittiStamps, are_exact_to_the_tick) {
  EXPECT_EQ(ticks("1601-01-01 00:00:00"), 0);
  EXPECT_EQ(ticks("1970-01-01 00:00:00.000000000"), 116444736000000000LL);
  const std::int64_t drive = (11644473600LL + 1317042272LL) * 10'000'000;
  EXPECT_EQ(ticks("2011-09-26 13:04:32.335337762"), drive + 3353378);
  EXPECT_EQ(ticks("2011-09-26 13:04:32.335337749"), drive + 3353377);
  EXPECT_EQ(ticks("2011-09-26 13:04:32.999999999"), drive + 10'000'000);
  EXPECT_EQ(ticks("2011-09-26 13:04:32.5"), drive + 5'000'000);
  EXPECT_EQ(ticks("2012-03-01 00:00:00") - ticks("2012-02-28 00:00:00"), 2 * 864'000'000'000LL);
  EXPECT_EQ(ticks("2100-03-01 00:00:00") - ticks("2100-02-28 00:00:00"), 864'000'000'000LL);
}

TEST(KittiStamps, other_texts_are_none) {
  for (const char* const text : {"", "13:04:32", "2011-09-26", "2011-13-26 13:04:32",
                                 "2011-09-26 13:04:32 UTC", "2011-09-26 13:04:32.12x"}) {
    EXPECT_FALSE(parse_stamp(text)) << text;
  }
}

// An HDL-64's points in KITTI's order, with returns missing at random and whole sectors of some
// rings.
LidarScan ordered_scan(std::vector<int>& true_ring) {
  LidarScan scan;
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0., 1.);
  for (int ring = 63; ring >= 0; --ring) {
    const double elevation = (-24.8 + 26.8 * ring / 63) * M_PI / 180;
    for (int k = 0; k < 2083; ++k) {
      const double azimuth = 2 * M_PI * (k + 0.4 * unit(random)) / 2083;
      const bool hidden = ring % 5 == 0 && (azimuth < 1 || azimuth > 5);
      if (hidden || unit(random) < 0.1) continue;
      const double range = 5 + 60 * unit(random);
      scan.points.emplace_back(static_cast<float>(range * std::cos(elevation) * std::cos(azimuth)),
                               static_cast<float>(range * std::cos(elevation) * std::sin(azimuth)),
                               static_cast<float>(range * std::sin(elevation)));
      true_ring.push_back(ring);
    }
  }
  return scan;
}

// Two points of one ring never share a column, and columns follow the azimuth.
void expect_good_columns(const LidarScan& scan, int max_shift) {
  std::set<std::pair<int, int>> cells;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    ASSERT_LT(scan.column[i], kHdl64Columns);
    ASSERT_TRUE(cells.emplace(scan.ring[i], scan.column[i]).second);
    double azimuth = std::atan2(static_cast<double>(scan.points[i].y()),
                                static_cast<double>(scan.points[i].x()));
    if (azimuth < 0) azimuth += 2 * M_PI;
    const double nominal = azimuth / (2 * M_PI) * kHdl64Columns;
    ASSERT_LE(std::abs(scan.column[i] + 0.5 - nominal), max_shift + 0.5 + 1e-3);
  }
}

TEST(KittiRings, are_found_by_the_order_of_the_points) {
  std::vector<int> true_ring;
  LidarScan scan = ordered_scan(true_ring);
  ASSERT_TRUE(derive_rings(scan));
  EXPECT_EQ(scan.num_rings, 64);
  EXPECT_EQ(scan.num_columns, kHdl64Columns);
  EXPECT_TRUE(std::equal(true_ring.begin(), true_ring.end(), scan.ring.begin()));
  expect_good_columns(scan, 1);
}

TEST(KittiRings, points_in_another_order_get_none) {
  std::vector<int> ignored;
  LidarScan scan = ordered_scan(ignored);
  std::shuffle(scan.points.begin(), scan.points.end(), std::mt19937(2));
  EXPECT_FALSE(derive_rings(scan));
  EXPECT_TRUE(scan.ring.empty());
  EXPECT_TRUE(scan.column.empty());
}

TEST(KittiRings, of_a_real_scan_rise_in_elevation) {
  const auto day = data_folder() / "kitti_raw/2011_09_26";
  if (!std::filesystem::exists(day)) GTEST_SKIP() << "no " << day;
  Frame frame;
  frame.path = (day / "2011_09_26_drive_0052_sync/velodyne_points/data/0000000000.bin").string();
  const LidarScan scan = read_scan(frame, Pose::Identity());
  ASSERT_EQ(scan.ring.size(), scan.size());
  std::vector<std::vector<double>> elevations(64);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const Eigen::Vector3d p = scan.points[i].cast<double>();
    elevations[scan.ring[i]].push_back(std::atan2(p.z(), std::hypot(p.x(), p.y())));
  }
  std::vector<double> median;
  for (auto& ring : elevations) {
    ASSERT_FALSE(ring.empty());
    const auto middle = ring.begin() + static_cast<long>(ring.size() / 2);
    std::nth_element(ring.begin(), middle, ring.end());
    median.push_back(*middle);
  }
  // The beams start at different heights, so near objects can bring neighbours out of order.
  for (std::size_t ring = 3; ring < 64; ++ring) EXPECT_GT(median[ring], median[ring - 3]) << ring;
  expect_good_columns(scan, 3);
}

Eigen::Vector2d project(const Calibration& calibration, int number,
                        const Eigen::Vector3d& in_lidar) {
  const Camera& camera = calibration.cameras.at(number);
  const Eigen::Vector3d p =
      camera.T_vehicle_camera.inverse() * calibration.T_vehicle_lidar * in_lidar;
  return {camera.model.fx * p.x() / p.z() + camera.model.cx,
          camera.model.fy * p.y() / p.z() + camera.model.cy};
}

// As KITTI's own description has it: P_rect * R_rect_00 * T_velo_to_cam.
Eigen::Vector2d project_as_described(const std::string& day, int number,
                                     const Eigen::Vector3d& in_lidar) {
  using RowMajor34 = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;
  using RowMajor33 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  const CalibrationFile velo = read_calibration_file(day + "/calib_velo_to_cam.txt");
  const CalibrationFile cams = read_calibration_file(day + "/calib_cam_to_cam.txt");
  const Eigen::Map<const RowMajor33> R(velo.at("R").data());
  const Eigen::Map<const Eigen::Vector3d> T(velo.at("T").data());
  const Eigen::Map<const RowMajor33> R_rect(cams.at("R_rect_00").data());
  const Eigen::Map<const RowMajor34> P(cams.at("P_rect_0" + std::to_string(number)).data());
  const Eigen::Vector3d rectified = R_rect * (R * in_lidar + T);
  return (P * rectified.homogeneous()).hnormalized();
}

void expect_projections_agree(const std::string& day) {
  const Calibration calibration = read_calibration(day);
  ASSERT_EQ(calibration.cameras.size(), 4U);
  for (const auto& [number, camera] : calibration.cameras) {
    EXPECT_EQ(camera.label, "CAM" + std::to_string(number));
    EXPECT_EQ(camera.model.distortion_model, DistortionModel::none);
    for (const Eigen::Vector3d& p :
         {Eigen::Vector3d(10, 2, -1), Eigen::Vector3d(40, -8, 1), Eigen::Vector3d(5, 0.5, 0.3)}) {
      EXPECT_LT((project(calibration, number, p) - project_as_described(day, number, p)).norm(),
                0.01);
    }
  }
}

TEST(KittiCalibration, projects_as_kitti_describes) {
  const TestFolder folder;
  write_kitti_calibration(folder.path());
  expect_projections_agree(folder.path().string());
  const auto day = data_folder() / "kitti_raw/2011_09_26";
  if (std::filesystem::exists(day)) expect_projections_agree(day.string());
}

TEST(KittiCalibration, the_lidar_sits_where_the_imu_file_says) {
  const TestFolder folder;
  write_kitti_calibration(folder.path());
  const Calibration calibration = read_calibration(folder.path().string());
  EXPECT_TRUE(
      calibration.T_vehicle_lidar.translation().isApprox(Eigen::Vector3d(0.8, -0.3, 0.8), 1e-9));
}

TEST(KittiCalibration, what_is_missing_is_named) {
  const TestFolder folder;
  EXPECT_THROW(static_cast<void>(read_calibration(folder.path().string())), std::runtime_error);
  write_kitti_calibration(folder.path());
  std::ofstream(folder / "calib_velo_to_cam.txt") << "R: 1 0 0 0 1 0 0 0 1\n";
  try {
    static_cast<void>(read_calibration(folder.path().string()));
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_TRUE(contains(error.what(), "calib_velo_to_cam.txt")) << error.what();
    EXPECT_TRUE(contains(error.what(), "'T'")) << error.what();
  }
}

TEST(KittiCalibration, what_is_no_rotation_or_projection_is_named) {
  const auto error_with = [](const std::string& file, const std::string& text) -> std::string {
    const TestFolder folder;
    write_kitti_calibration(folder.path());
    std::ofstream(folder / file, std::ios::app) << text;
    try {
      static_cast<void>(read_calibration(folder.path().string()));
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "none";
  };
  const std::string no_rotation = "calib_velo_to_cam.txt: entry 'R' is no rotation";
  for (const char* R : {"0 0 0 0 0 0 0 0 0", "-1 0 0 0 1 0 0 0 1", "1e308 0 0 0 1 0 0 0 1"})
    EXPECT_TRUE(
        contains(error_with("calib_velo_to_cam.txt", "\nR: " + std::string(R) + "\n"), no_rotation))
        << R;
  EXPECT_TRUE(contains(error_with("calib_cam_to_cam.txt", "\nP_rect_02: 0 0 0 0 0 0 0 0 0 0 1 0\n"),
                       "entry 'P_rect_02' is no camera's projection"));
  EXPECT_EQ(error_with("calib_cam_to_cam.txt", "\n"), "none");
}

Pose oxts_pose(OxtsReader& reader, const TestFolder& folder, const std::string& line) {
  std::ofstream(folder / "oxts.txt") << line;
  return reader.T_world_vehicle(folder / "oxts.txt");
}

TEST(KittiOxts, poses_are_east_north_up_from_the_first_record) {
  const TestFolder folder;
  OxtsReader reader;
  const Pose first = oxts_pose(reader, folder, "49.0 8.4 112 0 0 0 1 2 3");
  EXPECT_TRUE(first.isApprox(Pose::Identity(), 1e-9));
  const Pose north = oxts_pose(reader, folder, "49.0001 8.4 113 0 0 1.5707963267948966");
  EXPECT_NEAR(north.translation().y(), 11.121, 0.002);  // 1e-4 degrees of the meridian at 49 North
  EXPECT_NEAR(north.translation().x(), 0, 1e-3);
  EXPECT_NEAR(north.translation().z(), 1, 1e-3);
  EXPECT_TRUE((north.linear() * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d::UnitY(), 1e-9));
  const Pose nose_down = oxts_pose(reader, folder, "49.0 8.4 112 0 0.1 0");
  EXPECT_LT((nose_down.linear() * Eigen::Vector3d::UnitX()).z(), -0.09);
  const Pose left_up = oxts_pose(reader, folder, "49.0 8.4 112 0.1 0 0");
  EXPECT_GT((left_up.linear() * Eigen::Vector3d::UnitY()).z(), 0.09);
  EXPECT_THROW(static_cast<void>(oxts_pose(reader, folder, "49.0 8.4 x")), std::runtime_error);
}

}  // namespace
}  // namespace lidar_upsampling::kitti
