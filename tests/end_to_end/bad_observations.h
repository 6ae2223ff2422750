// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationOdometry.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "hand_made_log.h"
#include "tools/run_tool.h"

namespace lidar_upsampling {

/// One way for an observation to be of no use.
struct BadObservation {
  std::string label, words;
  /// Spoils an observation of the label; null: `other` is put beside it.
  std::function<void(mrpt::obs::CObservation&)> spoil;
  mrpt::obs::CObservation::Ptr other;
};

inline constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

inline mrpt::obs::CObservation::Ptr fix_of(double latitude_deg) {
  auto fix = mrpt::obs::CObservationGPS::Create();
  fix->sensorLabel = "GNSS";
  mrpt::obs::gnss::Message_NMEA_GGA gga;
  gga.fields.fix_quality = 1;
  gga.fields.latitude_degrees = latitude_deg;
  fix->setMsg(gga);
  return fix;
}

inline mrpt::obs::CObservation::Ptr odometry_of(double x) {
  auto odometry = mrpt::obs::CObservationOdometry::Create();
  odometry->sensorLabel = "ODO";
  odometry->odometry.x(x);
  return odometry;
}

inline std::vector<BadObservation> bad_observations() {
  using mrpt::obs::CObservation;
  const auto image = [](CObservation& o) -> mrpt::obs::CObservationImage& {
    return dynamic_cast<mrpt::obs::CObservationImage&>(o);
  };
  const auto no_pose = [](CObservation& o) {
    mrpt::poses::CPose3D pose;
    o.getSensorPose(pose);
    pose.x(kNoNumber);
    o.setSensorPose(pose);
  };
  const auto no_stamp = [](CObservation& o) { o.timestamp = INVALID_TIMESTAMP; };
  return {
      {"LIDAR", "pose on the vehicle", no_pose, {}},
      {"CAM", "pose on the vehicle", no_pose, {}},
      {"LIDAR", "no time stamp", no_stamp, {}},
      {"CAM", "no time stamp", no_stamp, {}},
      {"CAM", "calibration", [=](CObservation& o) { image(o).cameraParams.fx(kNoNumber); }, {}},
      {"CAM", "calibration", [=](CObservation& o) { image(o).cameraParams.fx(0); }, {}},
      {"CAM",
       "calibration",
       [=](CObservation& o) {
         image(o).cameraParams.distortion = mrpt::img::DistortionModel::plumb_bob;
         image(o).cameraParams.k1(kNoNumber);
       },
       {}},
      {"CAM",
       "1 x 1 instead of 160 x 80",
       [=](CObservation& o) {
         image(o).image = mrpt::img::CImage(cv::Mat(1, 1, CV_8UC3), mrpt::img::DEEP_COPY);
       },
       {}},
      {"CAM", "cannot be read", [=](CObservation& o) { image(o).image = mrpt::img::CImage(); }, {}},
      {"POSE",
       "not finite",
       [](CObservation& o) {
         dynamic_cast<mrpt::obs::CObservationRobotPose&>(o).pose.mean.y(kNoNumber);
       },
       {}},
      {"POSE",
       "beyond 1e8 m",
       [](CObservation& o) {
         dynamic_cast<mrpt::obs::CObservationRobotPose&>(o).pose.mean.x(-1e300);
       },
       {}},
      {"LIDAR",
       "beyond 1e8 m",
       [](CObservation& o) { o.setSensorPose(mrpt::poses::CPose3D(1e300, 0, 0, 0, 0, 0)); },
       {}},
      {"ODO", "not finite", {}, odometry_of(kNoNumber)},
      {"ODO", "beyond 1e8 m", {}, odometry_of(1e300)},
      {"GNSS", "globe", {}, fix_of(kNoNumber)},
      {"GNSS", "globe", {}, fix_of(120)},
  };
}

/// @brief A log's entries with one of its later observations spoilt.
inline std::vector<RawlogEntry> spoilt(const std::vector<RawlogEntry>& log,
                                       const BadObservation& bad) {
  constexpr int kSecond = 1;
  std::vector<RawlogEntry> result;
  int seen = 0;
  for (const RawlogEntry& entry : log) {
    const auto observation = std::dynamic_pointer_cast<mrpt::obs::CObservation>(entry.object);
    const std::string label = bad.spoil ? bad.label : "POSE";
    const bool is_it = observation->sensorLabel == label && seen++ == kSecond;
    if (!is_it || !bad.spoil) result.push_back(entry);
    if (!is_it) continue;
    if (bad.spoil)
      bad.spoil(*observation);
    else
      bad.other->timestamp = observation->timestamp;
    result.push_back(entry_of(bad.spoil ? observation : bad.other));
  }
  return result;
}

inline void write_entries(const std::string& path, const std::vector<RawlogEntry>& entries) {
  RawlogWriter writer(path, true);
  for (const RawlogEntry& entry : entries) writer.write(entry);
  writer.commit();
}

}  // namespace lidar_upsampling
