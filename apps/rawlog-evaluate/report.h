// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "evaluation.h"

namespace lidar_upsampling {

/// The summary for people: one block per kind of object, one line per row.
[[nodiscard]] std::string to_table(const LogResult& result);

/// Everything, per scan and object; the summary first.
[[nodiscard]] nlohmann::ordered_json to_json(const LogResult& result);

}  // namespace lidar_upsampling
