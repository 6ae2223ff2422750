// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "lidar_upsampling/scene/object_scene.h"
#include "lidar_upsampling/stopwatch.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// What a densification did: filled while the log goes by, printed and saved at the end.
struct DensifyReport {
  std::string input, output;
  std::string mode, ego_source, detector, carrier;
  double camera_time_offset_ms = 0;  ///< as set: a judge needs it
  bool hindsight = false;            ///< whether scans to come have told who moves
  std::size_t num_objects_in = 0;    ///< entries of the input log
  std::size_t num_scans = 0;         ///< real scans of the chosen LiDAR
  std::size_t num_images = 0;        ///< images of the chosen cameras
  std::size_t num_virtual_scans = 0;
  std::size_t num_extrapolated = 0;               ///< of them, with the ego-motion extrapolated
  std::map<std::string, std::size_t> resampling;  ///< what became of it, virtual scans
  std::map<std::string, std::size_t> warnings;    ///< text, how often
  std::map<std::string, std::vector<double>> stage_ms;  ///< stage, one time per run of it
  std::vector<std::string> stage_order;                 ///< as first met
  std::map<std::string, std::size_t> object_status;     ///< status, objects times images
  std::set<int> tracks, moving_tracks;                  ///< ids met
  struct Row {
    Stamp stamp;
    std::size_t num_points;
    ObjectMotion object;                   ///< without its points
    std::optional<ObjectBox> box;          ///< none: no points of it are left in the virtual scan
    Pose T_rest_lidar = Pose::Identity();  ///< at `stamp`, as in VirtualScan
  };
  std::vector<Row> rows;
  std::vector<std::pair<Stamp, OtherCluster>> other_clusters;  ///< by key scan
  Stamp last_stamp;                                            ///< of the last virtual scan
  Pose T_rest_lidar_last = Pose::Identity();                   ///< then

  void add(const VirtualScan& scan, bool keep_rows);
  void add(const std::vector<StageTime>& times);
  void warn(const std::string& text);

  /// What all of a log have in common, without what was met so far.
  [[nodiscard]] DensifyReport begun_anew() const;
};

/// Times its scope for a report.
class Timed {
 public:
  Timed(DensifyReport& report, const char* stage) : report_(report), watch_(times_, stage) {}
  ~Timed() {
    watch_.stop();
    report_.add(times_);
  }
  Timed(const Timed&) = delete;
  Timed& operator=(const Timed&) = delete;

 private:
  DensifyReport& report_;
  std::vector<StageTime> times_;
  Stopwatch watch_;
};

/// @brief Everything, for programs: counts, each stage's median, p95 and total, a row per object
/// and image.
[[nodiscard]] nlohmann::json to_json(const DensifyReport& report);

/// @brief A screenful for people.
[[nodiscard]] std::string summary(const DensifyReport& report);

}  // namespace lidar_upsampling
