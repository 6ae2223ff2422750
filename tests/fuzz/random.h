// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace lidar_upsampling::fuzz {

/// @brief All that is drawn for an input, by its seed alone. The standard's distributions differ
/// between its implementations, so none is used.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed * 0x9e3779b97f4a7c15ULL + 1) {}

  [[nodiscard]] std::uint64_t bits() { return engine_(); }
  /// 0 to size - 1; 0 of nothing.
  [[nodiscard]] std::size_t below(std::size_t size) { return size == 0 ? 0 : bits() % size; }
  [[nodiscard]] bool one_in(std::size_t times) { return below(times) == 0; }

  template <typename Values>
  [[nodiscard]] const auto& pick(const Values& values) {
    return values[below(values.size())];
  }

  /// A number that code may not be ready for.
  [[nodiscard]] double odd_number() {
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    constexpr std::array<double, 18> kOdd{
        0,          -0.,  1,     -1,          1e-300, 1e-9,
        1e9,        1e30, -1e30, 1e300,       -1e300, kInfinite,
        -kInfinite, 1e5,  65535, 4294967296., 0.5,    std::numeric_limits<double>::quiet_NaN()};
    return pick(kOdd);
  }
  /// A size, index or count that may not be so.
  [[nodiscard]] std::uint32_t odd_count() {
    constexpr std::array<std::uint32_t, 14> kOdd{
        0,       1,        2,          0x7f,       0xff,       0x7fff,     0xffff,
        0x10000, 0xffffff, 0x3fff0000, 0x7fffffff, 0x80000000, 0xfffffffe, 0xffffffff};
    return pick(kOdd);
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace lidar_upsampling::fuzz
