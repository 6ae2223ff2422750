// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "plugin/live_upsampling.h"

#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationOdometry.h>

#include <algorithm>
#include <exception>
#include <iterator>
#include <utility>

#include "lidar_upsampling/io/ego_samples.h"
#include "lidar_upsampling/io/images.h"
#include "lidar_upsampling/text.h"

namespace lidar_upsampling {

using mrpt::obs::CObservation;
using mrpt::obs::CObservationImage;

LiveUpsampling::LiveUpsampling(const Config& config, const RigOverrides& rig, Messages& messages,
                               const std::vector<PoseSample>& given_poses)
    : config_(config),
      messages_(messages),
      usable_(rig, config.sweep, [&messages](const std::string& text) { messages.add(text); }),
      upsampler_(config),
      has_given_poses_(!given_poses.empty()) {
  for (const PoseSample& sample : given_poses) upsampler_.ego_motion().add_pose(sample);
  if (!config.camera_labels.empty()) upsampler_.expect_cameras(config.camera_labels);
}

std::vector<Emitted> LiveUpsampling::feed(const Arrived& arrived) {
  std::vector<Emitted> out;
  const Stamp stamp = arrived.observation->timestamp;
  if (group_stamp_ &&
      seconds_between(*group_stamp_, stamp) > 1e-3 * config_.timing.group_tolerance_ms) {
    place(flush());
    out = release();
  }
  if (arrived.pose_by_actions) take_actions(stamp, *arrived.pose_by_actions);
  held_.push_back({arrived.observation, {}});
  place(work_on(arrived));
  const bool may_wait = arrived.role == Role::image && !arrived.is_late && cameras_.size() > 1;
  if (may_wait && held_.back().observation == arrived.observation)
    group_stamp_ = stamp;
  else if (arrived.role != Role::other)
    group_stamp_.reset();
  if (group_stamp_) return out;
  auto released = release();
  std::move(released.begin(), released.end(), std::back_inserter(out));
  return out;
}

std::vector<Emitted> LiveUpsampling::finish() {
  place(flush());
  last_real_.reset();
  return release();
}

// Whatever is wrong with an observation, it is passed on.
std::optional<VirtualScan> LiveUpsampling::work_on(const Arrived& arrived) {
  try {
    switch (arrived.is_late ? Role::other : arrived.role) {
      case Role::scan:
        return insert_scan(arrived.observation);
      case Role::image:
        return insert_image(arrived);
      case Role::other:
        learn_ego_motion(*arrived.observation);
    }
  } catch (const std::exception& error) {
    messages_.add("'" + arrived.observation->sensorLabel +
                  "' is passed on unused: " + one_line(error));
  }
  return {};
}

std::optional<VirtualScan> LiveUpsampling::insert_scan(const CObservation::Ptr& real) {
  constexpr double kEgoMemory_s = 5;
  std::optional<LidarScan> scan = usable_.scan(*real);
  if (!scan) return {};
  last_real_ = real;
  upsampler_.ego_motion().forget_before(shifted(scan->stamp, -kEgoMemory_s));
  return upsampler_.insert_scan(std::move(*scan));
}

std::optional<VirtualScan> LiveUpsampling::insert_image(const Arrived& arrived) {
  constexpr std::size_t kMostRemembered = 100;
  const auto image = usable_.image(dynamic_cast<const CObservationImage&>(*arrived.observation));
  if (!image) return {};
  cameras_.insert(image->camera.label);
  image_arrivals_[image->stamp] = arrived.time;
  if (image_arrivals_.size() > kMostRemembered) image_arrivals_.erase(image_arrivals_.begin());
  return upsampler_.insert_image(*image, arrived.is_hurried ? Effort::prediction : Effort::full);
}

void LiveUpsampling::learn_ego_motion(const CObservation& observation) {
  if (!usable_.ego(observation) || !is_listened_to(observation)) return;
  EgoSamples samples;
  samples.add_observation(observation);
  EgoMotion& ego_motion = upsampler_.ego_motion();
  if (!has_given_poses_)
    for (const PoseSample& sample : samples.poses()) ego_motion.add_pose(sample);
  for (const PoseSample& sample : samples.odometry()) ego_motion.add_odometry(sample);
  for (const GnssSample& sample : samples.gnss()) ego_motion.add_gnss(sample);
}

// Single actions would end the recording for MRPT's readers; of odometry rawlog-grabber makes
// actions itself where it makes frames.
void LiveUpsampling::take_actions(Stamp stamp, const Pose& T_world_vehicle) {
  if (stamp == INVALID_TIMESTAMP) return;
  auto odometry = mrpt::obs::CObservationOdometry::Create();
  odometry->sensorLabel = "ACTIONS";
  odometry->timestamp = stamp;
  odometry->odometry = mrpt::poses::CPose2D(to_mrpt(T_world_vehicle));
  held_.push_back({odometry, {}});
  if (!is_listened_to(*odometry)) return;
  try {
    upsampler_.ego_motion().add_odometry({stamp, T_world_vehicle});
  } catch (const std::exception& error) {
    messages_.add("actions are not used: " + one_line(error));
  }
}

// Streams of different labels may use different worlds: the first of a class is the one.
bool LiveUpsampling::is_listened_to(const CObservation& observation) {
  const auto first =
      ego_labels_.emplace(observation.GetRuntimeClass()->className, observation.sensorLabel).first;
  return first->second == observation.sensorLabel;
}

std::optional<VirtualScan> LiveUpsampling::flush() {
  try {
    return upsampler_.flush();
  } catch (const std::exception& error) {
    messages_.add("a virtual scan is left out: " + one_line(error));
    return {};
  }
}

void LiveUpsampling::place(const std::optional<VirtualScan>& scan) {
  if (!scan) return;
  const Stamp stamp = scan->scan.stamp;
  std::vector<Emitted> emitted;
  try {
    for (const auto& observation : virtual_observations(*scan, config_, *last_real_))
      emitted.push_back({observation, {}});
  } catch (const std::exception& error) {
    messages_.add("a virtual scan is left out: " + one_line(error));
    return;
  }
  const auto arrival = image_arrivals_.find(stamp);
  emitted.front().image_arrival =
      arrival == image_arrivals_.end() ? std::chrono::steady_clock::now() : arrival->second;
  const auto before = std::find_if(held_.rbegin(), held_.rend(), [&](const Emitted& other) {
    return other.observation->timestamp <= stamp;
  });
  held_.insert(before.base(), std::make_move_iterator(emitted.begin()),
               std::make_move_iterator(emitted.end()));
}

std::vector<Emitted> LiveUpsampling::release() {
  group_stamp_.reset();
  std::vector<Emitted> all(std::make_move_iterator(held_.begin()),
                           std::make_move_iterator(held_.end()));
  held_.clear();
  return all;
}

}  // namespace lidar_upsampling
