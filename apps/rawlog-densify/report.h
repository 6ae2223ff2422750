// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <functional>
#include <iosfwd>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <string>
#include <vector>

#include "durations.h"
#include "lidar_upsampling/stopwatch.h"
#include "lidar_upsampling/types.h"
#include "report_rows.h"

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
  struct Warning {
    std::size_t count = 0;
    std::string first;  ///< what the first one tells besides, if anything
  };
  std::map<std::string, Warning> warnings;           ///< by kind
  std::map<std::string, Durations> stage_ms;         ///< stage, one time per run of it
  std::vector<std::string> stage_order;              ///< as first met
  std::map<std::string, std::size_t> object_status;  ///< status, objects times images
  std::set<int> tracks, moving_tracks;               ///< ids met
  std::shared_ptr<ReportRows> rows;                  ///< null: none are kept
  std::vector<ReportRow> last_rows;                  ///< of the last virtual scan, without boxes
  Stamp last_stamp;                                  ///< of the last virtual scan
  Pose T_rest_lidar_last = Pose::Identity();         ///< then

  void add(const VirtualScan& scan);
  void add(const std::vector<StageTime>& times);
  void warn(const std::string& kind, const std::string& detail = {});

  /// One text for each kind, however many there are, and how often.
  [[nodiscard]] std::map<std::string, std::size_t> told_warnings() const;

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

/// The rows of its objects, one by one: those in view, then the others.
void for_each_object(const DensifyReport& report,
                     const std::function<void(const nlohmann::json& row, bool in_view)>& use);

/// @brief The same as text, in memory that does not grow with the log.
void write_json(const DensifyReport& report, std::ostream& out);

/// @brief A screenful for people.
[[nodiscard]] std::string summary(const DensifyReport& report);

}  // namespace lidar_upsampling
