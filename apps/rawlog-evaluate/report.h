// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <functional>
#include <string>

#include "evaluation.h"
#include "figures.h"
#include "label_table.h"

namespace lidar_upsampling {

/// The summary for people: one block per kind of figure, one line per row.
[[nodiscard]] std::string to_table(const LogResult& result, const Figures& figures,
                                   const std::optional<Protocol>& protocol);

/// @brief Everything, per scan and object; the summary first. Piece by piece, as a document takes
/// many times the memory of its scans.
void write_json(const LogResult& result, const Figures& figures,
                const std::function<void(const std::string& text)>& write);

/// The headline as `row,figure,value` lines: for tables over several logs.
[[nodiscard]] std::string to_csv(const LogResult& result, const Figures& figures);

}  // namespace lidar_upsampling
