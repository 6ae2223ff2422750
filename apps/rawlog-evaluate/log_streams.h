// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "evaluation.h"
#include "lidar_upsampling/io/log_index.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// Of a LiDAR's scans, and of the virtual ones made of them.
struct ScanLabels {
  std::string real, dense;
};

/// What is known of the logs to compare before one of them goes by.
struct LogIndices {
  LogIndex input;
  std::optional<LogIndex> reference;  ///< none: by labels alone
  /// Whether row `paper` takes the vehicle's motion while the log goes by; else it is in `input`.
  bool ego_goes_by = true;
};

/// @brief Reads both logs once. @throw std::runtime_error, CorruptRawlog as index_log()
[[nodiscard]] LogIndices index_logs(const EvaluationJob& job);

/// @brief The LiDAR whose virtual scans the log holds, labelled as the settings tell.
/// @param wanted its label; empty: any.
/// @throw std::runtime_error it holds none.
[[nodiscard]] ScanLabels find_labels(const LogIndex& input, const std::string& wanted,
                                     const Config& config);

/// @brief The scans to judge by. @throw std::runtime_error there are none, or of several LiDARs.
[[nodiscard]] const StreamInfo& reference_stream(const LogIndex& reference,
                                                 const std::string& label);

[[nodiscard]] std::vector<Camera> calibrated_cameras(const LogIndex& index);

/// The log as it was before it was densified.
[[nodiscard]] LogIndex without_virtual(LogIndex index, const std::string& virtual_label);

}  // namespace lidar_upsampling
