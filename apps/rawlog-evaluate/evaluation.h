// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lidar_upsampling/metrics/chamfer.h"
#include "lidar_upsampling/metrics/object_error.h"
#include "lidar_upsampling/types.h"
#include "truth.h"

namespace lidar_upsampling {

/// What is compared: the virtual scan, the key scan as it is, the key scan moved by the ego-motion.
/// A new row is a name here and an estimate in estimates_of() and clouds_of() (evaluate_scan.cpp).
constexpr std::array<const char*, 3> kRows{"ours", "hold", "ego"};

struct EvaluationOptions {
  double max_range_m = 70;    ///< of objects, at the key scan
  bool all_around = false;    ///< objects that no camera sees count, too
  int min_points_truth = 10;  ///< of an object with a true box
  MovingOptions moving;
  ObjectRegistrationOptions registration;
};

/// The scans at hand for one virtual scan.
struct ScanTriple {
  const LidarScan& key;
  const LidarScan& virtual_scan;
  const LidarScan& reference;
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

struct ObjectResult {
  ObjectReference object;
  std::array<std::optional<double>, kRows.size()> error_m;  ///< none: the motion is not recoverable
};

struct CloudResult {
  Chamfer full;
  std::optional<Chamfer> in_view;
};

struct ScanResult {
  Stamp stamp, key_stamp;
  double dt = 0;
  bool ego_found = false;
  bool by_beam = false;  ///< points were told by ring and column
  std::vector<ObjectResult> objects;
  std::array<std::optional<CloudResult>, kRows.size()> clouds;
  /// Mean distance of all moving objects\' points from where the references put them.
  std::array<std::optional<double>, kRows.size()> moving_points_m;
  std::array<std::optional<double>, kRows.size()>
      static_error_m;  ///< with a simulator's truth only
};

/// What happened in a whole log.
struct LogResult {
  std::string label, virtual_label;
  int num_virtual = 0;
  int num_unmatched = 0;  ///< without a reference scan, or before the first key scan
  std::vector<ScanResult> scans;
};

/// @brief Objects of the key scan with their reference motions: by clusters and registration to the
/// reference scan, or by true boxes.
/// @param truth may be null.
[[nodiscard]] std::vector<ObjectReference> find_references(const ScanTriple& scans,
                                                           const Truth* truth, const Pose& T_ego,
                                                           const std::vector<Camera>& cameras,
                                                           const EvaluationOptions& options);

/// Whether a point of a scan's lidar frame is seen by one of the cameras.
[[nodiscard]] bool in_view(const std::vector<Camera>& cameras, const LidarScan& scan,
                           const Eigen::Vector3d& point_in_lidar);

/// @param T_ego_guess where the registration for the ego-motion starts; unused with a truth.
[[nodiscard]] ScanResult evaluate_scan(const ScanTriple& scans, const Truth* truth,
                                       const std::vector<Camera>& cameras, const Pose& T_ego_guess,
                                       const EvaluationOptions& options, Pose* T_ego_found);

struct EvaluationJob {
  std::string reference, input;
  std::string label;          ///< empty: the one that has virtual scans
  std::string truth_objects;  ///< empty: none
  double tolerance_s = 0.015;
  EvaluationOptions options;
};

/// @param progress share of the input read.
/// @throw std::runtime_error, CorruptRawlog saying what is missing where.
[[nodiscard]] LogResult evaluate_log(const EvaluationJob& job,
                                     const std::function<void(double)>& progress);

}  // namespace lidar_upsampling
