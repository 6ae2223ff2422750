// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/obs/CSensoryFrame.h>

#include <optional>
#include <string>
#include <thread>

#include "lidar_upsampling/io/ego_samples.h"
#include "lidar_upsampling/io/rawlog_stream.h"
#include "plugin/pipeline.h"
#include "plugin/source.h"
#include "plugin/stop_signal.h"

namespace lidar_upsampling {

/// How the reason of an end ends that is none but the log's own.
inline constexpr const char* kPlayedToItsEnd = ": played to its end";

/// @brief Plays a log's observations; those inside sensory frames one by one, the first of a frame
/// with the pose that the actions lead to. Actions are passed over if the frames hold odometry too.
/// At the log's end, or where it is broken, it finishes the pipeline.
class LogPlayer : public Source {
 public:
  /// @param speed 1: as fast as it was recorded, N: N times as fast, 0: as fast as the work is
  /// done.
  /// @throw std::runtime_error the file cannot be opened.
  LogPlayer(const std::string& path, double speed, Pipeline& pipeline);
  ~LogPlayer() override;
  LogPlayer(const LogPlayer&) = delete;
  LogPlayer& operator=(const LogPlayer&) = delete;

 private:
  void play();
  [[nodiscard]] bool play(const mrpt::obs::CSensoryFrame& frame);
  [[nodiscard]] bool play(const mrpt::obs::CObservation::Ptr& observation,
                          const std::optional<Pose>& pose_by_actions = {});

  std::string path_;
  double speed_;
  Pipeline& pipeline_;
  RawlogReader reader_;
  ActionOdometry actions_;
  std::optional<bool> actions_count_;  ///< as the first frame after an action tells
  std::optional<Stamp> first_stamp_;
  SteadyTime start_;
  StopSignal stop_;
  std::thread thread_;
};

}  // namespace lidar_upsampling
