// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/metrics/scene_flow.h"

#include <array>

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
  std::array<Mean, 3> means;
  for (const PointFlow& flow : flows)
    means[static_cast<std::size_t>(flow.kind)].add((flow.estimated - flow.truth).norm());
  return {means[0].value(), means[1].value(), means[2].value()};
}

}  // namespace lidar_upsampling
