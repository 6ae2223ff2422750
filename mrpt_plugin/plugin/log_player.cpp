// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "plugin/log_player.h"

#include <mrpt/img/CImage.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservationOdometry.h>

#include <utility>

#include "lidar_upsampling/text.h"

namespace lidar_upsampling {

using mrpt::obs::CActionCollection;
using mrpt::obs::CObservation;
using mrpt::obs::CSensoryFrame;

LogPlayer::LogPlayer(const std::string& path, double speed, Pipeline& pipeline)
    : path_(path),
      speed_(speed),
      pipeline_(pipeline),
      reader_(LogFile(path, true), RecordBytes::dropped) {
  // What is recorded anew shall be what was played; a switch for the whole process.
  mrpt::img::CImage::DISABLE_JPEG_COMPRESSION(true);
  thread_ = std::thread([this] { play(); });
}

LogPlayer::~LogPlayer() {
  stop_.stop();
  pipeline_.abandon();
  thread_.join();
}

void LogPlayer::play() {
  try {
    while (const auto entry = reader_.next()) {
      if (const auto* actions = dynamic_cast<CActionCollection*>(entry->object.get())) {
        actions_.add(*actions);
      } else if (const auto* frame = dynamic_cast<CSensoryFrame*>(entry->object.get())) {
        if (!play(*frame)) return;
      } else if (!play(std::dynamic_pointer_cast<CObservation>(entry->object))) {
        return;
      }
    }
    pipeline_.finish(reader_.damage().value_or(path_ + kPlayedToItsEnd));
  } catch (const std::exception& error) {
    pipeline_.finish(one_line(error));
  }
}

bool LogPlayer::play(const CSensoryFrame& frame) {
  std::optional<Pose> pose = actions_.T_world_vehicle();
  if (pose && !actions_count_)
    actions_count_ = !frame.getObservationByClass<mrpt::obs::CObservationOdometry>();
  if (!actions_count_.value_or(false)) pose.reset();
  for (const CObservation::Ptr& observation : frame)
    if (!play(observation, std::exchange(pose, std::nullopt))) return false;
  return true;
}

bool LogPlayer::play(const CObservation::Ptr& observation,
                     const std::optional<Pose>& pose_by_actions) {
  if (!observation) return true;
  auto time = std::chrono::steady_clock::now();
  const Stamp stamp = observation->timestamp;
  if (speed_ > 0 && stamp != INVALID_TIMESTAMP) {
    if (!first_stamp_) {
      first_stamp_ = stamp;
      start_ = time;
    }
    const std::chrono::duration<double> due(seconds_between(*first_stamp_, stamp) / speed_);
    time = start_ + std::chrono::duration_cast<std::chrono::steady_clock::duration>(due);
  }
  if (speed_ <= 0) pipeline_.wait_for_room();
  if (stop_.wait_until(time)) return false;
  pipeline_.push(observation, pose_by_actions);
  return true;
}

}  // namespace lidar_upsampling
