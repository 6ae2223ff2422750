// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "instant_reference.h"
#include "key_objects.h"
#include "lidar_upsampling/front_end/pose_input.h"
#include "lidar_upsampling/io/carriers.h"
#include "lidar_upsampling/io/images.h"
#include "lidar_upsampling/io/sensory_frame.h"
#include "lidar_upsampling/objects/ground.h"
#include "lidar_upsampling/registration/scan_registration.h"
#include "log_streams.h"
#include "rawlog-densify/densification.h"

namespace lidar_upsampling {

namespace {

// A virtual scan this near to a real one that the log still holds has nothing withheld to be judged
// by labels: people's labels are those of the scans.
constexpr double kAtRealScan_s = 0.015;

/// A key scan and all that is judged once for it.
struct KeyScan {
  LidarScan scan;
  std::vector<ObjectReference> objects;   ///< with their last motions
  std::vector<ObjectReference> clusters;  ///< the same without a truth, else the clusters' own
  std::optional<RegisteredMotions> motions;
};

/// Goes once through the densified log. The `paper` row's run is fed alongside, so that its virtual
/// scans come up when ours do.
class Walk {
 public:
  Walk(const EvaluationJob& job, const LogIndex& input, const LogIndex& reference,
       LogResult& result)
      : job_(job),
        result_(result),
        cameras_(calibrated_cameras(input)),
        real_stamps_(input.find(result.label, StreamKind::lidar)->stamps),
        references_(job.reference, reference_stream(reference, result.label).label,
                    reference_stream(reference, result.label).stamps, real_stamps_,
                    job.tolerance_s) {
    std::sort(real_stamps_.begin(), real_stamps_.end());
    if (references_.none_withheld())
      result_.notes.emplace_back("no scan was withheld: judged by real scans that the log holds");
    if (!job.truth_objects.empty()) truth_ = load_truth(job.truth_objects);
    if (!job.paper_row) return;
    try {
      paper_.emplace(job.paper, without_virtual(input, result.virtual_label), paper_report_);
    } catch (const std::exception& error) {
      result_.notes.push_back(std::string("no row `paper`: ") + error.what());
    }
  }

  void feed(const mrpt::obs::CObservation::Ptr& observation) {
    if (!observation) return;
    const bool is_scan = is_lidar_scan(*observation);
    if (is_scan && observation->sensorLabel == result_.virtual_label) {
      ++result_.num_virtual;
      if (auto scan = scan_from_observation(*observation))
        ours_.push_back({std::move(*scan), pictures_});
      return;
    }
    remember_picture(*observation);
    if (paper_) take(paper_->feed(observation));
    if (!is_scan || observation->sensorLabel != result_.label) return;
    judge_waiting();
    if (auto scan = scan_from_observation(*observation)) take_key(std::move(*scan));
  }

  void finish() {
    if (paper_) take(paper_->flush());
    judge_waiting();
    if (truth_) judge_by_labels();
  }

 private:
  // Judged when the next real scan comes up, and with it other pictures.
  struct Waiting {
    LidarScan scan;
    Pictured pictures;
  };

  void take(std::optional<VirtualScan> scan) {
    if (scan) papers_.push_back(std::move(scan->scan));
  }

  void remember_picture(mrpt::obs::CObservation& observation) {
    if (!job_.on_scan) return;
    if (auto* image = dynamic_cast<mrpt::obs::CObservationImage*>(&observation))
      pictures_[observation.sensorLabel] = image_from_observation(*image);
  }

  void take_key(LidarScan scan) {
    if (scan.points.empty()) return;
    const auto previous = std::exchange(key_, std::make_unique<KeyScan>());
    key_->scan = std::move(scan);
    const LidarScan& key = key_->scan;
    key_->objects = truth_ ? objects_by_truth(key, *truth_, job_.options.min_points_truth)
                           : objects_by_clusters(key);
    if (truth_) key_->clusters = objects_by_clusters(key);
    if (previous) find_last_motions(previous->scan);
    if (!truth_) key_->clusters = key_->objects;
    key_->motions.emplace(key, key_->objects, job_.options);
  }

  void find_last_motions(const LidarScan& previous) {
    const LidarScan& key = key_->scan;
    const double dt = seconds_between(previous.stamp, key.stamp);
    if (!(dt > 0)) return;
    std::optional<Pose> T_previous_key;
    if (truth_) {
      if (const auto T = true_ego_motion(*truth_, previous, key.stamp))
        T_previous_key = T->inverse();
    } else if (const auto found =
                   register_scans(key.points, previous.points, exp_se3(Twist(-dt * ego_rate_)))) {
      T_previous_key = found->T_target_source;
    }
    if (!T_previous_key) return;
    const Surface surface(without_ground(previous));
    for (auto* objects : {&key_->objects, &key_->clusters})
      lidar_upsampling::find_last_motions(*objects, key, surface, *T_previous_key, dt);
  }

  [[nodiscard]] const LidarScan* paper_at(Stamp stamp) const {
    for (const LidarScan& scan : papers_)
      if (scan.stamp == stamp) return &scan;
    return nullptr;
  }

