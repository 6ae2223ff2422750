// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/rtti/CObject.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "instant_reference.h"
#include "key_objects.h"
#include "label_judge.h"
#include "lidar_upsampling/front_end/pose_input.h"
#include "lidar_upsampling/front_end/usable_observations.h"
#include "lidar_upsampling/io/carriers.h"
#include "lidar_upsampling/io/sensory_frame.h"
#include "lidar_upsampling/objects/ground.h"
#include "lidar_upsampling/registration/scan_registration.h"
#include "log_streams.h"
#include "rawlog-densify/densification.h"
#include "rawlog-densify/ego_ahead.h"
#include "rawlog-densify/log_ahead.h"
#include "scan_queue.h"

namespace lidar_upsampling {

namespace {

/// A key scan and all that is judged once for it.
struct KeyScan {
  LidarScan scan;
  std::vector<ObjectReference> objects;
  std::optional<RegisteredMotions> motions;
  std::optional<LastMotions> last_motions;  ///< none without a scan before
};

/// Goes once through the densified log. The `paper` row's run is fed alongside, so that its virtual
/// scans come up when ours do.
class Walk {
 public:
  /// @param reference null: by labels alone.
  Walk(const EvaluationJob& job, const LogIndex& input, const LogIndex* reference,
       LogResult& result)
      : job_(job),
        result_(result),
        cameras_(calibrated_cameras(input)),
        queue_(job_, cameras_, result_.scans) {
    const std::vector<Stamp>& real = input.find(result.label, StreamKind::lidar)->stamps;
    if (reference != nullptr) {
      const StreamInfo& stream = reference_stream(*reference, result.label);
      references_.emplace(LogFile(job.reference, job.accept_truncated), stream.label, stream.stamps,
                          real, job.tolerance_s);
      if (references_->none_withheld())
        result_.notes.emplace_back("no scan was withheld: judged by real scans that the log holds");
    }
    if (!job.truth_objects.empty()) {
      truth_ = load_truth(job.truth_objects);
      for (const std::string& warning : truth_->warnings)
        result_.notes.push_back(job.truth_objects + ": " + warning);
      labels_.emplace(*truth_, job_.options, cameras_, real);
    }
    if (!job.paper_row) return;
    try {
      paper_.emplace(job.paper, without_virtual(input, result.virtual_label), paper_report_);
      if (labels_)
        paper_report_.rows = std::make_shared<ReportRows>(scratch_place(job.scratch_beside));
    } catch (const std::exception& error) {
      result_.notes.push_back(std::string("no row `paper`: ") + error.what());
    }
  }

  /// What there is of the vehicle's motion, ahead of its turn.
  void take(const EgoNews& news) {
    if (paper_) paper_->go_on_by(news);
  }

  void feed(const mrpt::obs::CObservation::Ptr& observation) {
    if (!observation) return;
    const bool is_scan = is_lidar_scan(*observation);
    if (is_scan && observation->sensorLabel == result_.virtual_label) {
      ++result_.num_virtual;
      if (auto scan = usable_.scan(*observation)) ours_.push_back({std::move(*scan), pictures_});
      return;
    }
    remember_picture(*observation);
    if (paper_) take(paper_->feed(observation));
    if (!is_scan || observation->sensorLabel != result_.label) return;
    judge_waiting();
    if (auto scan = usable_.scan(*observation)) take_key(std::move(*scan));
  }

  void finish() {
    if (paper_) take(paper_->flush());
    judge_waiting();
    queue_.finish();
    for (const auto& count : unused_) result_.notes.push_back(to_text(count));
    if (labels_) judge_by_labels();
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
    if (const auto* image = dynamic_cast<const mrpt::obs::CObservationImage*>(&observation))
      if (auto picture = usable_.image(*image))
        pictures_[observation.sensorLabel] = std::move(*picture);
  }

  void take_key(LidarScan scan) {
    const auto previous = std::exchange(key_, std::make_shared<KeyScan>());
    key_->scan = std::move(scan);
    const LidarScan& key = key_->scan;
    if (references_) {
      key_->objects = truth_ ? objects_by_truth(key, *truth_, job_.options.min_points_truth)
                             : objects_by_clusters(key);
      key_->motions.emplace(key, key_->objects, job_.options);
    }
    if (previous) prepare_last_motions(previous->scan);
    if (labels_) labels_->take_key(key, key_->last_motions ? &*key_->last_motions : nullptr);
  }

  void prepare_last_motions(const LidarScan& previous) {
    const double dt = seconds_between(previous.stamp, key_->scan.stamp);
    if (!(dt > 0)) return;
    if (const auto T_previous_key = ego_motion_back_to(previous))
      key_->last_motions.emplace(previous, *T_previous_key, dt);
  }

  [[nodiscard]] std::optional<Pose> ego_motion_back_to(const LidarScan& previous) const {
    const LidarScan& key = key_->scan;
    if (truth_) {
      const auto T = true_ego_motion(*truth_, previous, key.stamp);
      return T ? std::make_optional(T->inverse()) : std::nullopt;
    }
    const double dt = seconds_between(previous.stamp, key.stamp);
    const auto found = register_scans(key.points, previous.points, exp_se3(Twist(-dt * ego_rate_)));
    return found ? std::make_optional(found->T_target_source) : std::nullopt;
  }

  [[nodiscard]] std::optional<LidarScan> paper_at(Stamp stamp) {
    for (LidarScan& scan : papers_)
      if (scan.stamp == stamp) return std::move(scan);
    return {};
  }

