// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/io/rig_overrides.h"

#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>

#include "lidar_upsampling/io/images.h"

namespace lidar_upsampling {
namespace {

RigOverrides overrides_of(const std::string& text) {
  return load_rig_overrides(mrpt::config::CConfigFileMemory(text));
}

Camera camera() {
  Camera made;
  made.label = "CAM2";
  made.model.width = 100;
  made.model.height = 50;
  made.model.fx = made.model.fy = 80;
  made.model.cx = 50;
  made.model.cy = 25;
  return made;
}

TEST(RigOverrides, only_what_is_given_is_replaced) {
  const RigOverrides overrides = overrides_of(
      "[camera.CAM2]\n"
      "fx_px = 90   ; measured anew\n"
      "distortion_model = plumb_bob\n"
      "distortion = -0.1 0.2 0.003 0.004 0.05\n"
      "[camera.CAM3]\nfy_px = 1\n"
      "[other]\nkey = 1\n");
  Camera replaced = camera();
  apply(overrides, replaced);
  EXPECT_EQ(replaced.model.fx, 90);
  EXPECT_EQ(replaced.model.fy, 80);
  EXPECT_EQ(replaced.model.distortion_model, DistortionModel::plumb_bob);
  EXPECT_EQ(replaced.model.distortion, (std::array<double, 8>{-0.1, 0.2, 0.003, 0.004, 0.05}));
  EXPECT_TRUE(replaced.T_vehicle_camera.isApprox(Pose::Identity()));
}

TEST(RigOverrides, poses_are_in_metres_and_degrees) {
  const RigOverrides overrides = overrides_of(
      "[camera.CAM2]\npose = 1 2 3 -90 0 -90\n"
      "[lidar.TOP]\npose = 0 0 1.7 90 0 0\n");
  Camera replaced = camera();
  apply(overrides, replaced);
  // A camera that looks ahead: its +Z is the vehicle's +X.
  EXPECT_TRUE((replaced.T_vehicle_camera * Eigen::Vector3d(0, 0, 10))
                  .isApprox(Eigen::Vector3d(11, 2, 3), 1e-9));
  LidarScan scan;
  scan.label = "TOP";
  apply(overrides, scan);
  EXPECT_TRUE(
      (scan.T_vehicle_lidar * Eigen::Vector3d(1, 0, 0)).isApprox(Eigen::Vector3d(0, 1, 1.7), 1e-9));
}

TEST(RigOverrides, intrinsics_of_another_size_are_scaled) {
  const RigOverrides overrides = overrides_of(
      "[camera.CAM2]\nfx_px = 200\nfy_px = 200\ncx_px = 99.5\ncy_px = 49.5\nwidth_px = 200\n"
      "height_px = 100\n");
  Camera replaced = camera();
  apply(overrides, replaced);
  EXPECT_EQ(replaced.model.width, 100);
  EXPECT_DOUBLE_EQ(replaced.model.fx, 100);
  EXPECT_DOUBLE_EQ(replaced.model.cx, 49.5);  // the middle stays the middle
}

TEST(RigOverrides, mistakes_are_named) {
  for (const char* const text : {"[camera.CAM2]\nfocal = 3\n", "[camera.CAM2]\nfx_px = wide\n",
                                 "[camera.CAM2]\nfx_px = 3 4\n", "[camera.CAM2]\nfx_px = nan\n",
                                 "[camera.CAM2]\nwidth_px = 0.5\n", "[camera.CAM2]\npose = 1 2 3\n",
                                 "[camera.CAM2]\ndistortion_model = fisheye\n",
                                 "[camera.CAM2]\ndistortion = 1 2\n", "[lidar.TOP]\nfx_px = 3\n"}) {
    try {
      static_cast<void>(overrides_of(text));
      ADD_FAILURE() << text;
    } catch (const std::invalid_argument& error) {
      EXPECT_EQ(std::string(error.what()).substr(0, 5), std::string(text).substr(0, 5));
    }
  }
}

}  // namespace
}  // namespace lidar_upsampling