  // Those of the present key scan: both runs have said all about it.
  void judge_waiting() {
    for (Waiting& waiting : ours_) {
      const LidarScan* paper = paper_at(waiting.scan.stamp);
      const Stamp told_at = waiting.scan.stamp;
      // The instant that the scan is of, where the settings tell that the images' stamps lie
      // beside.
      waiting.scan.stamp =
          shifted(waiting.scan.stamp, -1e-3 * job_.paper.config.timing.camera_time_offset_ms);
      if (truth_ && key_) note_labels(waiting.scan.stamp, told_at);
      judge(waiting.scan, paper, waiting.pictures);
    }
    ours_.clear();
    papers_.clear();
  }

  [[nodiscard]] bool at_real_scan(Stamp stamp) const {
    const auto near = [&](auto real) {
      return real != real_stamps_.end() && std::abs(seconds_between(*real, stamp)) < kAtRealScan_s;
    };
    const auto next = std::lower_bound(real_stamps_.begin(), real_stamps_.end(), stamp);
    return near(next) || (next != real_stamps_.begin() && near(std::prev(next)));
  }

  void note_labels(Stamp stamp, Stamp told_at) {
    std::optional<LabelledInstant> instant;
    if (!at_real_scan(stamp))
      instant = labelled_instant(*truth_, key_->scan, stamp, cameras_, job_.options.labels);
    if (!instant) {
      ++result_.num_unlabelled;
      return;
    }
    instant->told_at = told_at.time_since_epoch().count();
    const auto rows = constant_velocity_rows(key_->clusters, instant->T_lidar_k_lidar_t.inverse(),
                                             instant->dt, instant->told_at, job_.options.moving);
    constant_velocity_.insert(constant_velocity_.end(), rows.begin(), rows.end());
    instants_.push_back(std::move(*instant));
  }

  void judge_by_labels() {
    const auto judge = [this](Row row, const std::vector<ReportedObject>& told) {
      result_.labels[row] = score_labels(instants_, told, job_.options.labels);
    };
    judge(Row::ego, {});
    judge(Row::constant_velocity, constant_velocity_);
    if (paper_) judge(Row::paper, reported_objects(to_json(paper_report_)));
    if (job_.report != nullptr) judge(Row::ours, job_.report->objects);
  }

  void judge(const LidarScan& scan, const LidarScan* paper, const Pictured& pictures) {
    const double dt = key_ ? seconds_between(key_->scan.stamp, scan.stamp) : 0;
    std::optional<InstantReference> reference;
    if (dt > 0) reference = reference_at(scan.stamp);
    if (!reference) {
      ++result_.num_unmatched;
      return;
    }
    ego_rate_ = log_se3(reference->T_ego) / dt;
    keep_in_scope(*reference, key_->scan, cameras_, job_.options);
    const LidarScan real = std::move(reference->scan);
    const ScanSet scans{key_->scan, scan, real, paper};
    result_.scans.push_back(evaluate_scan(scans, std::move(*reference), cameras_, job_.options));
    if (job_.on_scan) job_.on_scan(scans, result_.scans.back(), pictures);
  }

  std::optional<InstantReference> reference_at(Stamp stamp) {
    const auto around = references_.around(stamp, key_->scan.stamp);
    if (!around) return {};
    if (truth_) return reference_by_truth(*truth_, key_->scan, key_->objects, *around, stamp);
    return reference_by_registration(*key_->motions, key_->scan, key_->objects, *around, stamp,
                                     ego_rate_);
  }

  const EvaluationJob& job_;
  LogResult& result_;
  std::vector<Camera> cameras_;
  std::vector<Stamp> real_stamps_;
  ReferenceScans references_;
  std::optional<Truth> truth_;
  DensifyReport paper_report_;
  std::optional<Densification> paper_;
  std::unique_ptr<KeyScan> key_;
  std::vector<Waiting> ours_;
  std::vector<LidarScan> papers_;
  Pictured pictures_;
  Twist ego_rate_ = Twist::Zero();  ///< per second, of the last ego-motion: the next one's guess
  std::vector<LabelledInstant> instants_;
  std::vector<ReportedObject> constant_velocity_;
};

void feed_entry(const RawlogEntry& entry, Walk& walk) {
  if (dynamic_cast<mrpt::obs::CSensoryFrame*>(entry.object.get()) == nullptr) {
    walk.feed(std::dynamic_pointer_cast<mrpt::obs::CObservation>(entry.object));
    return;
  }
  for (const RawlogEntry& part : split_frame(entry))
    walk.feed(std::dynamic_pointer_cast<mrpt::obs::CObservation>(part.object));
}

}  // namespace

LogResult evaluate_log(const EvaluationJob& job, const std::function<void(double)>& progress) {
  LogIndex input = whole_index(job.input);
  const LogIndex reference = whole_index(job.reference);
  take_poses_from_file(job.paper.config, job.paper.rig, input);
  LogResult result;
  result.input = job.input;
  result.reference = job.reference;
  result.label = find_label(input, job.label);
  result.virtual_label = result.label + kVirtualEnding;
  result.tolerance_s = job.tolerance_s;
  result.has_truth = !job.truth_objects.empty();
  if (job.options.protocol) result.protocol = job.options.protocol->name;
  Walk walk(job, input, reference, result);
  RawlogReader reader(job.input);
  while (const auto entry = reader.next()) {
    feed_entry(*entry, walk);
    progress(reader.progress());
  }
  walk.finish();
  if (result.scans.empty())
    throw std::runtime_error(job.reference + ": none of its scans lies within " +
                             std::to_string(job.tolerance_s * 1e3) + " ms of one of the " +
                             std::to_string(result.num_virtual) + " virtual scans of " + job.input);
  return result;
}

}  // namespace lidar_upsampling
