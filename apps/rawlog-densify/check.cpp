// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "check.h"

#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <set>

#include "camera_comparison.h"
#include "ego_ahead.h"
#include "lidar_upsampling/front_end/pose_input.h"
#include "lidar_upsampling/front_end/usable_observations.h"
#include "lidar_upsampling/io/carriers.h"
#include "lidar_upsampling/io/file_places.h"
#include "lidar_upsampling/registration/scan_registration.h"
#include "lidar_upsampling/scan/sweep.h"
#include "log_ahead.h"
#include "streams.h"

namespace lidar_upsampling {
namespace {

using mrpt::obs::CObservation;
using mrpt::obs::CObservationImage;

constexpr std::size_t kMostScans = 120;

Stamp nearest(const std::vector<Stamp>& sorted, Stamp stamp) {
  const auto next = std::lower_bound(sorted.begin(), sorted.end(), stamp);
  if (next == sorted.end()) return sorted.back();
  if (next == sorted.begin()) return *next;
  return stamp - *std::prev(next) <= *next - stamp ? *std::prev(next) : *next;
}

/// Goes through the log once: each chosen scan meets the nearest picture of each camera.
class Checker {
 public:
  Checker(const DensifyJob& job, LogCheck& result)
      : job_(job),
        result_(result),
        ego_(job.config.ego_motion),
        usable_(job.rig, job.config.sweep, counted_in(result.unused)) {
    const StreamSelection streams =
        select_streams(result.index, job.config, labels_of_calibrated(job.rig));
    result.lidar_label = streams.lidar->label;
    result.time_offset_in_force_ms = job.config.timing.camera_time_offset_ms;
    period_s_ = streams.lidar->median_period_s;
    result.ego_source = to_string(ego_.source());
    take({result.index.poses, result.index.odometry, result.index.gnss});
    choose(streams);
  }

  /// What there is of the vehicle's motion, ahead of its turn.
  void take(const EgoNews& news) {
    for (const PoseSample& sample : news.poses) ego_.add_pose(sample);
    for (const PoseSample& sample : news.odometry) ego_.add_odometry(sample);
    for (const GnssSample& sample : news.gnss) ego_.add_gnss(sample);
    // What has come up once counts, though it may be forgotten.
    if (ego_.source() != EgoSource::camera) result_.ego_source = to_string(ego_.source());
  }
  void forget_past() {
    if (previous_) ego_.forget_before(shifted(previous_->stamp, -kEgoMemory_s));
  }

  void feed(const CObservation::Ptr& observation) {
    if (!observation) return;
    if (observation->sensorLabel == result_.lidar_label && is_lidar_scan(*observation))
      feed_scan(*observation);
    const auto camera = cameras_.find(observation->sensorLabel);
    const auto* const image = dynamic_cast<const CObservationImage*>(observation.get());
    if (camera != cameras_.end() && image != nullptr) feed_image(camera->second, *image);
    usable_.ego(*observation);
  }

  void finish() {
    for (const auto& [label, camera] : cameras_) result_.cameras.push_back(camera.finish());
    if (result_.num_scans > 0) result_.mean_points /= static_cast<double>(result_.num_scans);
  }

 private:
  void choose(const StreamSelection& streams) {
    std::vector<Stamp> scans = streams.lidar->stamps;
    std::sort(scans.begin(), scans.end());
    const std::size_t stride = 1 + (scans.size() - 1) / kMostScans;
    for (const StreamInfo* stream : streams.cameras) {
      Camera camera = stream->camera.value_or(Camera());
      apply(job_.rig, camera);
      CameraComparison comparison(camera, 1e-3 * job_.config.timing.camera_time_offset_ms);
      std::vector<Stamp> images = stream->stamps;
      std::sort(images.begin(), images.end());
      std::optional<Stamp> middle;
      for (std::size_t i = 0; i < scans.size(); i += stride) {
        const Stamp image = nearest(images, scans[i]);
        if (std::abs(seconds_between(scans[i], image)) > 0.5 * period_s_) continue;
        comparison.pair(image, scans[i]);
        if (!middle || i <= scans.size() / 2) middle = image;
        chosen_.insert(scans[i]);
      }
      if (middle && !job_.pictures.empty())
        comparison.draw_on(*middle, overlay_file(stream->label));
      cameras_.emplace(stream->label, std::move(comparison));
    }
  }

  std::string overlay_file(const std::string& label) {
    const std::filesystem::path folder(job_.pictures);
    return (folder / ("overlay_" + names_.of(label) + ".png")).string();
  }

