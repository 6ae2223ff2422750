// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "label_score.h"
#include "lidar_upsampling/metrics/chamfer.h"
#include "lidar_upsampling/metrics/emd.h"
#include "lidar_upsampling/metrics/object_error.h"
#include "lidar_upsampling/metrics/scene_flow.h"
#include "lidar_upsampling/se3.h"
#include "lidar_upsampling/types.h"
#include "protocol.h"
#include "rawlog-densify/densify.h"
#include "rows.h"
#include "scan_results.h"
#include "truth.h"

namespace lidar_upsampling {

struct EvaluationOptions {
  double max_range_m = 70;    ///< of objects, at the key scan
  bool all_around = false;    ///< objects that no camera sees count, too
  int min_points_truth = 10;  ///< of an object with a true box
  int num_seeds = 5;          ///< of the sampled measures
  bool chamfer = true;        ///< whole clouds' distances, too
  bool exact_emd = false;     ///< the exact assignment beside the published approximation
  std::optional<Protocol> protocol;
  ObjectRegistrationOptions registration;
  LabelScoreOptions labels;
};

/// The scans at hand for one virtual scan.
struct ScanSet {
  const LidarScan& key;
  const LidarScan& virtual_scan;
  const LidarScan& reference;        ///< a real one, brought to the virtual scan's instant
  const LidarScan* paper = nullptr;  ///< the same virtual scan by preset=paper
};

/// An object's motion over ground between the last two real scans.
struct LastMotion {
  Twist per_second = Twist::Zero();  ///< in the lidar frame at the key scan
  double dt = 0;                     ///< s, between these scans
  double sigma_m = 0;                ///< of the step between them
};

/// An object of the key scan, and where it really went.
struct ObjectReference {
  std::string id, class_name;
  std::vector<int> points;  ///< indices into the key scan
  std::optional<LastMotion> last_motion;
  bool last_motion_sought = false;
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
  std::size_t num_points = 0;  ///< of the object, in the key scan
  Estimates estimates;
  PerRow<std::optional<ObjectError>> errors;  ///< none: the motion is not recoverable
};

/// Where ours is known, so that the rows compare the same objects.
[[nodiscard]] inline bool is_counted(const ObjectResult& result) {
  return result.object.excluded.empty() && result.errors[Row::ours].has_value();
}

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
  bool interpolated = false;  ///< the reference, from scans of other instants
  bool points_told = false;   ///< one by one, by ring and column or order
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
  int num_unmatched = 0;  ///< without a reference scan near, or before the first key scan
  double tolerance_s = 0;
  PerRow<std::optional<LabelScore>> labels;  ///< with labels, of the rows that tell of objects
  int num_unlabelled = 0;  ///< beyond the labels, or at a real scan that the log still holds
  std::vector<std::string> notes;
  ScanResults scans;
};

/// @brief Takes in what happened in a further log; from the second one on, objects are named after
/// their reference log, too.
void append(LogResult& total, LogResult log);

/// A camera as a scan's points are seen by it.
struct View {
  const Camera* camera = nullptr;
  Pose T_camera_lidar = Pose::Identity();
};

/// In the cameras' order. @param cameras must outlive the views.
[[nodiscard]] std::vector<View> views_of(const std::vector<Camera>& cameras, const LidarScan& scan);

/// Whether a point of the scan's lidar frame is seen by the camera, or by one of the cameras.
[[nodiscard]] bool in_view(const View& view, const Eigen::Vector3d& point_in_lidar);
[[nodiscard]] bool in_view(const std::vector<View>& views, const Eigen::Vector3d& point_in_lidar);

struct InstantReference;

/// @param reference of the virtual scan's instant.
[[nodiscard]] ScanResult evaluate_scan(const ScanSet& scans, InstantReference reference,
                                       const std::vector<Camera>& cameras,
                                       const EvaluationOptions& options);

/// The newest picture of each camera, by label.
using Pictured = std::map<std::string, CameraImage>;

struct EvaluationJob {
  std::string reference, input;
  std::string label;              ///< empty: the one that has virtual scans
  std::string truth_objects;      ///< empty: none
  bool accept_truncated = false;  ///< take a damaged log without the damage
  std::string scratch_beside;     ///< whose disk takes what is put aside; empty: temporary files'
  double tolerance_s = 0.1;       ///< to the nearest withheld scan
  const RunReport* report = nullptr;  ///< of the densification; null: row `ours` is not labelled
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
