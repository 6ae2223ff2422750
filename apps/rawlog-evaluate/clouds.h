// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

#include "estimates.h"

namespace lidar_upsampling {

using Points = std::vector<Eigen::Vector3f>;

/// Each row's whole scan at the image, lidar frame; none where the row has nothing to say.
[[nodiscard]] PerRow<Points> whole_clouds(const RowSources& sources,
                                          const std::vector<ObjectResult>& objects);

/// Chamfer distances at full resolution, everywhere and in the cameras' view.
void measure_clouds(const PerRow<Points>& clouds, const LidarScan& reference,
                    const std::vector<Camera>& cameras, ScanResult& result);

/// The literature's measures as the protocol cuts the clouds, for each seed.
void measure_samples(const PerRow<Points>& clouds, const ScanSet& scans,
                     const std::vector<Camera>& cameras, const EvaluationOptions& options,
                     ScanResult& result);

}  // namespace lidar_upsampling
