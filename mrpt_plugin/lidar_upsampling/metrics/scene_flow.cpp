// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/metrics/scene_flow.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace lidar_upsampling {

namespace {

struct Mean {
  double sum = 0;
  int count = 0;

  void add(double value) {
    sum += value;
    ++count;
  }
  [[nodiscard]] std::optional<double> value() const {
    return count > 0 ? std::make_optional(sum / count) : std::nullopt;
  }
};

double end_point_error(const PointFlow& flow) { return (flow.estimated - flow.truth).norm(); }

}  // namespace

std::optional<double> ThreeWayEpe::mean() const {
  Mean mean;
  for (const auto& part : {foreground_dynamic, foreground_static, background_static}) {
    if (part) {
      mean.add(*part);
    }
  }
  return mean.value();
}

ThreeWayEpe three_way_epe(const std::vector<PointFlow>& flows) {
  Mean foreground_dynamic, foreground_static, background_static;
  for (const PointFlow& flow : flows) {
    Mean& mean = flow.kind == FlowClass::foreground_dynamic  ? foreground_dynamic
                 : flow.kind == FlowClass::foreground_static ? foreground_static
                                                             : background_static;
    mean.add(end_point_error(flow));
  }
  return {foreground_dynamic.value(), foreground_static.value(), background_static.value(),
          foreground_dynamic.count,   foreground_static.count,   background_static.count};
}

BucketedEpe bucketed_epe(const std::vector<PointFlow>& flows, double dt,
                         const SpeedBuckets& buckets) {
  if (!(dt > 0) || !(buckets.width > 0) || !(buckets.last_start >= buckets.width)) {
    throw std::invalid_argument("bucketed_epe: dt " + std::to_string(dt) + " s, buckets of " +
                                std::to_string(buckets.width) + " m/s up to " +
                                std::to_string(buckets.last_start) + " m/s");
  }
  const int last = static_cast<int>(std::lround(buckets.last_start / buckets.width));
  std::vector<Mean> errors(last + 1), lengths(last + 1);
  for (const PointFlow& flow : flows) {
    const double length = flow.truth.norm();
    const double place = std::min<double>(last, length / dt / buckets.width);
    errors[static_cast<int>(place)].add(end_point_error(flow));
    lengths[static_cast<int>(place)].add(length);
  }
  Mean dynamic;
  for (int i = 1; i <= last; ++i) {
    if (errors[i].count > 0) {
      dynamic.add(errors[i].sum / lengths[i].sum);
    }
  }
  return {errors[0].value(), dynamic.value(), dynamic.count};
}

}  // namespace lidar_upsampling
