// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lidar_upsampling/ego/ego_motion.h"
#include "lidar_upsampling/io/ego_samples.h"
#include "lidar_upsampling/io/rawlog_stream.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

enum class StreamKind { lidar, camera, pose, odometry, gnss, other };

[[nodiscard]] const char* to_string(StreamKind kind);

/// All observations of one label and class.
struct StreamInfo {
  std::string label;
  std::string class_name;  ///< without namespace, as "CObservationImage"
  StreamKind kind = StreamKind::other;
  std::size_t count = 0;
  /// In the log's order; those without a valid one left out. Of others than scans and images, the
  /// first that tell the rate.
  std::vector<Stamp> stamps;
  std::optional<Camera> camera;  ///< of a camera: that of its first picture that has one
  double median_period_s = 0;    ///< 0 with less than two stamps

  [[nodiscard]] bool calibrated() const;
};

/// What a log holds, without pixels and points.
struct LogIndex {
  std::string path;
  std::size_t num_objects = 0;
  bool has_frames = false;          ///< in action/sensory-frame format
  std::vector<StreamInfo> streams;  ///< in order of appearance
  /// The vehicle's motion, each from the one stream of its kind with the most samples.
  std::vector<PoseSample> poses;     ///< CObservationRobotPose
  std::vector<PoseSample> odometry;  ///< CObservationOdometry, or the actions' increments summed up
  std::vector<GnssSample> gnss;      ///< CObservationGPS with a fix
  std::optional<std::string> corruption;  ///< what of the log was left out, if that is accepted

  /// The stream of this label that holds scans, or images; null if there is none.
  [[nodiscard]] const StreamInfo* find(const std::string& label, StreamKind kind) const;
  [[nodiscard]] std::vector<const StreamInfo*> of_kind(StreamKind kind) const;
};

/// @brief Makes the index of a log while it is read.
class LogIndexer {
 public:
  explicit LogIndexer(std::string path, bool with_ego = true) : with_ego_(with_ego) {
    index_.path = std::move(path);
  }

  void add(const mrpt::serialization::CSerializable& object);

  /// Of all that was added but the vehicle's motion and the streams' periods.
  [[nodiscard]] const LogIndex& so_far() const { return index_; }
  /// Of all that was added, and whose motion was not taken.
  [[nodiscard]] LogIndex index() const;
  /// The same at the end: an index of an hour is not there twice.
  [[nodiscard]] LogIndex take_index();
  [[nodiscard]] EgoNews take_ego() { return ego_.take(); }

 private:
  void add_observation(const mrpt::obs::CObservation& observation);
  void complete(LogIndex& index) const;

  LogIndex index_;
  EgoSamples ego_;
  bool with_ego_;
};

/// @brief Reads a whole log once, loading nothing that is stored externally.
/// @param progress called now and then with the share read, 0 to 1; may be null.
/// @throw CorruptRawlog as RawlogReader::next(). @return where damage is accepted, the index of
/// the rest, and LogIndex::corruption.
[[nodiscard]] LogIndex index_log(const LogFile& log,
                                 const std::function<void(double)>& progress = nullptr);

/// @brief The same without the vehicle's motion, which takes most of an index's memory.
[[nodiscard]] LogIndex index_streams(const LogFile& log,
                                     const std::function<void(double)>& progress = nullptr);

/// "LIDAR (lidar), CAM2 (camera), ...": one line, for messages on a label that is not there.
[[nodiscard]] std::string labels_of(const LogIndex& index);

/// @brief A table, one line per stream: label, class, kind, count, rate, and a camera's size and
/// whether it is calibrated.
[[nodiscard]] std::string describe(const LogIndex& index);

}  // namespace lidar_upsampling
