// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/upsampler.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lidar_upsampling/camera_view.h"
#include "lidar_upsampling/level_frame.h"
#include "lidar_upsampling/object_motions.h"
#include "lidar_upsampling/scan_of_next.h"
#include "lidar_upsampling/sights.h"
#include "lidar_upsampling/stopwatch.h"

namespace lidar_upsampling {

namespace {

double ms_between(Stamp a, Stamp b) { return std::abs(seconds_between(a, b)) * 1e3; }

std::shared_ptr<const Picture> make_picture(const CameraImage& image, Stamp instant,
                                            const KltOptions& options,
                                            std::vector<StageTime>& timing) {
  const Stopwatch watch(timing, "image pyramid");
  return std::make_shared<Picture>(Picture{image, instant, ImagePyramid(image.gray, options)});
}

}  // namespace

LidarUpsampler::LidarUpsampler(const Config& config)
    : config_(config), ego_motion_(config.ego_motion), detector_(make_detector(config.detector)) {
  // What is too large for a candidate is split before it is given up.
  config_.segments.clusters.max_length = config.detector.clusters.max_length;
  config_.segments.clusters.max_width = config.detector.clusters.max_width;
  // Pictures are as noisy for tracks as for the pose of an object's points.
  config_.object_tracks.points.sigma_px = config.object_motion.picture.pose.sigma_px;
}

LidarUpsampler::~LidarUpsampler() = default;

void LidarUpsampler::expect_cameras(const std::vector<std::string>& labels) {
  expected_cameras_ = labels.size();
}

void LidarUpsampler::expect_scans(std::vector<Stamp> stamps) {
  std::sort(stamps.begin(), stamps.end());
  expected_scans_ = std::move(stamps);
}

std::optional<VirtualScan> LidarUpsampler::insert_scan(LidarScan scan) {
  auto waiting = flush();
  if (key_ && scan.stamp <= key_->scan.stamp) return waiting;  // out of order: of no use any more
  while (!to_come_.empty() && to_come_.front()->scan.stamp < scan.stamp) to_come_.pop_front();
  const bool was_expected = !to_come_.empty() && to_come_.front()->scan.stamp == scan.stamp;
  auto next = was_expected ? std::move(to_come_.front()) : prepared(std::move(scan), key_.get());
  if (was_expected) to_come_.pop_front();
  if (key_) scan_period_s_ = seconds_between(key_->scan.stamp, next->scan.stamp);
  key_ = std::move(next);
  track_of_.clear();
  is_taken_up_ = false;
  if (!detector_) take_up(nullptr);
  for (auto& [label, view] : views_) {
    view->of_key.reset();
    view->anchor.reset();
  }
  return waiting;
}

std::optional<VirtualScan> LidarUpsampler::insert_image(const CameraImage& image, Effort effort) {
  const Stamp instant = shifted(image.stamp, -1e-3 * config_.timing.camera_time_offset_ms);
  std::optional<VirtualScan> waiting;
  if (!group_.empty() &&
      ms_between(group_.front().instant, instant) > config_.timing.group_tolerance_ms)
    waiting = flush();

  CameraView& view = view_of(image.camera);
  const auto picture = make_picture(image, instant, config_.klt, timing_);
  if (key_ && ms_between(key_->scan.stamp, instant) <= config_.timing.pair_tolerance_ms) {
    view.of_key = picture;
    take_up(picture.get());
    if (effort == Effort::full) start(view);
  } else if (is_due(instant)) {
    process(view, *picture, effort);
  }
  view.last = picture;

  const std::size_t cameras = std::max(expected_cameras_, views_.size());
  if (waiting || group_.size() < cameras) return waiting;
  return flush();
}

std::optional<VirtualScan> LidarUpsampler::flush() {
  if (group_.empty()) return {};
  const std::vector<ImageResult> group = std::exchange(group_, {});
  const ImageResult& newest = *std::max_element(
      group.begin(), group.end(),
      [](const ImageResult& a, const ImageResult& b) { return a.instant < b.instant; });

  ScanMotion motion;
  motion.stamp = newest.stamp;
  motion.T_lidar_t_lidar_k = newest.ego.T_to_from;
  motion.ego_extrapolated = newest.ego.extrapolated;
  for (const ImageResult& result : group) motion.cameras.push_back(result.camera);
  {
    const Stopwatch watch(timing_, "object motion");
    std::vector<const Camera*> rig;
    for (const auto& [label, view] : views_) rig.push_back(&view->camera);
    motion.objects =
        estimate_motions(group, newest, {*key_, store_, track_of_}, rig, store_, config_);
  }
  return compose(std::move(motion));
}

VirtualScan LidarUpsampler::compose(ScanMotion motion) {
  Stopwatch watch(timing_, "composition");
  const PreparedScan* next = to_come_.empty() ? nullptr : to_come_.front().get();
  std::optional<VirtualScan> of_next;
  if (next != nullptr && next->resampler) {
    of_next = assign_points(next->scan, motion_of_next(*next, motion, key_->scan, *key_->seen), {},
                            config_.compose);
    put_in_axes(*of_next, next->R_level_lidar.transpose());
  }
  VirtualScan scan = assign_points(key_->scan, std::move(motion),
                                   config_.virtual_label(key_->scan.label), config_.compose);
  scan.T_rest_lidar_t = key_->T_rest_lidar * scan.T_lidar_t_lidar_k.inverse();
  scan.other_clusters = std::exchange(key_->other_clusters, {});
  const Eigen::Matrix3d& R_level_lidar = key_->R_level_lidar;
  if (!key_->resampler) move_points(key_->scan, scan);
  put_in_axes(scan, R_level_lidar.transpose());
  watch.stop();
  if (key_->resampler) {
    const Stopwatch watch_beams(timing_, "resampling");
    std::optional<BeamResampler::OtherView> other;
    if (of_next) other.emplace(BeamResampler::OtherView{*next->resampler, *of_next});
    scan = key_->resampler->resample(std::move(scan), other ? &*other : nullptr);
    if (scan.resampling != Resampling::done) {
      put_in_axes(scan, R_level_lidar);
      move_points(key_->scan, scan);
      put_in_axes(scan, R_level_lidar.transpose());
    }
  }
  if (key_->is_sweep) scan.scan.time_s.clear();  // all are of one instant
  scan.timing = std::exchange(timing_, {});
  return scan;
}

CameraView& LidarUpsampler::view_of(const Camera& camera) {
  auto& view = views_[camera.label];
  if (!view) view = std::make_unique<CameraView>(camera);
  return *view;
}

bool LidarUpsampler::is_due(Stamp instant) const {
  if (!key_) return false;
  const double gap_s = 1e-3 * config_.timing.min_gap_ms;
  const double age_s = seconds_between(key_->scan.stamp, instant);
  if (age_s < gap_s || age_s > 1e-3 * config_.timing.max_key_age_ms) return false;
  if (expected_scans_.empty())  // live: the next scan comes when the last one's period is over
    return scan_period_s_ <= 0 || std::abs(age_s - scan_period_s_) >= gap_s;
  const auto next = std::lower_bound(expected_scans_.begin(), expected_scans_.end(), instant);
  return (next == expected_scans_.end() || seconds_between(instant, *next) >= gap_s) &&
         (next == expected_scans_.begin() || seconds_between(*std::prev(next), instant) >= gap_s);
}

void LidarUpsampler::start(CameraView& view) {
  const Stopwatch watch(timing_, "points to follow");
  start_view(view, view.of_key, {*key_, store_, track_of_}, ego_step(view.of_key->instant),
             config_);
}

void LidarUpsampler::process(CameraView& view, const Picture& picture, Effort effort) {
  const bool last_is_near =
      view.last && std::abs(seconds_between(key_->scan.stamp, view.last->instant)) <=
                       1e-3 * config_.timing.max_anchor_gap_ms;
  if (!view.of_key && last_is_near) view.of_key = view.last;
  if (!view.of_key) return;
  take_up(view.of_key.get());
  if (!view.anchor && effort == Effort::full) start(view);

  ImageResult result;
  result.stamp = picture.image.stamp;
  result.instant = picture.instant;
  result.camera = picture.image.camera;
  result.ego = ego_step(picture.instant);
  if (effort == Effort::full) {
    const KeyObjects objects{*key_, store_, track_of_};
    Stopwatch following(timing_, "point tracking");
    result.objects = follow_objects(view, picture, objects, result.ego.T_to_from, config_);
    following.stop();
    if (!result.ego.covariance.isZero(0)) {
      const Stopwatch watch(timing_, "ego-motion");
      result.ego = camera_step(view, picture, result.ego);
    }
    const Stopwatch watch(timing_, "consensus");
    note_sights(result.objects, view, picture, objects, result.ego.T_to_from, config_);
  } else {
    ++num_hurried_;
  }
  group_.push_back(std::move(result));
}

}  // namespace lidar_upsampling
