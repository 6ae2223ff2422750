// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <optional>
#include <vector>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// Foreground: on an annotated object. Dynamic: it moves over ground (Argoverse 2: above 0.5 m/s).
enum class FlowClass { foreground_dynamic, foreground_static, background_static };

/// How far a point went, and how far an estimate says; both in the same frame. For the bucketed
/// figures the true ego-motion must have been taken off both.
struct PointFlow {
  Eigen::Vector3d estimated = Eigen::Vector3d::Zero();  ///< m
  Eigen::Vector3d truth = Eigen::Vector3d::Zero();      ///< m
  FlowClass kind = FlowClass::background_static;
};

/// Mean end point errors, metres; none where the class has no points.
struct ThreeWayEpe {
  std::optional<double> foreground_dynamic, foreground_static, background_static;
  int num_foreground_dynamic = 0, num_foreground_static = 0, num_background_static = 0;

  /// Mean over the classes that have points (three of them in the benchmark's own figure).
  [[nodiscard]] std::optional<double> mean() const;
};

/// As the Argoverse 2 scene flow benchmark: every class counts the same, whatever its size.
[[nodiscard]] ThreeWayEpe three_way_epe(const std::vector<PointFlow>& flows);

struct SpeedBuckets {
  double width = 0.4;       ///< m/s; the first bucket holds what is taken to stand
  double last_start = 20.;  ///< m/s; the last bucket has no end
};

struct BucketedEpe {
  std::optional<double> static_m;            ///< mean end point error in the first bucket
  std::optional<double> dynamic_normalized;  ///< mean over the other buckets of error / speed
  int num_dynamic_buckets = 0;               ///< that hold points
};

/// @brief Error against speed, so that slow objects count as much as fast ones (Khatri et al.,
/// "I Can't Believe It's Not Scene Flow!", 2024). 1: as bad as saying that everything stands.
/// @param flows of one object class, without ego-motion. @param dt seconds they took.
/// @throw std::invalid_argument dt or a bucket's width is not positive.
[[nodiscard]] BucketedEpe bucketed_epe(const std::vector<PointFlow>& flows, double dt,
                                       const SpeedBuckets& buckets = {});

}  // namespace lidar_upsampling
