// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include "rows.h"

namespace lidar_upsampling {

/// @brief A row's colour, the same on the whole page: Okabe and Ito's, told apart by colour-blind
/// people too.
[[nodiscard]] constexpr const char* color_of(Row row) {
  switch (row) {
    case Row::floor:
      return "#999999";
    case Row::hold:
      return "#56b4e9";
    case Row::ego:
      return "#0072b2";
    case Row::constant_velocity:
      return "#e69f00";
    case Row::paper:
      return "#cc79a7";
    case Row::ours:
      return "#d55e00";
    case Row::oracle:
      return "#009e73";
  }
  return "#000000";
}

/// Bounds are no estimates that a user could choose.
[[nodiscard]] constexpr bool is_bound(Row row) { return row == Row::floor || row == Row::oracle; }

}  // namespace lidar_upsampling
