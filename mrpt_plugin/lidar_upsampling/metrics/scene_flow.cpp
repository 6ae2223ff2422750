// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/metrics/scene_flow.h"

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
    mean.add((flow.estimated - flow.truth).norm());
  }
  return {foreground_dynamic.value(), foreground_static.value(), background_static.value()};
}

}  // namespace lidar_upsampling
