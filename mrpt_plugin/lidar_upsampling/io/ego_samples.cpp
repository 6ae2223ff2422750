// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/io/ego_samples.h"

#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CActionRobotMovement3D.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lidar_upsampling/io/images.h"
#include "lidar_upsampling/se3.h"

namespace lidar_upsampling {
namespace {

template <typename Sample>
using Streams = std::map<std::string, std::vector<Sample>>;

template <typename Sample>
auto longest_of(const Streams<Sample>& streams) {
  return std::max_element(streams.begin(), streams.end(), [](const auto& a, const auto& b) {
    return a.second.size() < b.second.size();
  });
}

template <typename Sample>
std::vector<Sample> longest(const Streams<Sample>& streams) {
  const auto it = longest_of(streams);
  return it == streams.end() ? std::vector<Sample>() : it->second;
}

// @param label of the stream to take; in and out.
template <typename Sample>
std::vector<Sample> take_from(Streams<Sample>& streams, std::optional<std::string>& label) {
  if (!label && !streams.empty()) label = longest_of(streams)->first;
  std::vector<Sample> taken;
  if (label) taken = std::move(streams[*label]);
  streams.clear();
  return taken;
}

Stamp gnss_stamp(const mrpt::obs::CObservationGPS& observation) {
  const Stamp received = observation.originalReceivedTimestamp;
  if (received == INVALID_TIMESTAMP) return observation.timestamp;
  if (observation.timestamp == INVALID_TIMESTAMP) return received;
  const bool agree = std::abs(seconds_between(received, observation.timestamp)) < 1.;
  return agree ? observation.timestamp : received;
}

// Of poses and odometry.
std::optional<PoseSample> pose_of(const mrpt::obs::CObservation& observation) {
  if (const auto* const pose = dynamic_cast<const mrpt::obs::CObservationRobotPose*>(&observation))
    return PoseSample{pose->timestamp,
                      from_mrpt(pose->pose.mean) * from_mrpt(pose->sensorPose).inverse()};
  if (const auto* const wheels = dynamic_cast<const mrpt::obs::CObservationOdometry*>(&observation))
    return PoseSample{wheels->timestamp, from_mrpt(mrpt::poses::CPose3D(wheels->odometry))};
  return {};
}

}  // namespace

std::optional<GnssSample> gnss_sample(const mrpt::obs::CObservationGPS& observation) {
  if (!observation.hasMsgType(mrpt::obs::gnss::NMEA_GGA)) return std::nullopt;
  // Not getMsgByClassPtr(): its const version does not compile in MRPT 2.5.8.
  const auto* const gga = dynamic_cast<const mrpt::obs::gnss::Message_NMEA_GGA*>(
      observation.getMsgByType(mrpt::obs::gnss::NMEA_GGA));
  if (gga == nullptr || gga->fields.fix_quality == 0) return std::nullopt;
  GnssSample sample;
  sample.stamp = gnss_stamp(observation);
  sample.latitude_deg = gga->fields.latitude_degrees;
  sample.longitude_deg = gga->fields.longitude_degrees;
  sample.height_m = gga->fields.altitude_meters + gga->fields.geoidal_distance;
  sample.antenna_in_vehicle = from_mrpt(observation.sensorPose).translation();
  return sample;
}

void ActionOdometry::add(const mrpt::obs::CActionCollection& actions) {
  std::optional<Pose> step;
  if (const auto planar = actions.getBestMovementEstimation())
    step = from_mrpt(mrpt::poses::CPose3D(planar->poseChange->getMeanVal()));
  else if (const auto spatial = actions.getActionByClass<mrpt::obs::CActionRobotMovement3D>())
    step = from_mrpt(spatial->poseChange.mean);
  if (!step) return;
  if (!T_world_vehicle_) T_world_vehicle_ = Pose::Identity();
  const Pose T_world_next = *T_world_vehicle_ * *step;
  if (is_possible(T_world_next)) T_world_vehicle_ = T_world_next;
}

std::optional<std::string> ego_defect_of(const mrpt::obs::CObservation& observation) {
  const auto sample = pose_of(observation);
  if (sample && !is_possible(sample->T_world_vehicle))
    return "its pose has a number that is not finite, or beyond 1e8 m";
  const auto* const gps = dynamic_cast<const mrpt::obs::CObservationGPS*>(&observation);
  const auto fix = gps != nullptr ? gnss_sample(*gps) : std::nullopt;
  if (fix && !is_on_globe(*fix)) return "its fix lies off the globe, or is not finite";
  return sample || fix ? stamp_defect_of(observation) : std::nullopt;
}

std::optional<std::string> stamp_defect_of(const mrpt::obs::CObservation& observation) {
  constexpr Stamp kFirst, kLast(Stamp::duration(4000000000000000000));  // 12000 years later
  const Stamp stamp = observation.timestamp;
  if (stamp == INVALID_TIMESTAMP) return "it has no time stamp";
  if (stamp < kFirst || stamp > kLast) return "it has no time stamp that can be";
  return {};
}

void EgoSamples::add_observation(const mrpt::obs::CObservation& observation) {
  if (ego_defect_of(observation)) return;
  const std::string& label = observation.sensorLabel;
  if (const auto pose = pose_of(observation)) {
    const bool is_pose = IS_DERIVED(observation, mrpt::obs::CObservationRobotPose);
    (is_pose ? poses_ : odometry_)[label].push_back(*pose);
  } else if (const auto* const gps =
                 dynamic_cast<const mrpt::obs::CObservationGPS*>(&observation)) {
    if (const auto sample = gnss_sample(*gps)) gnss_[label].push_back(*sample);
  }
}

void EgoSamples::add_actions(const mrpt::obs::CActionCollection& actions) { actions_.add(actions); }

void EgoSamples::add_frame(const mrpt::obs::CSensoryFrame& frame) {
  const std::optional<Pose>& T_world_vehicle = actions_.T_world_vehicle();
  if (!T_world_vehicle || frame.empty()) return;
  const Stamp stamp = (*frame.begin())->timestamp;
  if (stamp != INVALID_TIMESTAMP) from_actions_.push_back({stamp, *T_world_vehicle});
}

std::vector<PoseSample> EgoSamples::poses() const { return longest(poses_); }

std::vector<PoseSample> EgoSamples::odometry() const {
  const std::vector<PoseSample> observed = longest(odometry_);
  return observed.size() >= from_actions_.size() ? observed : from_actions_;
}

std::vector<GnssSample> EgoSamples::gnss() const { return longest(gnss_); }

EgoNews EgoSamples::take() {
  if (!taken_odometry_ && !takes_actions_)
    takes_actions_ = from_actions_.size() > longest(odometry_).size();
  EgoNews news;
  news.poses = take_from(poses_, taken_poses_);
  if (takes_actions_) odometry_.clear();
  news.odometry = take_from(odometry_, taken_odometry_);
  if (takes_actions_) news.odometry = std::move(from_actions_);
  from_actions_.clear();
  news.gnss = take_from(gnss_, taken_gnss_);
  return news;
}

}  // namespace lidar_upsampling
