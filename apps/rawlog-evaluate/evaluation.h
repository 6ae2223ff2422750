// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lidar_upsampling/metrics/chamfer.h"
#include "lidar_upsampling/metrics/emd.h"
#include "lidar_upsampling/metrics/object_error.h"
#include "lidar_upsampling/metrics/scene_flow.h"
#include "lidar_upsampling/types.h"
#include "protocol.h"
#include "rawlog-densify/densify.h"
#include "rows.h"
#include "truth.h"

namespace lidar_upsampling {

struct EvaluationOptions {
  double max_range_m = 70;    ///< of objects, at the key scan
  bool all_around = false;    ///< objects that no camera sees count, too
  int min_points_truth = 10;  ///< of an object with a true box
  int num_seeds = 5;          ///< of the sampled measures
  bool exact_emd = false;     ///< the exact assignment beside the published approximation
  std::optional<Protocol> protocol;
  MovingOptions moving;
  ObjectRegistrationOptions registration;
};

/// The scans at hand for one virtual scan.
struct ScanSet {
  const LidarScan& key;
  const LidarScan& virtual_scan;
  const LidarScan& reference;
  const LidarScan* previous = nullptr;      ///< the real scan before the key scan
  std::optional<Pose> T_previous_key = {};  ///< ego-motion between them, lidar frames
  const LidarScan* paper = nullptr;         ///< the same virtual scan by preset=paper
};

/// An object of the key scan, and where it really went.
struct ObjectReference {
  std::string id, class_name;
  std::vector<int> points;  ///< indices into the key scan
  ReferenceMotion motion;
  bool moving = false;
  double speed = 0;      ///< m/s over ground
  std::string excluded;  ///< why it does not count; empty if it does
};

struct ObjectError {
  double position_m = 0;
  double velocity_mps = 0;
  double yaw_rad = 0;
  std::optional<double> depth_share;  ///< of the true depth from the first camera that sees it
};

using Estimates = PerRow<std::optional<Pose>>;  ///< T_lidar_t_lidar_k of an object

struct ObjectResult {
  ObjectReference object;
  Estimates estimates;
  PerRow<std::optional<ObjectError>> errors;  ///< none: the motion is not recoverable
};

struct CloudResult {
  Chamfer full;
  std::optional<Chamfer> in_view;
};

/// The literature's measures, of one random sample.
struct SampledDistances {
  Chamfer chamfer;
  EarthMoverDistance emd;
  std::optional<EarthMoverDistance> exact;
};

/// By seed; `inliers` leaves out what has no counterpart in the other scan (vehicle protocols).
struct SampledResult {
  std::vector<SampledDistances> all, inliers;
};

struct ScanResult {
  Stamp stamp, key_stamp;
  double dt = 0;
  bool ego_found = false;
  bool points_told = false;  ///< one by one, by ring and column or order
  std::vector<ObjectResult> objects;
  PerRow<std::optional<CloudResult>> clouds;
  PerRow<SampledResult> sampled;
  /// Mean distance of all moving objects' points from where the references put them.
  PerRow<std::optional<double>> moving_points_m;
  PerRow<std::optional<double>> static_error_m;  ///< with true boxes only
  PerRow<std::optional<ThreeWayEpe>> flow;       ///< with true boxes only
};

/// What happened in a whole log.
struct LogResult {
  std::string label, virtual_label;
  std::string input, reference;
  std::string protocol;  ///< empty: none
  bool has_truth = false;
  int num_logs = 1;
  int num_virtual = 0;
  int num_unmatched = 0;  ///< without a reference scan, or before the first key scan
  std::vector<std::string> notes;
  std::vector<ScanResult> scans;
};

/// @brief Takes in what happened in a further log; from the second one on, objects are named after
/// their reference log, too.
void append(LogResult& total, LogResult log);

/// @brief Objects of the key scan with their reference motions: by clusters and registration to the
/// reference scan, or by true boxes.
/// @param truth may be null.
[[nodiscard]] std::vector<ObjectReference> find_references(const ScanSet& scans, const Truth* truth,
                                                           const Pose& T_ego,
                                                           const std::vector<Camera>& cameras,
                                                           const EvaluationOptions& options);

/// Whether a point of a scan's lidar frame is seen by the camera, or by one of the cameras.
[[nodiscard]] bool in_view(const Camera& camera, const LidarScan& scan,
                           const Eigen::Vector3d& point_in_lidar);
[[nodiscard]] bool in_view(const std::vector<Camera>& cameras, const LidarScan& scan,
                           const Eigen::Vector3d& point_in_lidar);

/// @param T_ego_guess where the registration for the ego-motion starts; unused with a truth.
[[nodiscard]] ScanResult evaluate_scan(const ScanSet& scans, const Truth* truth,
                                       const std::vector<Camera>& cameras, const Pose& T_ego_guess,
                                       const EvaluationOptions& options, Pose* T_ego_found);

/// The newest picture of each camera, by label.
using Pictured = std::map<std::string, CameraImage>;

struct EvaluationJob {
  std::string reference, input;
  std::string label;          ///< empty: the one that has virtual scans
  std::string truth_objects;  ///< empty: none
  double tolerance_s = 0.015;
  bool paper_row = true;
  DensifyJob paper;  ///< settings of the `paper` row
  EvaluationOptions options;
  /// Called after each scan, with the pictures of its instant.
  std::function<void(const ScanSet&, const ScanResult&, const Pictured&)> on_scan;
};

/// @param progress share of the input read.
/// @throw std::runtime_error, CorruptRawlog saying what is missing where.
[[nodiscard]] LogResult evaluate_log(const EvaluationJob& job,
                                     const std::function<void(double)>& progress);

}  // namespace lidar_upsampling
