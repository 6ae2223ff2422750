// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "densification.h"

#include <mrpt/obs/CObservationImage.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "ego_ahead.h"
#include "lidar_upsampling/io/carriers.h"

namespace lidar_upsampling {

using mrpt::obs::CObservation;
using mrpt::obs::CObservationImage;

Densification::Densification(const DensifyJob& job, const LogIndex& index, DensifyReport& report)
    : job_(job),
      report_(report),
      upsampler_(job.config),
      usable_(job.rig, job.config.sweep, [&report](const std::string& text) { report.warn(text); }),
      stamps_(report) {
  const StreamSelection streams = select_streams(index, job.config, labels_of_calibrated(job.rig));
  lidar_label_ = streams.lidar->label;
  take_streams(streams);
  num_streams_ = index.streams.size();
  for (const StreamInfo& stream : index.streams) labels_.insert(stream.label);
  num_stamps_ = streams.lidar->stamps.size();
  upsampler_.expect_scans(streams.lidar->stamps);
  take_ego({index.poses, index.odometry, index.gnss});
  report.camera_time_offset_ms = job.config.timing.camera_time_offset_ms;
  report.ego_source = to_string(upsampler_.ego_motion().source());
  if (!job.pictures.empty()) pictures_.emplace(job.pictures);
  if (!job.film.empty()) film_.emplace(job.film);
  if (job.config.mode == "offline") ahead_.emplace(lidar_label_, job.rig, job.config.sweep);
}

void Densification::take_streams(const StreamSelection& streams) {
  std::vector<std::string> labels;
  for (const StreamInfo* camera : streams.cameras) labels.push_back(camera->label);
  camera_labels_ = {labels.begin(), labels.end()};
  upsampler_.expect_cameras(labels);
}

void Densification::take_ego(const EgoNews& news) {
  EgoMotion& ego = upsampler_.ego_motion();
  for (const PoseSample& sample : news.poses) ego.add_pose(sample);
  for (const PoseSample& sample : news.odometry) ego.add_odometry(sample);
  for (const GnssSample& sample : news.gnss) ego.add_gnss(sample);
}

void Densification::go_on_by(const EgoNews& news) {
  learns_ = true;
  take_ego(news);
  report_.ego_source = to_string(upsampler_.ego_motion().source());
}

void Densification::learn(LogIndexer& indexer) {
  learns_ = true;
  const LogIndex& index = indexer.so_far();
  if (index.streams.size() > num_streams_)
    take_streams(select_again(index, job_.config, labels_of_calibrated(job_.rig)));
  num_streams_ = index.streams.size();

  EgoNews news = indexer.take_ego();
  if (!job_.config.pose_file.path.empty()) news.poses.clear();
  take_ego(news);
  const std::string source = to_string(upsampler_.ego_motion().source());
  if (source != report_.ego_source) {
    const std::string text = "ego-motion by " + source +
                             " comes up late in the log, until then it is by " +
                             std::exchange(report_.ego_source, source);
    if (std::filesystem::is_regular_file(job_.input)) throw EgoComesLate(text);
    report_.warn(text);  // what comes through a pipe is gone
  }

  constexpr std::ptrdiff_t kMost = 1000;  // those before are past
  const std::vector<Stamp>& stamps = index.find(lidar_label_, StreamKind::lidar)->stamps;
  if (stamps.size() == num_stamps_) return;
  num_stamps_ = stamps.size();
  upsampler_.expect_scans({std::max(stamps.begin(), stamps.end() - kMost), stamps.end()});
}

std::optional<VirtualScan> Densification::feed(const CObservation::Ptr& observation) {
  if (!observation) return {};
  labels_.insert(observation->sensorLabel);
  if (observation->sensorLabel == lidar_label_ && is_lidar_scan(*observation)) {
    static_cast<void>(stamps_.note(*observation));
    return noted(feed_scan(observation));
  }
  if (camera_labels_.count(observation->sensorLabel) > 0) {
    if (stamps_.note(*observation)) return noted(feed_image(*observation));
    report_.warn("'" + observation->sensorLabel +
                 "': an image that is there twice was left out the second time");
  }
  usable_.ego(*observation);
  return {};
}

std::optional<VirtualScan> Densification::flush() { return noted(upsampler_.flush()); }

void Densification::finish() {
  warn_of_unused(job_, labels_, camera_labels_, report_);
  if (film_ && !film_->finish()) report_.warn("fewer than two virtual scans: no film is made");
}

std::optional<VirtualScan> Densification::feed_scan(const CObservation::Ptr& observation) {
  ++report_.num_scans;
  ++num_fed_;
  last_real_ = observation;
  std::optional<LidarScan> scan = usable_.scan(*observation);
  if (!scan) return {};
  if (learns_) upsampler_.ego_motion().forget_before(shifted(last_stamp_, -kEgoMemory_s));
  last_stamp_ = scan->stamp;
  if (pictures_) pictures_->real_scan(*scan);
  if (film_) film_->real_scan(*scan);
  expect_scans();
  return upsampler_.insert_scan(std::move(*scan));
}

void Densification::look_ahead(const RawlogEntry& entry) {
  if (ahead_) ahead_->add(entry);
}

bool Densification::wants_scans() const {
  if (!ahead_) return false;
  return num_expected_ + ahead_->size() < num_fed_ + 1 + job_.config.scans_ahead;
}

// The scan at hand is the first of those ahead.
void Densification::expect_scans() {
  if (!ahead_) return;
  const std::size_t wanted = num_fed_ + job_.config.scans_ahead;
  for (; num_expected_ < wanted; ++num_expected_) {
    auto scan = ahead_->next();
    if (!scan) return;
    upsampler_.expect(std::move(*scan));
  }
}

std::optional<VirtualScan> Densification::feed_image(const CObservation& observation) {
  const auto* const image_observation = dynamic_cast<const CObservationImage*>(&observation);
  if (image_observation == nullptr) return {};
  ++report_.num_images;
  const std::optional<CameraImage> image = usable_.image(*image_observation);
  if (!image) return {};
  if (pictures_) pictures_->image(*image);
  if (film_) film_->image(*image);
  return upsampler_.insert_image(*image);
}

std::optional<VirtualScan> Densification::noted(std::optional<VirtualScan> scan) {
  if (!scan) return scan;
  report_.add(*scan);
  if (pictures_) pictures_->virtual_scan(*scan);
  if (film_) film_->virtual_scan(*scan);
  return scan;
}

}  // namespace lidar_upsampling
