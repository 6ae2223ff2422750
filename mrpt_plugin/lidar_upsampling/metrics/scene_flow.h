// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <optional>
#include <vector>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// Foreground: on an annotated object. Dynamic: it moves over ground (Argoverse 2: above 0.5 m/s).
enum class FlowClass { foreground_dynamic, foreground_static, background_static };

/// How far a point went, and how far an estimate says; both in the same frame.
struct PointFlow {
  Eigen::Vector3d estimated = Eigen::Vector3d::Zero();  ///< m
  Eigen::Vector3d truth = Eigen::Vector3d::Zero();      ///< m
  FlowClass kind = FlowClass::background_static;
};

/// Mean end point errors, metres; none where the class has no points.
struct ThreeWayEpe {
  std::optional<double> foreground_dynamic, foreground_static, background_static;

  /// Mean over the classes that have points (three of them in the benchmark's own figure).
  [[nodiscard]] std::optional<double> mean() const;
};

/// As the Argoverse 2 scene flow benchmark: every class counts the same, whatever its size.
[[nodiscard]] ThreeWayEpe three_way_epe(const std::vector<PointFlow>& flows);

}  // namespace lidar_upsampling
