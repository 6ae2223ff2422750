// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

#include "key_scans.h"
#include "label_judge.h"
#include "lidar_upsampling/front_end/usable_observations.h"
#include "lidar_upsampling/io/carriers.h"
#include "lidar_upsampling/io/sensory_frame.h"
#include "log_streams.h"
#include "rawlog-densify/densification.h"
#include "rawlog-densify/ego_ahead.h"
#include "rawlog-densify/log_ahead.h"
#include "scan_queue.h"
#include "straight_scans.h"

namespace lidar_upsampling {

namespace {

/// By the log's first two scans.
void start(StraightScans& straight, const LogFile& log, const std::string& label) {
  ScanFeed scans(log, [&label](const std::string& of_scan, Stamp) { return of_scan == label; });
  const auto first = scans.next();
  const auto second = first ? scans.next() : std::nullopt;
  if (second) straight.start_with(*first, *second);
}

/// Goes once through the densified log. The `paper` row's run is fed alongside, so that its virtual
/// scans come up when ours do.
class Walk {
 public:
  Walk(const EvaluationJob& job, const LogIndices& indices, LogResult& result)
      : job_(job),
        result_(result),
        cameras_(calibrated_cameras(indices.input)),
        queue_(job_, cameras_, result_.scans) {
    const std::vector<Stamp>& real = indices.input.find(result.label, StreamKind::lidar)->stamps;
    if (!job.truth_objects.empty()) {
      truth_ = load_truth(job.truth_objects);
      for (const std::string& warning : truth_->warnings)
        result_.notes.push_back(job.truth_objects + ": " + warning);
      labels_.emplace(*truth_, job_.options, cameras_, real);
    }
    const Truth* truth = truth_ ? &*truth_ : nullptr;
    straight_.emplace(job.paper.config.sweep, real, truth);
    if (!truth_) start(*straight_, LogFile(job.input, job.accept_truncated), result.label);
    if (indices.reference) {
      const StreamInfo& stream = reference_stream(*indices.reference, result.label);
      const LogFile log(job.reference, job.accept_truncated);
      StraightScans straight(job.paper.config.sweep, stream.stamps, truth);
      if (!truth_) start(straight, log, stream.label);
      references_.emplace(log, stream.label, stream.stamps, real, job.tolerance_s,
                          std::move(straight));
      if (references_->none_withheld())
        result_.notes.emplace_back("no scan was withheld: judged by real scans that the log holds");
    }
    keys_.emplace(job_.options, cameras_, truth, references_ ? &*references_ : nullptr);
    if (!job.paper_row) return;
    try {
      paper_.emplace(job.paper, without_virtual(indices.input, result.virtual_label),
                     paper_report_);
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
    keys_->take(straight_->straight(std::move(scan)));
    if (labels_) labels_->take_key(*keys_->scan(), keys_->last_motions());
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
      for_each_object(paper_report_, [&](const nlohmann::json& row, bool in_view) {
        told.push_back(reported_object(row, in_view));
      });
      result_.labels[Row::paper] = labels_->score(told);
    }
    if (job_.report != nullptr) {
      std::vector<ReportedObject> told = job_.report->objects;
      told.insert(told.end(), job_.report->out_of_view.begin(), job_.report->out_of_view.end());
      result_.labels[Row::ours] = labels_->score(told);
    }
  }

  void judge(Waiting& waiting, std::optional<LidarScan> paper) {
    std::optional<InstantReference> reference = keys_->reference_at(waiting.scan.stamp);
    if (!reference) {
      ++result_.num_unmatched;
      return;
    }
    queue_.add({keys_->scan(), std::move(waiting.scan), std::move(paper), std::move(*reference),
                std::move(waiting.pictures)});
  }

  const EvaluationJob& job_;
  LogResult& result_;
  std::vector<Camera> cameras_;
  std::optional<ReferenceScans> references_;  ///< none: by labels alone
  std::optional<Truth> truth_;
  std::optional<LabelJudge> labels_;
  std::optional<StraightScans> straight_;  ///< of the densified log
  std::optional<KeyScans> keys_;
  DensifyReport paper_report_;
  std::optional<Densification> paper_;
  std::vector<Waiting> ours_;
  std::vector<LidarScan> papers_;
  Pictured pictures_;
  UnusedCounts unused_;
  UsableObservations usable_{counted_in(unused_)};
  ScanQueue queue_;
};

void feed_entry(const RawlogEntry& entry, Walk& walk) {
  if (dynamic_cast<mrpt::obs::CSensoryFrame*>(entry.object.get()) == nullptr) {
    walk.feed(std::dynamic_pointer_cast<mrpt::obs::CObservation>(entry.object));
    return;
  }
  for (const RawlogEntry& part : split_frame(entry))
    walk.feed(std::dynamic_pointer_cast<mrpt::obs::CObservation>(part.object));
}

/// Of what is known before the log goes by.
LogResult begun(const EvaluationJob& job, const LogIndices& indices) {
  LogResult result;
  result.scans = ScanResults(job.scratch_beside);
  result.input = job.input;
  result.reference = job.reference;
  const ScanLabels labels = find_labels(indices.input, job.label, job.paper.config);
  result.label = labels.real;
  result.virtual_label = labels.dense;
  result.tolerance_s = job.tolerance_s;
  result.has_truth = !job.truth_objects.empty();
  if (job.options.protocol) result.protocol = job.options.protocol->name;
  for (const LogIndex* index : {&indices.input, indices.reference ? &*indices.reference : nullptr})
    if (index != nullptr && index->corruption) result.notes.push_back(*index->corruption);
  return result;
}

}  // namespace

LogResult evaluate_log(const EvaluationJob& job, const std::function<void(double)>& progress) {
  LogIndices indices = index_logs(job);
  LogResult result = begun(job, indices);
  const bool by_labels_alone = !indices.reference;
  const bool looks_ahead = indices.ego_goes_by && job.paper_row;
  Walk walk(job, indices, result);
  const std::set<std::string> awaited = streams_ahead(indices.input);
  indices = {};  // of an hour some megabytes
  LogAhead log({job.input, job.accept_truncated}, looks_ahead ? span_ahead_s(job.paper.config) : 0);
  if (looks_ahead) log.wait_for(awaited, kLate_s);
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
