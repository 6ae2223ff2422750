// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/stamp_text.h"

#include <cstdint>
#include <stdexcept>

namespace lidar_upsampling {
namespace {

constexpr std::int64_t kTicksPerSecond = 10'000'000;
constexpr int kTickDigits = 7;
/// 1970-01-01 in MRPT's ticks, which count from 1601-01-01.
constexpr std::int64_t kUnixEpochTicks = 116'444'736'000'000'000;
/// An integer below is seconds, above ticks: year 2286 and 1601-01-12 are far from any log.
constexpr std::int64_t kLargestSeconds = 9'999'999'999;
constexpr std::int64_t kSmallestTicks = 10'000'000'000'000;

bool all_digits(const std::string& text) {
  return text.find_first_not_of("0123456789") == std::string::npos;
}

}  // namespace

Stamp parse_stamp(const std::string& text) {
  const auto point = text.find('.');
  const std::string whole = text.substr(0, point);
  std::string fraction = point == std::string::npos ? "" : text.substr(point + 1);
  if (whole.empty() || whole.size() > 18 || !all_digits(whole) || !all_digits(fraction)) {
    throw std::invalid_argument("stamp '" + text + "' is neither MRPT ticks nor UNIX seconds");
  }
  std::int64_t ticks = std::stoll(whole);
  if (point == std::string::npos && ticks >= kSmallestTicks) {
    return Stamp(Stamp::duration(ticks));
  }
  if (ticks > kLargestSeconds) {
    throw std::invalid_argument("stamp '" + text + "' is neither MRPT ticks nor UNIX seconds");
  }
  fraction.resize(kTickDigits + 1, '0');
  const std::int64_t tenths_of_ticks = std::stoll(fraction);
  ticks = ticks * kTicksPerSecond + (tenths_of_ticks + 5) / 10 + kUnixEpochTicks;
  return Stamp(Stamp::duration(ticks));
}

std::string to_text(Stamp stamp) {
  const std::int64_t ticks = stamp.time_since_epoch().count() - kUnixEpochTicks;
  if (ticks < 0) return "-" + to_text(Stamp(Stamp::duration(kUnixEpochTicks - ticks)));
  std::string fraction = std::to_string(ticks % kTicksPerSecond);
  fraction.insert(0, kTickDigits - fraction.size(), '0');
  return std::to_string(ticks / kTicksPerSecond) + "." + fraction;
}

}  // namespace lidar_upsampling