  void feed_scan(const CObservation& observation) {
    std::optional<LidarScan> scan = usable_.scan(observation);
    if (!scan) return;
    const double period_ms = job_.config.sweep.period_ms;
    const double turn_s = period_ms > 0 ? 1e-3 * period_ms : period_s_;
    if (chosen_.count(scan->stamp) > 0) {
      scans_[scan->stamp] = {*scan, path_of(*scan), previous_};
      PlacedScan& placed = scans_[scan->stamp];
      const auto times = point_times(*scan, job_.config.sweep, turn_s);
      result_.uses_point_times = !times.empty();
      deskew(placed.scan, times, [&](double t) -> Pose {
        return placed.lidar_step ? placed.lidar_step(t).inverse() : Pose::Identity();
      });
      note(placed.scan, !scan->time_s.empty());
      for (auto& [label, camera] : cameras_) camera.take(placed);
    }
    constexpr std::size_t kRemembered = 3;
    while (scans_.size() > kRemembered) scans_.erase(scans_.begin());
    previous_ = std::make_shared<LidarScan>(std::move(*scan));
  }

  void feed_image(CameraComparison& camera, const CObservationImage& observation) {
    const std::optional<Stamp> stamp = camera.scan_of(observation.timestamp);
    if (!stamp) return;
    std::optional<CameraImage> image = usable_.image(observation);
    if (!image) return;
    const auto scan = scans_.find(*stamp);
    if (scan != scans_.end())
      camera.compare(scan->second, *image);
    else
      camera.keep(std::move(*image));
  }

  // The ego-motion that the log holds, else that since the scan before, going on.
  std::function<Pose(double)> path_of(const LidarScan& scan) {
    const Pose T_vehicle_lidar = scan.T_vehicle_lidar;
    const Stamp stamp = scan.stamp;
    if (ego_.step(stamp, stamp))
      return [this, stamp, T_vehicle_lidar](double t) -> Pose {
        const auto step = ego_.step(stamp, shifted(stamp, t));
        return T_vehicle_lidar.inverse() * (step ? step->T_to_from : Pose::Identity()) *
               T_vehicle_lidar;
      };
    if (!previous_ || previous_->stamp >= stamp) return nullptr;
    const double dt = seconds_between(previous_->stamp, stamp);
    const auto registration =
        register_scans(previous_->points, scan.points, exp_se3(Twist(rate_ * dt)));
    if (!registration) return nullptr;
    rate_ = log_se3(registration->T_target_source) / dt;
    return [rate = rate_](double t) { return exp_se3(Twist(rate * t)); };
  }

  void note(const LidarScan& scan, bool has_point_times) {
    ++result_.num_scans;
    result_.mean_points += static_cast<double>(scan.size());
    result_.num_rings = scan.num_rings;
    result_.has_point_times = has_point_times;
    result_.T_vehicle_lidar = scan.T_vehicle_lidar;
  }

  const DensifyJob& job_;
  LogCheck& result_;
  EgoMotion ego_;
  UsableObservations usable_;
  double period_s_ = 0;
  std::set<Stamp> chosen_;
  std::map<Stamp, PlacedScan> scans_;  ///< the last ones chosen
  std::shared_ptr<const LidarScan> previous_;
  Twist rate_ = Twist::Zero();
  std::map<std::string, CameraComparison> cameras_;
  FileNames names_;
};

void feed_entry(const RawlogEntry& entry, Checker& checker) {
  if (const auto* frame = dynamic_cast<const mrpt::obs::CSensoryFrame*>(entry.object.get()))
    for (const CObservation::Ptr& observation : *frame) checker.feed(observation);
  else
    checker.feed(std::dynamic_pointer_cast<CObservation>(entry.object));
}

}  // namespace

LogCheck check_log(const DensifyJob& job, const std::function<void(double)>& progress) {
  constexpr double kIndexShare = 0.2;
  const LogFile file(job.input, true);
  const auto tell_index = [&](double share) { progress(kIndexShare * share); };
  LogCheck result;
  result.index = index_streams(file, tell_index);
  const bool goes_by = ego_goes_by(job.config, result.index);
  if (!goes_by) result.index = index_log(file, tell_index);
  take_poses_from_file(job.config, job.rig, result.index);
  Checker checker(job, result);
  LogAhead log(file, goes_by ? span_ahead_s(job.config) : 0);
  if (goes_by) log.wait_for(streams_ahead(result.index), kLate_s);
  for (std::size_t i = 0; i < result.index.num_objects; ++i) {
    while (!log.is_full() && log.read_on() != nullptr) {
      const EgoNews news = log.indexer().take_ego();
      if (goes_by) checker.take(news);
    }
    const auto entry = log.next();
    if (!entry) break;
    feed_entry(*entry, checker);
    if (goes_by) checker.forget_past();
    progress(kIndexShare + (1 - kIndexShare) * log.progress());
  }
  checker.finish();
  return result;
}

}  // namespace lidar_upsampling
