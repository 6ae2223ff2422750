// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "import/object_tracks.h"
#include "import/truth_tables.h"
#include "lidar_upsampling/io/text_file.h"

namespace lidar_upsampling::importing {

/// Where the labels go; empty: nowhere.
struct LabelPaths {
  std::string boxes;  ///< the detections CSV that rawlog-densify reads
  /// ..._objects.csv; ..._ego.csv goes beside it, and ..._ignored.csv where there is such.
  std::string truth_objects;
  bool overwrite = false;

  [[nodiscard]] bool any() const { return !boxes.empty() || !truth_objects.empty(); }
};

/// The pictures of one camera.
struct CameraStamps {
  Camera camera;
  std::vector<Stamp> stamps;
};

struct LabelledLog {
  std::vector<ObjectTrack> tracks;
  std::vector<PoseSample> ego;
  std::vector<Stamp> scans;
  std::vector<CameraStamps> cameras;
  std::vector<IgnoredArea> ignored;
};

/// @brief Writes a log's labels; the files get their names on `commit()`.
class LabelFiles {
 public:
  /// @throw std::runtime_error a file exists and `overwrite` is off, cannot be written, or
  /// `truth_objects` does not end in _objects.csv.
  explicit LabelFiles(const LabelPaths& paths);

  /// @brief Boxes at every picture, objects at every label, the ego at every pose, scan and picture
  /// that it is known for. Labels that jump are left out (track_jumps.h).
  void write(const LabelledLog& log);
  void commit();

  [[nodiscard]] std::size_t num_boxes() const { return num_boxes_; }
  [[nodiscard]] std::size_t num_objects() const { return num_objects_; }
  /// What was left out of the labels, in a line each.
  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  void write_boxes(const LabelledLog& log, const std::vector<ObjectTrack>& tracks,
                   const Trajectory& ego);

  std::string ignored_path_;
  std::optional<TextFile> boxes_, objects_, ego_, ignored_;
  std::size_t num_boxes_ = 0, num_objects_ = 0;
  std::vector<std::string> warnings_;
};

}  // namespace lidar_upsampling::importing
