// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "plugin/log_player.h"

#include <mrpt/img/CImage.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <algorithm>

#include "lidar_upsampling/io/mrpt_errors.h"

namespace lidar_upsampling {

using mrpt::obs::CObservation;

LogPlayer::LogPlayer(const std::string& path, double speed, Pipeline& pipeline)
    : path_(path), speed_(speed), pipeline_(pipeline), reader_(path) {
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
      if (const auto* frame = dynamic_cast<mrpt::obs::CSensoryFrame*>(entry->object.get())) {
        for (const CObservation::Ptr& observation : *frame)
          if (!play(observation)) return;
      } else if (!play(std::dynamic_pointer_cast<CObservation>(entry->object))) {
        return;
      }
    }
    pipeline_.finish(path_ + ": played to its end");
  } catch (const std::exception& error) {
    pipeline_.finish(one_line(error));
  }
}

bool LogPlayer::play(const CObservation::Ptr& observation) {
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
  pipeline_.push(observation);
  return true;
}

}  // namespace lidar_upsampling
