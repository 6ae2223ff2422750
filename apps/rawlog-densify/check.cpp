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

#include "drawing.h"
#include "ego_ahead.h"
#include "lidar_upsampling/front_end/pose_input.h"
#include "lidar_upsampling/front_end/usable_observations.h"
#include "lidar_upsampling/io/carriers.h"
#include "lidar_upsampling/registration/scan_registration.h"
#include "lidar_upsampling/scan/sweep.h"
#include "lidar_upsampling/vision/projection.h"
#include "log_ahead.h"
#include "pictures.h"
#include "streams.h"

namespace lidar_upsampling {
namespace {

using mrpt::obs::CObservation;
using mrpt::obs::CObservationImage;

constexpr std::size_t kMostScans = 120;

/// A scan that was looked at, and how the lidar moved about its stamp, if that is known.
struct PlacedScan {
  LidarScan scan;
  std::function<Pose(double)> lidar_step;
  std::shared_ptr<const LidarScan> before;
};

struct CameraUnderway {
  CameraCheck result;
  std::map<Stamp, Stamp> scan_of_image;
  std::map<Stamp, CameraImage> waiting;  ///< images whose scan has not come yet
  std::vector<OffsetScores> scores;
  Stamp middle;  ///< the image to draw on
};

Stamp nearest(const std::vector<Stamp>& sorted, Stamp stamp) {
  const auto next = std::lower_bound(sorted.begin(), sorted.end(), stamp);
  if (next == sorted.end()) return sorted.back();
  if (next == sorted.begin()) return *next;
  return stamp - *std::prev(next) <= *next - stamp ? *std::prev(next) : *next;
}

LidarScan moved(LidarScan scan, const Pose& T) {
  for (Eigen::Vector3f& point : scan.points) point = (T * point.cast<double>()).cast<float>();
  return scan;
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
    for (auto& [label, camera] : cameras_) {
      CameraCheck& check = camera.result;
      if (check.num_compared > 0) check.share_in_view /= static_cast<double>(check.num_compared);
      TimeOffsetOptions options;
      options.max_sigma_s = options.max_offset_s;  // whoever reads it judges
      check.time_offset = estimate_time_offset(camera.scores, options);
      result_.cameras.push_back(std::move(check));
    }
    if (result_.num_scans > 0) result_.mean_points /= static_cast<double>(result_.num_scans);
  }

 private:
  void choose(const StreamSelection& streams) {
    std::vector<Stamp> scans = streams.lidar->stamps;
    std::sort(scans.begin(), scans.end());
    const std::size_t stride = 1 + (scans.size() - 1) / kMostScans;
    for (const StreamInfo* stream : streams.cameras) {
      CameraUnderway& camera = cameras_[stream->label];
      if (stream->camera) camera.result.camera = *stream->camera;
      apply(job_.rig, camera.result.camera);
      std::vector<Stamp> images = stream->stamps;
      std::sort(images.begin(), images.end());
      for (std::size_t i = 0; i < scans.size(); i += stride) {
        const Stamp image = nearest(images, scans[i]);
        if (std::abs(seconds_between(scans[i], image)) > 0.5 * period_s_) continue;
        camera.scan_of_image[image] = scans[i];
        if (camera.middle == Stamp() || i <= scans.size() / 2) camera.middle = image;
        chosen_.insert(scans[i]);
      }
    }
  }

  void feed_scan(const CObservation& observation) {
    std::optional<LidarScan> scan = usable_.scan(observation);
    if (!scan) return;
    const double period_ms = job_.config.sweep.period_ms;
    const double turn_s = period_ms > 0 ? 1e-3 * period_ms : period_s_;
    if (chosen_.count(scan->stamp) > 0) {
      scans_[scan->stamp] = {*scan, path_of(*scan), previous_};
      PlacedScan& placed = scans_[scan->stamp];
      deskew(placed.scan, point_times(*scan, job_.config.sweep, turn_s), [&](double t) -> Pose {
        return placed.lidar_step ? placed.lidar_step(t).inverse() : Pose::Identity();
      });
      note(placed.scan, !scan->time_s.empty());
      for (auto& [label, camera] : cameras_) meet_waiting(camera, placed);
    }
    constexpr std::size_t kRemembered = 3;
    while (scans_.size() > kRemembered) scans_.erase(scans_.begin());
    previous_ = std::make_shared<LidarScan>(std::move(*scan));
  }

  void feed_image(CameraUnderway& camera, const CObservationImage& observation) {
    const auto pair = camera.scan_of_image.find(observation.timestamp);
    if (pair == camera.scan_of_image.end()) return;
    std::optional<CameraImage> image = usable_.image(observation);
    if (!image) return;
    const auto scan = scans_.find(pair->second);
    if (scan != scans_.end())
      compare(camera, scan->second, *image);
    else
      camera.waiting[image->stamp] = std::move(*image);
  }

  void meet_waiting(CameraUnderway& camera, const PlacedScan& scan) {
    for (auto image = camera.waiting.begin(); image != camera.waiting.end();) {
      if (camera.scan_of_image.at(image->first) != scan.scan.stamp) {
        ++image;
        continue;
      }
      compare(camera, scan, image->second);
      image = camera.waiting.erase(image);
    }
  }

  void compare(CameraUnderway& camera, const PlacedScan& placed, const CameraImage& image) {
    const LidarScan& scan = placed.scan;
    const double dt =
        seconds_between(scan.stamp, image.stamp) - 1e-3 * job_.config.timing.camera_time_offset_ms;
    const LidarScan then =
        moved(scan, placed.lidar_step ? placed.lidar_step(dt) : Pose::Identity());
    CameraCheck& check = camera.result;
    const Pose T_camera_lidar = image.camera.T_vehicle_camera.inverse() * scan.T_vehicle_lidar;
    check.camera = image.camera;
    check.share_in_view +=
        static_cast<double>(project_scan(image.camera.model, T_camera_lidar, then.points).size()) /
        static_cast<double>(scan.size());
    ++check.num_compared;
    if (placed.lidar_step)
      if (const auto scores =
              score_time_offsets({scan, image, placed.lidar_step, placed.before.get()}))
        camera.scores.push_back(*scores);
    if (job_.pictures.empty() || image.stamp != camera.middle) return;
    check.overlay = (std::filesystem::path(job_.pictures) /
                     ("overlay_" + names_.of(image.camera.label) + ".png"))
                        .string();
    std::filesystem::create_directories(job_.pictures);
    write_picture(check.overlay, overlay(then, image, DepthScale::for_scan(then)));
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
  std::map<std::string, CameraUnderway> cameras_;
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
