// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "plugin/upsampled_lidar_sensor.h"

#include <mrpt/io/lazy_load_path.h>
#include <mrpt/obs/CObservationComment.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>

#include "lidar_upsampling/front_end/pose_input.h"
#include "lidar_upsampling/io/rawlog_stream.h"
#include "lidar_upsampling/text.h"
#include "plugin/grabber_end.h"
#include "plugin/live_upsampling.h"
#include "plugin/log_player.h"

IMPLEMENTS_GENERIC_SENSOR(UpsampledLidarSensor, lidar_upsampling)

namespace lidar_upsampling {

using mrpt::obs::CObservation;

UpsampledLidarSensor::UpsampledLidarSensor() : COutputLogger("UpsampledLidarSensor") {
  m_state = ssUninitialized;
}

UpsampledLidarSensor::~UpsampledLidarSensor() {
  if (!pipeline_) return;
  source_.reset();
  if (!end_time_) report();
}

void UpsampledLidarSensor::loadConfig_sensorSpecific(const mrpt::config::CConfigFileBase& source,
                                                     const std::string& section) {
  try {
    settings_ = load_sensor_settings(source, section);
    drivers_ = make_drivers(source, settings_.sources);
  } catch (const std::exception& error) {
    remove_empty_recording_at_exit(mrpt::io::getLazyLoadPathBase());
    // On its way through MRPT's loadConfig() a message is cut up at the bracket of a section.
    std::string message = one_line(error);
    std::replace(message.begin(), message.end(), '[', '(');
    std::replace(message.begin(), message.end(), ']', ')');
    throw std::runtime_error(message);
  }
}

void UpsampledLidarSensor::setPathForExternalImages(const std::string& directory) {
  external_images_ = directory;
  for (const Driver& driver : drivers_) driver.sensor->setPathForExternalImages(directory);
}

void UpsampledLidarSensor::initialize() {
  m_state = ssInitializing;
  try {
    start();
  } catch (const std::exception&) {
    remove_empty_recording_at_exit(external_images_);
    throw;
  }
  m_state = ssWorking;
}

void UpsampledLidarSensor::start() {
  streams_.emplace(settings_.config, settings_.rig);
  QueueOptions queue;
  const bool can_wait = !settings_.rawlog.empty() && settings_.speed == 0;
  if (!can_wait) {
    queue.give_up_after = QueueOptions::Milliseconds(settings_.max_wait_ms);
    queue.hurry_after = queue.give_up_after / 2;
  }
  if (settings_.rawlog.empty())  // a log has its order already
    queue.merge_window = std::chrono::duration<double, std::milli>(settings_.merge_window_ms);
  pipeline_ = std::make_unique<Pipeline>(
      queue, [this](const CObservation& observation) { return streams_->role_of(observation); },
      std::make_unique<LiveUpsampling>(settings_.config, settings_.rig, messages_, given_poses()),
      messages_);
  if (settings_.rawlog.empty()) {
    source_ = std::make_unique<DriverSources>(drivers_, *pipeline_);
  } else {
    share_external_images();
    source_ = std::make_unique<LogPlayer>(settings_.rawlog, settings_.speed, *pipeline_);
  }
}

// Only a log has stamps that a file can have poses of.
std::vector<PoseSample> UpsampledLidarSensor::given_poses() const {
  if (settings_.config.pose_file.path.empty()) return {};
  LogIndex index = index_log({settings_.rawlog, true});
  take_poses_from_file(settings_.config, settings_.rig, index);
  return std::move(index.poses);
}

void UpsampledLidarSensor::doProcess() {
  if (!pipeline_) throw std::logic_error("UpsampledLidarSensor: initialize() comes first");
  const auto reason = pipeline_->end();
  hand_out();
  for (const std::string& text : messages_.take()) MRPT_LOG_WARN(text);
  if (reason) end(*reason);
}

void UpsampledLidarSensor::hand_out() {
  std::vector<mrpt::serialization::CSerializable::Ptr> all;
  for (const CObservation::Ptr& observation : pipeline_->take()) {
    last_stamp_ = std::max(last_stamp_, observation->timestamp);
    handed_out_.emplace_back(observation);
    all.push_back(observation);
  }
  if (!all.empty()) appendObservations(all);
  const auto in_use = std::find_if(handed_out_.begin(), handed_out_.end(),
                                   [](const auto& observation) { return !observation.expired(); });
  handed_out_.erase(handed_out_.begin(), in_use);
}

void UpsampledLidarSensor::end(const std::string& reason) {
  const auto now = std::chrono::steady_clock::now();
  if (!end_time_) {
    end_time_ = now;
    report();
    append_fillers();
    return;
  }
  const bool all_is_used = handed_out_.empty();
  const bool is_over = std::chrono::duration<double>(now - *end_time_).count() > settings_.linger_s;
  if (!all_is_used && !is_over) return;
  if (!all_is_used && !key_time_)
    MRPT_LOG_WARN_STREAM("after linger_s = " << settings_.linger_s << " s, " << handed_out_.size()
                                             << " observations are still in use");
  if (ends_quietly(reason)) return;
  m_state = ssError;
  remove_empty_recording_at_exit(external_images_);
  throw std::runtime_error(reason);
}

// A driver that fails is an error, and so is a log of which nothing could be played.
bool UpsampledLidarSensor::ends_quietly(const std::string& reason) {
  constexpr std::chrono::seconds kUntilSeen(10);
  const auto now = std::chrono::steady_clock::now();
  if (key_time_) return now < *key_time_ + kUntilSeen;
  if (settings_.rawlog.empty() || last_stamp_ == Stamp() || !press_key_in_grabber()) return false;
  const bool is_whole = reason.find(kPlayedToItsEnd) != std::string::npos;
  logStr(is_whole ? mrpt::system::LVL_INFO : mrpt::system::LVL_WARN, reason);
  key_time_ = now;
  return true;
}

// rawlog-grabber writes the earlier half of what is pending, again and again: a single observation
// stays. One behind the last real one takes that place; a frame under way takes one more to be
// written.
void UpsampledLidarSensor::append_fillers() {
  constexpr double kLater_s = 3600;  // longer than any frame spans
  for (int i = 1; i <= (settings_.into_frames ? 2 : 1); ++i) {
    auto filler = mrpt::obs::CObservationComment::Create();
    filler->sensorLabel = m_sensorLabel;
    filler->timestamp = shifted(last_stamp_, i * kLater_s);
    filler->text = "end of the recording";
    appendObservation(filler);
  }
}

// The recording finds the played log's external files through a link beside it.
void UpsampledLidarSensor::share_external_images() {
  const std::string recording = recording_of(external_images_);
  if (recording.empty()) return;
  if (!share_external_storage(settings_.rawlog, recording))
    messages_.add(external_images_ + ": this name is taken, external images will not be found");
}

SensorStatistics UpsampledLidarSensor::statistics() const {
  return pipeline_ ? pipeline_->statistics() : SensorStatistics();
}

void UpsampledLidarSensor::report() const {
  const SensorStatistics figures = statistics();
  MRPT_LOG_INFO_STREAM(summary(figures));
  for (const std::string& text : messages_.repeated()) MRPT_LOG_WARN(text);
  if (figures.num_virtual_scans == 0)
    MRPT_LOG_WARN_STREAM("no virtual scan was made; there came " << streams_->seen());
}

}  // namespace lidar_upsampling
