// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <array>
#include <cstddef>

namespace lidar_upsampling {

/// What is compared, always together.
enum class Row {
  floor,              ///< the reference scan against itself, sampled twice: no estimate beats it
  hold,               ///< the key scan as it is
  ego,                ///< the key scan moved by the ego-motion
  constant_velocity,  ///< objects moved on by their motion between the last two real scans
  paper,              ///< preset=paper: P3P on the picture per object, nothing else
  ours,               ///< the virtual scan in the log
  oracle              ///< the reference motion itself
};

constexpr std::array<const char*, 7> kRowNames{"floor", "hold", "ego",   "constant-velocity",
                                               "paper", "ours", "oracle"};
constexpr std::array<Row, 7> kRows{Row::floor, Row::hold, Row::ego,   Row::constant_velocity,
                                   Row::paper, Row::ours, Row::oracle};

[[nodiscard]] constexpr const char* name_of(Row row) {
  return kRowNames[static_cast<std::size_t>(row)];
}

/// One value of a kind for each row.
template <typename Value>
class PerRow {
 public:
  [[nodiscard]] Value& operator[](Row row) { return values_[static_cast<std::size_t>(row)]; }
  [[nodiscard]] const Value& operator[](Row row) const {
    return values_[static_cast<std::size_t>(row)];
  }

 private:
  std::array<Value, kRows.size()> values_{};
};

}  // namespace lidar_upsampling