  // Those of the present key scan: both runs have said all about it.
  void judge_waiting() {
    for (Waiting& waiting : ours_) {
      std::optional<LidarScan> paper = paper_at(waiting.scan.stamp);
      const Stamp told_at = waiting.scan.stamp;
      // The instant that the scan is of, where the settings tell that the images' stamps lie
      // beside.
      waiting.scan.stamp =
          shifted(waiting.scan.stamp, -1e-3 * job_.paper.config.timing.camera_time_offset_ms);
      if (labels_) labels_->note(waiting.scan.stamp, told_at);
      if (references_) judge(waiting, std::move(paper));
    }
    ours_.clear();
    papers_.clear();
  }

  void judge_by_labels() {
    result_.num_unlabelled = labels_->num_unlabelled();
    if (labels_->num_noted() == 0) {
      result_.notes.push_back("no row by labels: " + job_.truth_objects +
                              " tells of none of the virtual scans' instants");
      return;
    }
    result_.labels[Row::ego] = labels_->score({});
    result_.labels[Row::constant_velocity] = labels_->score(labels_->constant_velocity());
    if (paper_) {
      std::vector<ReportedObject> told;
      for_each_object(paper_report_,
                      [&](const nlohmann::json& row) { told.push_back(reported_object(row)); });
      result_.labels[Row::paper] = labels_->score(told);
    }
    if (job_.report != nullptr) result_.labels[Row::ours] = labels_->score(job_.report->objects);
  }

  void judge(Waiting& waiting, std::optional<LidarScan> paper) {
    const LidarScan& scan = waiting.scan;
    const double dt = key_ ? seconds_between(key_->scan.stamp, scan.stamp) : 0;
    std::optional<InstantReference> reference;
    if (dt > 0) reference = reference_at(scan.stamp);
    if (!reference) {
      ++result_.num_unmatched;
      return;
    }
    ego_rate_ = log_se3(reference->T_ego) / dt;
    if (key_->last_motions) {
      key_->last_motions->find(key_->objects, reference->indices, key_->scan);
      for (std::size_t i = 0; i < reference->indices.size(); ++i)
        reference->objects[i].last_motion = key_->objects[reference->indices[i]].last_motion;
    }
    queue_.add({std::shared_ptr<const LidarScan>(key_, &key_->scan), std::move(waiting.scan),
                std::move(paper), std::move(*reference), std::move(waiting.pictures)});
  }

  std::optional<InstantReference> reference_at(Stamp stamp) {
    const auto around = references_->around(stamp, key_->scan.stamp);
    if (!around) return {};
    const InstantRequest request{key_->scan, key_->objects, *around, stamp, cameras_, job_.options};
    return truth_ ? reference_by_truth(*truth_, request)
                  : reference_by_registration(*key_->motions, request, ego_rate_);
  }

  const EvaluationJob& job_;
  LogResult& result_;
  std::vector<Camera> cameras_;
  std::optional<ReferenceScans> references_;  ///< none: by labels alone
  std::optional<Truth> truth_;
  std::optional<LabelJudge> labels_;
  DensifyReport paper_report_;
  std::optional<Densification> paper_;
  std::shared_ptr<KeyScan> key_;
  std::vector<Waiting> ours_;
  std::vector<LidarScan> papers_;
  Pictured pictures_;
  UnusedCounts unused_;
  UsableObservations usable_{counted_in(unused_)};
  ScanQueue queue_;
  Twist ego_rate_ = Twist::Zero();  ///< per second, of the last ego-motion: the next one's guess
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
  LogIndex input;
  std::optional<LogIndex> reference;
  bool goes_by = true;                      // the vehicle's motion, beside the log
  mrpt::rtti::registerAllPendingClasses();  // not by two threads at a time
  tbb::parallel_invoke(
      [&] {
        const LogFile log{job.input, job.accept_truncated};
        input = index_streams(log);
        goes_by = !job.paper_row || ego_goes_by(job.paper.config, input);
        if (!goes_by) input = index_log(log);
      },
      [&] {
        if (!job.reference.empty())
          reference = index_streams({job.reference, job.accept_truncated});
      });
  take_poses_from_file(job.paper.config, job.paper.rig, input);
  LogResult result;
  result.scans = ScanResults(job.scratch_beside);
  result.input = job.input;
  result.reference = job.reference;
  result.label = find_label(input, job.label);
  result.virtual_label = result.label + kVirtualEnding;
  result.tolerance_s = job.tolerance_s;
  result.has_truth = !job.truth_objects.empty();
  if (job.options.protocol) result.protocol = job.options.protocol->name;
  if (input.corruption) result.notes.push_back(*input.corruption);
  if (reference && reference->corruption) result.notes.push_back(*reference->corruption);
  Walk walk(job, input, reference ? &*reference : nullptr, result);
  input = LogIndex();  // of an hour some megabytes
  const bool by_labels_alone = !reference;
  reference.reset();
  const bool looks_ahead = goes_by && job.paper_row;
  LogAhead log({job.input, job.accept_truncated}, looks_ahead ? span_ahead_s(job.paper.config) : 0);
  for (;;) {
    while (!log.is_full() && log.read_on() != nullptr) {
      const EgoNews news = log.indexer().take_ego();
      if (looks_ahead) walk.take(news);
    }
    const auto entry = log.next();
    if (!entry) break;
    feed_entry(*entry, walk);
    progress(log.progress());
  }
  walk.finish();
  if (result.scans.empty() && !by_labels_alone)
    throw std::runtime_error(job.reference + ": none of its scans lies within " +
                             std::to_string(job.tolerance_s * 1e3) + " ms of one of the " +
                             std::to_string(result.num_virtual) + " virtual scans of " + job.input);
  return result;
}

}  // namespace lidar_upsampling
