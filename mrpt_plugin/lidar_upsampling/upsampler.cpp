// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/upsampler.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lidar_upsampling/camera_view.h"
#include "lidar_upsampling/key_scan.h"
#include "lidar_upsampling/next_view.h"
#include "lidar_upsampling/objects/beam_step.h"
#include "lidar_upsampling/se3.h"
#include "lidar_upsampling/stopwatch.h"

namespace lidar_upsampling {

namespace {

double ms_between(Stamp a, Stamp b) { return std::abs(seconds_between(a, b)) * 1e3; }

// One camera's estimate, brought to the group's instant at constant velocity.
ObjectMotion brought_to(const ImageResult& newest, const ImageResult& result, ObjectMotion object,
                        Stamp key) {
  const double own = seconds_between(key, result.instant);
  const double wanted = seconds_between(key, newest.instant);
  if (own == wanted) return object;
  object.T_mov = exp_se3(Twist(log_se3(object.T_mov) * (wanted / own)));
  object.T_lidar_t_lidar_k = newest.ego.T_to_from * object.T_mov;
  return object;
}

std::shared_ptr<const Picture> make_picture(const CameraImage& image, Stamp instant,
                                            const KltOptions& options,
                                            std::vector<StageTime>& timing) {
  const Stopwatch watch(timing, "image pyramid");
  return std::make_shared<Picture>(Picture{image, instant, ImagePyramid(image.gray, options)});
}

}  // namespace

LidarUpsampler::LidarUpsampler(const Config& config)
    : config_(config),
      ego_motion_(config.ego_motion),
      detector_(make_detector(config.detector)),
      track_options_(config.track_options()) {}

LidarUpsampler::~LidarUpsampler() = default;

void LidarUpsampler::expect_cameras(const std::vector<std::string>& labels) {
  expected_cameras_ = labels.size();
}

std::optional<VirtualScan> LidarUpsampler::insert_scan(LidarScan scan) {
  auto waiting = flush();
  if (key_ && scan.stamp <= key_->scan.stamp) return waiting;  // out of order: of no use any more
  if (key_ && config_.tracks_in_world()) find_objects(nullptr, nullptr);
  auto key = std::make_unique<KeyScan>();
  const bool is_next = next_ && next_->stamp == scan.stamp;
  const Pose T_scan_key = take_up(scan, is_next ? &next_->T_lidar_next_lidar_k : nullptr);
  if (key_) {
    key->T_rest_lidar_k = key_->T_rest_lidar_k * T_scan_key.inverse();
    key->step_covariance = step_covariance_;
    scan_period_s_ = seconds_between(key_->scan.stamp, scan.stamp);
    key->seen_before = std::move(key_->seen);
    key->stamp_before = key_->scan.stamp;
  }
  key->scan = std::move(scan);
  // Points that were measured at one instant are those that were looked at as the next scan's.
  if (is_next && next_view_ && config_.sweep.scan_time == ScanTime::none) {
    key->segments = std::move(next_view_->segments);
    key->resampler = std::move(next_view_->resampler);
    key->seen = std::make_unique<const SeenSpace>(std::move(next_->seen));
  }
  key_ = std::move(key);
  if (found_) found_->push_back({key_->scan.stamp, key_->T_rest_lidar_k, {}});
  movers_.clear();
  if (!key_->seen) {
    const Stopwatch watch(timing_, "seen space");
    key_->seen = std::make_unique<const SeenSpace>(key_->scan.points,
                                                   estimate_vertical_step_deg(key_->scan));
  }
  if (config_.resample == "beam" && !key_->resampler) {
    const Stopwatch watch(timing_, "beams");
    key_->resampler = std::make_unique<const BeamResampler>(key_->scan, config_.resampling);
  }
  next_.reset();
  next_view_.reset();
  for (auto& [label, view] : views_) view->anchor.reset();
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
  if (key_ && is_key_image(instant))
    start(view, picture);
  else if (is_due(instant))
    process(view, *picture, effort);
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
  for (const ImageResult& result : group) {
    motion.cameras.push_back(result.camera);
    for (const ObjectMotion& object : result.objects)
      motion.objects.push_back(brought_to(newest, result, object, key_->scan.stamp));
  }
  if (config_.tracks_in_world()) {
    const Stopwatch watch(timing_, "object motion");
    motion.objects = tracked_motions(group, newest);
  } else {
    learn(motion.objects, newest.instant);
    if (found_) keep(motion.objects, newest.instant);
  }

  Stopwatch watch(timing_, "composition");
  std::optional<VirtualScan> of_next;
  if (next_view_ && next_view_->resampler)
    of_next = compose_virtual_scan(next_view_->scan,
                                   motion_of_next(*next_view_, motion, key_->scan, *key_->seen), {},
                                   config_.compose);
  VirtualScan scan = compose_virtual_scan(key_->scan, std::move(motion),
                                          config_.virtual_label(key_->scan.label), config_.compose);
  watch.stop();
  if (key_->resampler) {
    const Stopwatch watch_beams(timing_, "resampling");
    if (of_next) {
      const BeamResampler::OtherView other{*next_view_->resampler, *of_next};
      scan = key_->resampler->resample(std::move(scan), &other);
    } else {
      scan = key_->resampler->resample(std::move(scan));
    }
  }
  if (config_.sweep.scan_time != ScanTime::none)
    scan.scan.time_s.clear();  // all are of one instant
  scan.T_rest_lidar_t = key_->T_rest_lidar_k * scan.T_lidar_t_lidar_k.inverse();
  scan.timing = std::exchange(timing_, {});
  return scan;
}

CameraView& LidarUpsampler::view_of(const Camera& camera) {
  auto& view = views_[camera.label];
  if (!view) view = std::make_unique<CameraView>(camera, config_.tracks, next_track_id_);
  return *view;
}

bool LidarUpsampler::is_key_image(Stamp instant) const {
  return ms_between(key_->scan.stamp, instant) <= config_.timing.pair_tolerance_ms;
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

void LidarUpsampler::start(CameraView& view, const std::shared_ptr<const Picture>& anchor) {
  if (!key_->segments) {
    const Stopwatch watch(timing_, "ground and clusters");
    key_->segments = segment_scan(key_->scan, config_.segments);
  }
  if (config_.tracks_in_world()) {
    start_tracked(view, anchor);
    return;
  }
  const Stopwatch watch(timing_, "candidates");
  const EgoStep ego = ego_step(anchor->instant);
  const auto expected = movers_of_later_scans(
      history_, key_->scan.stamp, key_->T_rest_lidar_k.linear(), config_.object_motion.prior);
  start_view(view, anchor,
             {key_->scan, *key_->segments, *key_->seen, key_->T_rest_lidar_k,
              key_->seen_before.get(), key_->stamp_before, next_.get(), expected},
             ego.T_to_from, known_motions_, !ego.covariance.isZero(0), *detector_, config_);
  // Where neither the next picture nor the next scan tells, this is what there is.
  for (const Candidate& candidate : view.candidates)
    if (candidate.known) known_motions_[candidate.track_id] = *candidate.known;
}

void LidarUpsampler::process(CameraView& view, const Picture& picture, Effort effort) {
  const bool anchor_is_near =
      view.last && std::abs(seconds_between(key_->scan.stamp, view.last->instant)) <=
                       1e-3 * config_.timing.max_anchor_gap_ms;
  if (!view.anchor && !anchor_is_near) return;
  if (!view.anchor) start(view, view.last);

  ImageResult result;
  result.stamp = picture.image.stamp;
  result.instant = picture.instant;
  result.camera = picture.image.camera;
  result.ego = ego_step(picture.instant);
  const bool looks = effort == Effort::full;
  if (config_.tracks_in_world()) {
    if (looks) follow_tracked(view, picture, result);
    group_.push_back(std::move(result));
    return;
  }
  if (looks) {
    const Stopwatch watch(timing_, "point tracking");
    follow_view(view, picture, key_->scan, result.ego.T_to_from, config_);
  }
  if (looks && !result.ego.covariance.isZero(0)) {
    const Stopwatch watch(timing_, "ego-motion");
    result.ego = camera_step(view, picture, result.ego);
  }
  {
    const Stopwatch watch(timing_, "object motion");
    result.objects = estimate_motions(view, picture, looks, key_->scan, result.ego.T_to_from,
                                      next_.get(), config_);
  }
  for (const Candidate& candidate : view.candidates)
    if (candidate.at_next) known_motions_[candidate.track_id] = *candidate.at_next;
  group_.push_back(std::move(result));
}

void LidarUpsampler::learn(const std::vector<ObjectMotion>& objects, Stamp instant) {
  for (const ObjectMotion& object : objects) {
    if (object.status != MotionStatus::moving && object.status != MotionStatus::stationary)
      continue;
    KnownMotion& known = known_motions_[object.track_id];
    if (known.travel && known.stamp > instant) continue;
    known = known_at(object, instant);
  }
  constexpr double kForgetAfter_s = 2;
  for (auto motion = known_motions_.begin(); motion != known_motions_.end();)
    motion = seconds_between(motion->second.stamp, instant) > kForgetAfter_s
                 ? known_motions_.erase(motion)
                 : std::next(motion);
}

KnownMotion LidarUpsampler::known_at(const ObjectMotion& object, Stamp instant) const {
  return known_from(object, key_->scan.stamp, seconds_between(key_->scan.stamp, instant),
                    key_->T_rest_lidar_k.linear());
}

}  // namespace lidar_upsampling
