// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "fuzz/log_seeds.h"

#include <mrpt/img/CImage.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CActionRobotMovement3D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CObservationRotatingScan.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <cmath>
#include <functional>
#include <opencv2/imgproc.hpp>

#include "fuzz/yard.h"
#include "io/velodyne_packets.h"
#include "lidar_upsampling/io/carriers.h"
#include "lidar_upsampling/io/images.h"
#include "lidar_upsampling/io/scan_classes.h"

namespace lidar_upsampling::fuzz {
namespace {

using mrpt::obs::CObservation;

constexpr int kInstants = 7;  // of images; every third has a scan

CObservation::Ptr pose_at(int instant) {
  auto pose = mrpt::obs::CObservationRobotPose::Create();
  pose->sensorLabel = "POSE";
  pose->timestamp = stamp_at(instant);
  return pose;
}

CObservation::Ptr odometry_at(int instant) {
  auto odometry = mrpt::obs::CObservationOdometry::Create();
  odometry->sensorLabel = "ODO";
  odometry->timestamp = stamp_at(instant);
  return odometry;
}

CObservation::Ptr fix_at(int instant) {
  auto fix = mrpt::obs::CObservationGPS::Create();
  fix->sensorLabel = "GNSS";
  fix->timestamp = stamp_at(instant);
  mrpt::obs::gnss::Message_NMEA_GGA gga;
  gga.fields.fix_quality = 1;
  gga.fields.latitude_degrees = 49 + 1e-5 * instant;
  gga.fields.longitude_degrees = 8;
  fix->setMsg(gga);
  return fix;
}

CObservation::Ptr rotating_scan_at(int instant) {
  auto scan = mrpt::obs::CObservationRotatingScan::Create();
  const auto& lasers =
      mrpt::obs::VelodyneCalibration::LoadDefaultCalibration("VLP16").laser_corrections;
  scan->lidarModel = "VLP16";
  scan->rowCount = static_cast<std::uint16_t>(lasers.size());
  scan->columnCount = kColumns;
  scan->rangeResolution = 0.002;
  scan->startAzimuth = 0;
  scan->azimuthSpan = 2 * M_PI;
  scan->rangeImage.resize(scan->rowCount, kColumns);
  scan->intensityImage.resize(scan->rowCount, kColumns);
  for (int row = 0; row < scan->rowCount; ++row)
    for (int column = 0; column < kColumns; ++column) {
      const double elevation = std::asin(lasers[static_cast<std::size_t>(row)].sinVertCorrection);
      const double range = range_of(2 * M_PI * column / kColumns, elevation, instant);
      scan->rangeImage(row, column) = static_cast<std::uint16_t>(range / scan->rangeResolution);
      scan->intensityImage(row, column) = 100;
    }
  return scan;
}

CObservation::Ptr depth_image_at(int instant) {
  constexpr int kRows = 24, kDepthColumns = 32;
  auto depth = mrpt::obs::CObservation3DRangeScan::Create();
  depth->cameraParams.ncols = kDepthColumns;
  depth->cameraParams.nrows = kRows;
  depth->cameraParams.setIntrinsicParamsFromValues(25, 25, kDepthColumns / 2., kRows / 2.);
  depth->cameraParamsIntensity = depth->cameraParams;
  depth->maxRange = 20;
  depth->hasRangeImage = true;
  depth->range_is_depth = false;
  depth->rangeImage_setSize(kRows, kDepthColumns);
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kDepthColumns; ++column) {
      const double range = range_of(-std::atan((column - kDepthColumns / 2.) / 25),
                                    -std::atan((row - kRows / 2.) / 25), instant);
      depth->rangeImage(row, column) = static_cast<std::uint16_t>(range * 1000);
    }
  return depth;
}

CObservation::Ptr packets_at(int instant) {
  constexpr std::size_t kFew = 8;
  auto scan = mrpt::obs::CObservationVelodyneScan::Create(velodyne_packets(
      stamp_at(instant), [](double sine) { return sine < -0.1 ? -kHeightOfSensors / sine : 9.; }));
  scan->scan_packets.resize(kFew);
  return scan;
}

CObservation::Ptr image_at(int instant, bool gray) {
  CameraImage image = picture_at(instant);
  if (gray) {
    cv::cvtColor(image.bgr, image.gray, cv::COLOR_BGR2GRAY);
    image.bgr = cv::Mat();
  }
  return observation_from_image(image);
}

using MakeScan = std::function<CObservation::Ptr(int)>;

MakeScan in_carrier(Carrier carrier) {
  return [carrier](int instant) { return observation_from_scan(scan_at(instant), carrier); };
}

CObservation::Ptr velodyne_points_at(int instant) { return make_velodyne_scan(scan_at(instant)); }

// Kinds that no one asks for, too.
CObservation::Ptr other_at(int instant) {
  CObservation::Ptr other;
  if (instant % 3 == 0) other = mrpt::obs::CObservationComment::Create();
  if (instant % 3 == 1) other = mrpt::obs::CObservationIMU::Create();
  if (instant % 3 == 2) {
    auto scan = mrpt::obs::CObservation2DRangeScan::Create();
    scan->resizeScanAndAssign(20, 3.F, true);
    other = scan;
  }
  other->sensorLabel = "OTHER";
  other->timestamp = stamp_at(instant);
  return other;
}

LogObjects log_of(const MakeScan& scan, const MakeScan& ego, bool gray = false) {
  LogObjects objects;
  for (int instant = 0; instant < kInstants; ++instant) {
    objects.push_back(ego(instant));
    if (instant % 3 == 0) {
      const CObservation::Ptr observation = scan(instant);
      observation->sensorLabel = "LIDAR";
      observation->timestamp = stamp_at(instant);
      observation->setSensorPose(mrpt::poses::CPose3D(0, 0, kHeightOfSensors, 0, 0, 0));
      objects.push_back(observation);
    }
    objects.push_back(image_at(instant, gray));
    if (instant % 2 == 1) objects.push_back(other_at(instant));
  }
  return objects;
}

mrpt::obs::CActionCollection::Ptr actions_at(int instant) {
  auto actions = mrpt::obs::CActionCollection::Create();
  if (instant % 2 == 0) {
    mrpt::obs::CActionRobotMovement2D action;
    action.computeFromOdometry({0.1, 0, 0.01}, {});
    action.timestamp = stamp_at(instant);
    actions->insert(action);
    return actions;
  }
  mrpt::obs::CActionRobotMovement3D action;
  action.computeFromOdometry(mrpt::poses::CPose3D(0.1, 0, 0, 0, 0, 0), {});
  action.timestamp = stamp_at(instant);
  actions->insert(action);
  return actions;
}

// Actions and frames in turn, as MRPT's SLAM programs know logs.
LogObjects in_frames() {
  LogObjects objects;
  for (int instant = 0; instant < kInstants; ++instant) {
    objects.push_back(actions_at(instant));
    auto frame = mrpt::obs::CSensoryFrame::Create();
    if (instant % 3 == 0)
      frame->insert(observation_from_scan(scan_at(instant), Carrier::automatic));
    frame->insert(image_at(instant, false));
    frame->insert(odometry_at(instant));
    objects.push_back(frame);
  }
  return objects;
}

}  // namespace

const std::vector<LogSeed>& log_seeds() {
  static const std::vector<LogSeed> all{
      {"3DRangeScan", log_of(in_carrier(Carrier::range_scan_3d), pose_at)},
      {"PointCloud", log_of(in_carrier(Carrier::point_cloud), pose_at, true)},
      {"VelodyneScan", log_of(velodyne_points_at, odometry_at)},
      {"VelodynePackets", log_of(packets_at, pose_at)},
      {"RotatingScan", log_of(rotating_scan_at, fix_at)},
      {"DepthCamera", log_of(depth_image_at, pose_at)},
      {"Frames", in_frames()},
      {"NoEgo", log_of(in_carrier(Carrier::range_scan_3d), other_at, true)}};
  return all;
}

}  // namespace lidar_upsampling::fuzz
