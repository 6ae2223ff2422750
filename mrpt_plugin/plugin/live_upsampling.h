// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/obs/CObservation.h>

#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "lidar_upsampling/front_end/usable_observations.h"
#include "lidar_upsampling/front_end/virtual_observations.h"
#include "lidar_upsampling/io/rig_overrides.h"
#include "lidar_upsampling/upsampler.h"
#include "plugin/messages.h"
#include "plugin/pipeline.h"
#include "plugin/work_queue.h"

namespace lidar_upsampling {

/// @brief Drives the upsampler with what comes in live: nothing is known but what has arrived. Real
/// observations come out as they went in, each virtual scan behind the image it belongs to, and a
/// frame's pose by the actions before it, as a CObservationOdometry; while a virtual scan waits for
/// the images of further cameras, what follows waits too.
class LiveUpsampling : public Upsampling {
 public:
  /// @param config, rig, messages must outlive this.
  /// @param given_poses take the place of those that come in, unless there are none.
  /// @throw as LidarUpsampler does.
  LiveUpsampling(const Config& config, const RigOverrides& rig, Messages& messages,
                 const std::vector<PoseSample>& given_poses = {});

  [[nodiscard]] std::vector<Emitted> feed(const Arrived& arrived) override;
  [[nodiscard]] std::vector<Emitted> finish() override;
  [[nodiscard]] std::size_t num_hurried() const override { return upsampler_.num_hurried(); }

 private:
  [[nodiscard]] std::optional<VirtualScan> work_on(const Arrived& arrived);
  [[nodiscard]] std::optional<VirtualScan> insert_scan(const mrpt::obs::CObservation::Ptr& real);
  [[nodiscard]] std::optional<VirtualScan> insert_image(const Arrived& arrived);
  void learn_ego_motion(const mrpt::obs::CObservation& observation);
  void take_actions(Stamp stamp, const Pose& T_world_vehicle);
  [[nodiscard]] bool is_listened_to(const mrpt::obs::CObservation& observation);
  [[nodiscard]] std::optional<VirtualScan> flush();
  void place(const std::optional<VirtualScan>& scan);
  [[nodiscard]] std::vector<Emitted> release();

  const Config& config_;
  Messages& messages_;
  UsableObservations usable_;
  LidarUpsampler upsampler_;
  bool has_given_poses_;
  mrpt::obs::CObservation::Ptr last_real_;
  std::set<std::string> cameras_;
  std::map<std::string, std::string> ego_labels_;  ///< by class, the one label that is listened to
  std::map<Stamp, SteadyTime> image_arrivals_;
  std::optional<Stamp> group_stamp_;  ///< of images whose virtual scan may still be waiting
  std::deque<Emitted> held_;
};

}  // namespace lidar_upsampling
