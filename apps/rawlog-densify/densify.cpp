// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "densify.h"

#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "lidar_upsampling/io/carriers.h"
#include "lidar_upsampling/io/external_storage.h"
#include "lidar_upsampling/io/images.h"
#include "lidar_upsampling/io/log_index.h"
#include "lidar_upsampling/io/rawlog_stream.h"
#include "lidar_upsampling/io/sensory_frame.h"
#include "lidar_upsampling/upsampler.h"
#include "pictures.h"
#include "streams.h"

namespace lidar_upsampling {
namespace {

using mrpt::obs::CObservation;
using mrpt::obs::CObservationImage;

std::vector<std::string> labels_of_overrides(const RigOverrides& rig) {
  std::vector<std::string> labels;
  for (const auto& [label, camera] : rig.cameras)
    if (camera.fx && camera.fy && camera.cx && camera.cy) labels.push_back(label);
  return labels;
}

// What goes out around one observation of the log.
struct Neighbours {
  std::vector<CObservation::Ptr> before, after;
};

/// One run: the observations of the log go through `feed` one by one.
class Densification {
 public:
  Densification(const DensifyJob& job, const LogIndex& index, DensifyReport& report)
      : job_(job),
        report_(report),
        upsampler_(job.config),
        carrier_(carrier_from_string(job.config.carrier)) {
    const StreamSelection streams = select_streams(index, job.config, labels_of_overrides(job.rig));
    lidar_label_ = streams.lidar->label;
    std::vector<std::string> labels;
    for (const StreamInfo* camera : streams.cameras) labels.push_back(camera->label);
    camera_labels_ = {labels.begin(), labels.end()};
    upsampler_.expect_scans(streams.lidar->stamps);
    upsampler_.expect_cameras(labels);
    for (const PoseSample& sample : index.poses) upsampler_.ego_motion().add_pose(sample);
    for (const PoseSample& sample : index.odometry) upsampler_.ego_motion().add_odometry(sample);
    for (const GnssSample& sample : index.gnss) upsampler_.ego_motion().add_gnss(sample);
    report.ego_source = to_string(upsampler_.ego_motion().source());
    if (!job.pictures.empty()) pictures_.emplace(job.pictures);
  }

  Neighbours feed(const CObservation::Ptr& entry) {
    Neighbours result;
    if (!entry) return result;
    CObservation& observation = *entry;
    std::optional<VirtualScan> scan;
    if (observation.sensorLabel == lidar_label_ && is_lidar_scan(observation))
      scan = feed_scan(entry);
    else if (camera_labels_.count(observation.sensorLabel) > 0)
      scan = feed_image(observation);
    if (scan) {
      auto& side = scan->scan.stamp < observation.timestamp ? result.before : result.after;
      side.push_back(out(std::move(*scan)));
    }
    return result;
  }

  CObservation::Ptr flush() {
    auto scan = upsampler_.flush();
    return scan ? out(std::move(*scan)) : nullptr;
  }

 private:
  std::optional<VirtualScan> feed_scan(const CObservation::Ptr& observation) {
    ++report_.num_scans;
    last_real_ = observation;
    std::optional<LidarScan> scan;
    try {
      scan = scan_from_observation(*observation);
    } catch (const std::runtime_error& error) {
      report_.warn(std::string("a scan was left out: ") + error.what());
      return {};
    }
    if (scan->points.empty()) {
      report_.warn("a scan without points was left out");
      return {};
    }
    apply(job_.rig, *scan);
    if (pictures_) pictures_->real_scan(*scan);
    return upsampler_.insert_scan(std::move(*scan));
  }

  std::optional<VirtualScan> feed_image(CObservation& observation) {
    auto* image_observation = dynamic_cast<CObservationImage*>(&observation);
    if (image_observation == nullptr) return {};
    ++report_.num_images;
    CameraImage image;
    try {
      image = image_from_observation(*image_observation);
    } catch (const std::runtime_error& error) {
      report_.warn(std::string("an image was left out: ") + error.what());
      return {};
    }
    apply(job_.rig, image.camera);
    if (pictures_) pictures_->image(image);
    return upsampler_.insert_image(image);
  }

