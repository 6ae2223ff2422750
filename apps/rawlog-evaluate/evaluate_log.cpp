// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "evaluation.h"
#include "lidar_upsampling/front_end/pose_input.h"
#include "lidar_upsampling/io/carriers.h"
#include "lidar_upsampling/io/images.h"
#include "lidar_upsampling/io/log_index.h"
#include "lidar_upsampling/io/sensory_frame.h"
#include "lidar_upsampling/registration/scan_registration.h"
#include "lidar_upsampling/se3.h"
#include "rawlog-densify/densification.h"
#include "scan_feed.h"

namespace lidar_upsampling {

namespace {

const std::string kEnding = "_VIRTUAL";

bool is_virtual(const std::string& label) {
  return label.size() > kEnding.size() &&
         label.compare(label.size() - kEnding.size(), kEnding.size(), kEnding) == 0;
}

/// The LiDAR whose virtual scans the log holds.
std::string find_label(const LogIndex& input, const std::string& wanted) {
  for (const StreamInfo* stream : input.of_kind(StreamKind::lidar)) {
    if (!is_virtual(stream->label)) continue;
    std::string real = stream->label.substr(0, stream->label.size() - kEnding.size());
    if (wanted.empty() || wanted == real) return real;
  }
  throw std::runtime_error(input.path + ": holds no virtual scans (label " +
                           (wanted.empty() ? "..." : wanted) + kEnding +
                           "); densify it with rawlog-densify. It holds " + labels_of(input));
}

const StreamInfo& reference_stream(const LogIndex& reference, const std::string& label) {
  if (const StreamInfo* same = reference.find(label, StreamKind::lidar)) return *same;
  const auto lidars = reference.of_kind(StreamKind::lidar);
  if (lidars.size() == 1) return *lidars.front();
  throw std::runtime_error(reference.path + ": holds no LiDAR scans with label " + label +
                           ". It holds " + labels_of(reference));
}

std::vector<Camera> calibrated_cameras(const LogIndex& index) {
  std::vector<Camera> cameras;
  for (const StreamInfo* stream : index.of_kind(StreamKind::camera))
    if (stream->calibrated()) cameras.push_back(*stream->camera);
  return cameras;
}

LogIndex whole_index(const std::string& path) {
  LogIndex index = index_log(path);
  if (index.corruption) throw std::runtime_error(*index.corruption);
  return index;
}

/// The log as it was before it was densified.
LogIndex without_virtual(LogIndex index, const std::string& virtual_label) {
  auto& streams = index.streams;
  streams.erase(std::remove_if(streams.begin(), streams.end(),
                               [&](const StreamInfo& s) { return s.label == virtual_label; }),
                streams.end());
  return index;
}

/// Goes once through the densified log. The `paper` row's run is fed alongside, so that its virtual
/// scans come up when ours do.
class Walk {
 public:
  Walk(const EvaluationJob& job, const LogIndex& input, const LogIndex& reference,
       LogResult& result)
      : job_(job),
        result_(result),
        cameras_(calibrated_cameras(input)),
        references_(job.reference, reference_stream(reference, result.label).label,
                    reference_stream(reference, result.label).stamps, job.tolerance_s) {
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
    previous_ = std::exchange(key_, std::move(scan));
    T_previous_key_.reset();
    if (!previous_) return;
    if (truth_) {
      if (const auto T = true_ego_motion(*truth_, *previous_, key_->stamp))
        T_previous_key_ = T->inverse();
      return;
    }
    const Pose guess = exp_se3(Twist(-ego_rate_ * seconds_between(previous_->stamp, key_->stamp)));
    if (const auto found = register_scans(key_->points, previous_->points, guess))
      T_previous_key_ = found->T_target_source;
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
      // The instant that the scan is of, where the settings tell that the images' stamps lie
      // beside.
      waiting.scan.stamp =
          shifted(waiting.scan.stamp, -1e-3 * job_.paper.config.timing.camera_time_offset_ms);
      judge(waiting.scan, paper, waiting.pictures);
    }
    ours_.clear();
    papers_.clear();
  }

  void judge(const LidarScan& scan, const LidarScan* paper, const Pictured& pictures) {
    const LidarScan* match = key_ ? references_.nearest(scan.stamp) : nullptr;
    const double dt = match ? seconds_between(key_->stamp, scan.stamp) : 0;
    if (!match || !(dt > 0) || !(match->stamp > key_->stamp)) {
      ++result_.num_unmatched;
      return;
    }
    std::optional<LidarScan> timed;
    if (truth_ && match->stamp != scan.stamp) timed = brought_to(*truth_, *match, scan.stamp);
    ScanSet scans{*key_, scan, timed ? *timed : *match, nullptr, T_previous_key_, paper};
    if (previous_ && T_previous_key_) scans.previous = &*previous_;
    Pose T_ego = exp_se3(Twist(ego_rate_ * dt));
    result_.scans.push_back(
        evaluate_scan(scans, truth_ ? &*truth_ : nullptr, cameras_, T_ego, job_.options, &T_ego));
    ego_rate_ = log_se3(T_ego) / dt;
    if (job_.on_scan) job_.on_scan(scans, result_.scans.back(), pictures);
  }

  const EvaluationJob& job_;
  LogResult& result_;
  std::vector<Camera> cameras_;
  ReferenceScans references_;
  std::optional<Truth> truth_;
  DensifyReport paper_report_;
  std::optional<Densification> paper_;
  std::optional<LidarScan> previous_, key_;
  std::optional<Pose> T_previous_key_;
  std::vector<Waiting> ours_;
  std::vector<LidarScan> papers_;
  Pictured pictures_;
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
  LogIndex input = whole_index(job.input);
  const LogIndex reference = whole_index(job.reference);
  take_poses_from_file(job.paper.config, job.paper.rig, input);
  LogResult result;
  result.input = job.input;
  result.reference = job.reference;
  result.label = find_label(input, job.label);
  result.virtual_label = result.label + kEnding;
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
