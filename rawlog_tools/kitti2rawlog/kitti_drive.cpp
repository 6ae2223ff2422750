// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "kitti2rawlog/kitti_drive.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

#include "import/input_file.h"

namespace fs = std::filesystem;

namespace lidar_upsampling::kitti {
namespace {

// Days since 1601-01-01, where MRPT's clock starts; in the proleptic Gregorian calendar.
std::int64_t days_since_1601(int year, int month, int day) {
  const int shifted_year = month <= 2 ? year - 1 : year;  // years that start in March
  const int shifted_month = month <= 2 ? month + 9 : month - 3;
  const auto days_before = [](std::int64_t y) { return 365 * y + y / 4 - y / 100 + y / 400; };
  const std::int64_t in_year = (153 * shifted_month + 2) / 5 + day - 1;
  constexpr int kDaysMarchToJanuary = 306;  // 1601-01-01 lies in the March-year of 1600
  return days_before(shifted_year) - days_before(1600) + in_year - kDaysMarchToJanuary;
}

// "335337762" to 3353378 ticks of 100 ns.
std::int64_t ticks_of_fraction(std::string digits) {
  digits.resize(9, '0');
  return (std::stoll(digits) + 50) / 100;
}

[[noreturn]] void throw_bad_stamp(const std::string& path, std::size_t number,
                                  const std::string& line) {
  throw std::runtime_error(path + ", line " + std::to_string(number) + ": '" + line +
                           "' is no time stamp");
}

std::optional<std::string> find_file(const fs::path& folder, int number, const FileNames& names) {
  std::string stem = std::to_string(number);
  stem.insert(0, names.digits - std::min(names.digits, stem.size()), '0');
  for (const std::string& extension : names.extensions) {
    const fs::path path = folder / (stem + extension);
    if (fs::is_regular_file(path)) return path.string();
  }
  return std::nullopt;
}

}  // namespace

std::optional<Stamp> parse_stamp(const std::string& text) {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0, second = 0, end = 0;
  if (std::sscanf(text.c_str(), "%4d-%2d-%2d %2d:%2d:%2d%n", &year, &month, &day, &hour, &minute,
                  &second, &end) != 6) {
    return std::nullopt;
  }
  std::string fraction = text.substr(static_cast<std::size_t>(end));
  if (!fraction.empty() && fraction.front() == '.') fraction.erase(0, 1);
  if (fraction.size() > 9 || fraction.find_first_not_of("0123456789") != std::string::npos) {
    return std::nullopt;
  }
  if (year < 1601 || month < 1 || month > 12 || day < 1 || day > 31 || hour > 23 || minute > 59 ||
      second > 60) {
    return std::nullopt;
  }
  const std::int64_t seconds =
      ((days_since_1601(year, month, day) * 24 + hour) * 60 + minute) * 60 + second;
  return Stamp(mrpt::Clock::duration(seconds * 10'000'000 + ticks_of_fraction(fraction)));
}

FrameStamps read_stamps(const std::string& path) {
  std::ifstream in = importing::open_file(path);
  if (!in) throw std::runtime_error("cannot read the time stamps " + path);
  FrameStamps stamps;
  for (std::string line; std::getline(in, line);) {
    line.erase(line.find_last_not_of(" \r\t") + 1);
    const auto stamp = parse_stamp(line);
    if (!stamp && !line.empty()) {
      throw_bad_stamp(path, stamps.size() + 1, line);
    }
    stamps.push_back(stamp);
  }
  return stamps;
}

SensorFolder list_frames(const std::string& folder, const FrameStamps& stamps,
                         const FileNames& names, const FrameRange& range) {
  SensorFolder list;
  const int end = static_cast<int>(stamps.size());
  for (int number = range.first; number <= range.last; ++number) {
    const auto file = find_file(folder, number, names);
    const bool promised = number < end && stamps[static_cast<std::size_t>(number)];
    if (number >= end && !file) break;
    if (file && promised) {
      list.frames.push_back({number, *stamps[static_cast<std::size_t>(number)], *file});
    } else if (file || promised) {
      list.missing.push_back(number);
    }
  }
  return list;
}

}  // namespace lidar_upsampling::kitti