  CObservation::Ptr out(VirtualScan scan) {
    report_.add(scan, job_.keep_rows);
    if (pictures_) pictures_->virtual_scan(scan);
    auto observation = observation_from_scan(scan.scan, carrier_, last_real_.get());
    if (report_.carrier.empty()) report_.carrier = observation->GetRuntimeClass()->className;
    return observation;
  }

  const DensifyJob& job_;
  DensifyReport& report_;
  LidarUpsampler upsampler_;
  Carrier carrier_;
  CObservation::Ptr last_real_;
  std::string lidar_label_;
  std::set<std::string> camera_labels_;
  std::optional<Pictures> pictures_;
};

// Virtual scans go inside the frame that holds their image: MRPT's apps drop bare observations
// there.
RawlogEntry densified_frame(const RawlogEntry& frame, Densification& run) {
  std::vector<RawlogEntry> observations;
  bool changed = false;
  const auto add = [&](const CObservation::Ptr& observation) {
    observations.push_back(entry_of(observation));
    changed = true;
  };
  for (RawlogEntry& entry : split_frame(frame)) {
    const auto around = run.feed(std::dynamic_pointer_cast<CObservation>(entry.object));
    for (const auto& observation : around.before) add(observation);
    observations.push_back(std::move(entry));
    for (const auto& observation : around.after) add(observation);
  }
  if (const auto observation = run.flush()) add(observation);
  return changed ? join_frame(observations) : frame;
}

void densify_entry(const RawlogEntry& entry, Densification& run, RawlogWriter& writer) {
  if (dynamic_cast<mrpt::obs::CSensoryFrame*>(entry.object.get()) != nullptr) {
    writer.write(densified_frame(entry, run));
    return;
  }
  const auto around = run.feed(std::dynamic_pointer_cast<CObservation>(entry.object));
  for (const auto& observation : around.before) writer.write(*observation);
  writer.write(entry);
  for (const auto& observation : around.after) writer.write(*observation);
}

std::string detector_name(const Config& config) {
  switch (config.detector.type) {
    case DetectorOptions::Type::network:
      return "network " + config.detector.network.model;
    case DetectorOptions::Type::csv:
      return "boxes from " + config.detector.csv.path;
    case DetectorOptions::Type::clusters:
      break;
  }
  return "clusters of the scan";
}

}  // namespace

DensifyReport densify(const DensifyJob& job, const std::function<void(double)>& progress) {
  const auto tell = [&](double share) {
    if (progress) progress(share);
  };
  DensifyReport report;
  report.input = job.input;
  report.output = job.output;
  report.detector = detector_name(job.config);
  RawlogWriter writer(job.output, job.overwrite, job.config.compression);

  constexpr double kIndexShare = 0.1;  // of the whole work
  const LogIndex index = index_log(job.input, [&](double share) { tell(kIndexShare * share); });
  if (index.corruption && !job.accept_truncated)
    throw std::runtime_error(*index.corruption +
                             "; --accept-truncated densifies what comes before");
  Densification run(job, index, report);
  if (index.corruption) report.warn(*index.corruption);

  RawlogReader reader(job.input);
  for (; report.num_objects_in < index.num_objects; ++report.num_objects_in) {
    const auto entry = reader.next();
    if (!entry) break;
    densify_entry(*entry, run, writer);
    tell(kIndexShare + (1 - kIndexShare) * reader.progress());
  }
  if (const auto observation = run.flush()) writer.write(*observation);
  writer.commit();
  if (!share_external_storage(job.input, job.output))
    report.warn(
        "the output's folder of external images is taken by something else: its images will not be "
        "found");
  return report;
}

}  // namespace lidar_upsampling
