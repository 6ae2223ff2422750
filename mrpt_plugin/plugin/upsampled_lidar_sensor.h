// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/hwdrivers/CGenericSensor.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/system/COutputLogger.h>

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "plugin/driver_sources.h"
#include "plugin/live_streams.h"
#include "plugin/messages.h"
#include "plugin/pipeline.h"
#include "plugin/sensor_settings.h"
#include "plugin/statistics.h"

namespace lidar_upsampling {

/// @brief A LiDAR as fast as the camera: owns its sources, a played log or other drivers, and hands
/// out their observations together with the virtual scans, in time order. Real observations are
/// never dropped; a virtual scan is, where the work falls behind. Actions of a played log serve as
/// ego-motion and come out as CObservationOdometry labelled ACTIONS: rawlog-grabber knows no more
/// than one action at a time, and makes that of odometry itself where it makes frames. What MRPT's
/// class cannot hold of them, their uncertainty and what does not lie in the plane, is not
/// recorded.
///
/// After a log's end, or a driver's failure, doProcess() goes on until the user of the observations
/// has let go of all of them, and then throws: rawlog-grabber stops at an exception, and would
/// leave unwritten what it has not yet come to. At a log's end it is told to stop without one.
class UpsampledLidarSensor : public mrpt::hwdrivers::CGenericSensor,
                             public mrpt::system::COutputLogger {
  DEFINE_GENERIC_SENSOR(UpsampledLidarSensor)

 public:
  UpsampledLidarSensor();
  ~UpsampledLidarSensor() override;
  UpsampledLidarSensor(const UpsampledLidarSensor&) = delete;
  UpsampledLidarSensor& operator=(const UpsampledLidarSensor&) = delete;

  /// Starts the sources. @throw std::runtime_error a source cannot be started.
  void initialize() override;
  /// @throw std::runtime_error with the reason, at the end.
  void doProcess() override;
  void setPathForExternalImages(const std::string& directory) override;

  [[nodiscard]] SensorStatistics statistics() const;

 private:
  void loadConfig_sensorSpecific(const mrpt::config::CConfigFileBase& source,
                                 const std::string& section) override;
  [[nodiscard]] std::vector<PoseSample> given_poses() const;
  void hand_out();
  void start();
  void end(const std::string& reason);
  [[nodiscard]] bool ends_quietly(const std::string& reason);
  void append_fillers();
  void share_external_images();
  void report() const;

  SensorSettings settings_;
  std::vector<Driver> drivers_;
  std::string external_images_;
  Messages messages_;
  std::optional<LiveStreams> streams_;
  std::unique_ptr<Pipeline> pipeline_;
  std::unique_ptr<Source> source_;
  std::deque<std::weak_ptr<mrpt::obs::CObservation>> handed_out_;
  Stamp last_stamp_{};
  std::optional<SteadyTime> end_time_;
  std::optional<SteadyTime> key_time_;
};

}  // namespace lidar_upsampling
