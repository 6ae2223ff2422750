// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "densify.h"

namespace lidar_upsampling {

struct PartOptions {
  std::size_t most = 1;  ///< parts; fewer if they would be shorter than a warm-up
  /// What goes before a part is looked at for so long: after less, tracks are not yet what they
  /// would be.
  double warm_up_s = 3;
};

/// @brief densify() of one log in parts side by side, of equally many scans each, that are joined
/// to one output and one report. The same options give the same bytes; other than from densify()
/// is what rests on what came before a part's warm-up.
/// @throw std::runtime_error as densify(); pictures are asked for.
[[nodiscard]] DensifyReport densify_in_parts(const DensifyJob& job, const PartOptions& options,
                                             const std::function<void(double)>& progress);

/// @brief One report of those of a log's parts, in their order: a track that goes on from one part
/// to the next, as the warm-up tells, keeps its number; poses are in the first part's frame at
/// rest.
/// @param rows where the report's go; null: nowhere.
[[nodiscard]] DensifyReport joined(std::vector<PartReport> parts, std::shared_ptr<ReportRows> rows);

}  // namespace lidar_upsampling
