// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

#include "lidar_upsampling/io/rawlog_stream.h"

namespace lidar_upsampling {

/// @brief The observations of a log entry that is a CSensoryFrame, in order, each with its own
/// bytes, so that a frame can gain or lose observations while the others stay byte for byte.
/// @throw std::invalid_argument the entry is no CSensoryFrame.
[[nodiscard]] std::vector<RawlogEntry> split_frame(const RawlogEntry& frame);

/// @brief A CSensoryFrame of these observations.
/// @throw std::invalid_argument one of them is no CObservation.
[[nodiscard]] RawlogEntry join_frame(const std::vector<RawlogEntry>& observations);

}  // namespace lidar_upsampling
