// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "lidar_upsampling/ego/trajectory.h"
#include "lidar_upsampling/io/carriers.h"
#include "lidar_upsampling/io/images.h"
#include "tools/run_tool.h"

namespace lidar_upsampling {

/// The observations of a log by what they are, in its order.
struct ImportedLog {
  std::vector<LidarScan> scans;
  std::vector<CameraImage> images;
  std::vector<PoseSample> poses;
  std::vector<std::string> pose_labels;
};

/// Checks on the way that the stamps never go back.
inline ImportedLog read_imported(const std::string& path) {
  ImportedLog log;
  Stamp last;
  for (const RawlogEntry& entry : read_log(path)) {
    auto& observation = dynamic_cast<mrpt::obs::CObservation&>(*entry.object);
    EXPECT_GE(observation.timestamp, last);
    last = observation.timestamp;
    if (auto* const image = dynamic_cast<mrpt::obs::CObservationImage*>(&observation)) {
      log.images.push_back(image_from_observation(*image));
    } else if (auto* const pose = dynamic_cast<mrpt::obs::CObservationRobotPose*>(&observation)) {
      log.poses.push_back({pose->timestamp, from_mrpt(pose->pose.mean)});
      log.pose_labels.push_back(pose->sensorLabel);
    } else {
      log.scans.push_back(scan_from_observation(observation).value());
    }
  }
  return log;
}

inline void expect_near(const Pose& a, const Pose& b, double tolerance) {
  EXPECT_LT((a.matrix() - b.matrix()).cwiseAbs().maxCoeff(), tolerance)
      << "got\n"
      << a.matrix() << "\nexpected\n"
      << b.matrix();
}

inline void expect_same_camera(const Camera& a, const Camera& b) {
  EXPECT_EQ(a.label, b.label);
  EXPECT_EQ(a.model.width, b.model.width);
  EXPECT_EQ(a.model.height, b.model.height);
  EXPECT_NEAR(a.model.fx, b.model.fx, 1e-6);
  EXPECT_NEAR(a.model.fy, b.model.fy, 1e-6);
  EXPECT_NEAR(a.model.cx, b.model.cx, 1e-6);
  EXPECT_NEAR(a.model.cy, b.model.cy, 1e-6);
  EXPECT_EQ(a.model.distortion_model, DistortionModel::none);
  expect_near(a.T_vehicle_camera, b.T_vehicle_camera, 1e-6);
}

}  // namespace lidar_upsampling
