// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/types.h"

#include <Eigen/Eigenvalues>
#include <cmath>
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
  const bool is_number =
      !whole.empty() && whole.size() <= 18 && all_digits(whole) && all_digits(fraction);
  std::int64_t ticks = is_number ? std::stoll(whole) : 0;
  if (point == std::string::npos && ticks >= kSmallestTicks) return Stamp(Stamp::duration(ticks));
  if (!is_number || ticks > kLargestSeconds)
    throw std::invalid_argument("stamp '" + text + "' is neither MRPT ticks nor UNIX seconds");
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

Compression parse_compression(const std::string& text) {
  if (text == "none") return Compression::none;
  if (text == "fast") return Compression::fast;
  if (text == "small") return Compression::small;
  const bool is_zstd = text.rfind("zstd:", 0) == 0;
  const std::string level = text.substr(std::min(text.size(), std::size_t{5}));
  if ((is_zstd || text.rfind("gzip:", 0) == 0) && !level.empty() && level.size() < 3 &&
      all_digits(level)) {
    const int number = std::stoi(level);
    if (number >= 1 && number <= (is_zstd ? 19 : 9))
      return {is_zstd ? Compression::Format::zstd : Compression::Format::gzip, number};
  }
  throw std::invalid_argument(
      "the choices are none, fast, small, gzip:1 to gzip:9, zstd:1 to zstd:19");
}

std::string to_text(const Compression& compression) {
  if (compression == Compression::small) return "small";
  constexpr std::array<const char*, 4> kFormats{"none", "fast", "gzip", "zstd"};
  std::string text = kFormats.at(static_cast<std::size_t>(compression.format));
  if (compression.level > 0) text += ":" + std::to_string(compression.level);
  return text;
}

const char* to_string(MotionStatus status) {
  constexpr std::array<const char*, 5> kNames{"moving", "stationary", "predicted", "too_few_points",
                                              "no_consensus"};
  return kNames.at(static_cast<std::size_t>(status));
}

const char* to_string(Resampling resampling) {
  constexpr std::array<const char*, 4> kNames{"none", "done", "little_motion", "no_beams"};
  return kNames.at(static_cast<std::size_t>(resampling));
}

double intersection_over_union(const Box2d& a, const Box2d& b) {
  const Box2d common{std::max(a.left, b.left), std::max(a.top, b.top), std::min(a.right, b.right),
                     std::min(a.bottom, b.bottom)};
  const double both = common.area();
  return both > 0 ? both / (a.area() + b.area() - both) : 0;
}

double position_sigma(const ObjectMotion& object) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(object.position_covariance,
                                                            Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0., axes.eigenvalues()[2]));
}

Eigen::Vector3d mean_of(const std::vector<Eigen::Vector3f>& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& point : points) sum += point.cast<double>();
  return sum / std::max<double>(1, static_cast<double>(points.size()));
}

std::vector<Eigen::Vector3f> points_at(const LidarScan& scan, const std::vector<int>& indices) {
  std::vector<Eigen::Vector3f> points;
  points.reserve(indices.size());
  for (const int i : indices) points.push_back(scan.points[i]);
  return points;
}

double mean_time(const std::vector<float>& times, const std::vector<int>& points) {
  if (times.empty() || points.empty()) return 0;
  double sum = 0;
  for (const int i : points) sum += times[static_cast<std::size_t>(i)];
  return sum / static_cast<double>(points.size());
}

}  // namespace lidar_upsampling
