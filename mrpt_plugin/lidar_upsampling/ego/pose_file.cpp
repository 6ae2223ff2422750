// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/ego/pose_file.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "lidar_upsampling/csv_table.h"
#include "lidar_upsampling/se3.h"
#include "lidar_upsampling/text.h"

namespace lidar_upsampling {
namespace {

using Words = std::vector<std::string>;

constexpr double kRotationTolerance = 0.02;  // files hold few digits
constexpr double kFirstUnixTime_s = 1e8;     // before: seconds since the first scan

struct Line {
  std::size_t number;
  Words words;
};

// The lines that hold something, without comments.
std::vector<Line> read_lines(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path + ": cannot read this file of poses");
  std::vector<Line> lines;
  std::string text;
  std::size_t number = 1;
  try {
    for (; next_line(file, text); ++number) {
      std::istringstream stream(text.substr(0, text.find('#')));
      Line line{number, {}};
      for (std::string word; stream >> word;) line.words.push_back(word);
      if (!line.words.empty()) lines.push_back(std::move(line));
    }
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(path + ", line " + std::to_string(number) + ": " + error.what());
  }
  if (lines.empty()) throw std::runtime_error(path + ": holds no poses");
  return lines;
}

double number_of(const std::string& word) {
  if (const auto number = number_in(word)) return *number;
  throw std::invalid_argument("'" + word + "' is no number");
}

// With an exponent, as numpy writes it, too.
Stamp stamp_of(const std::string& word) {
  if (word.find_first_of("eE") == std::string::npos) return parse_stamp(word);
  const double seconds = number_of(word);
  if (seconds < 0 || seconds > 1e10) throw std::invalid_argument("'" + word + "' is no time");
  // A long double holds every tick of such a time; a double would lose some.
  constexpr long double kTicksPerSecond = 1e7L;
  return parse_stamp("0") + Stamp::duration(static_cast<std::int64_t>(
                                std::llround(std::stold(word) * kTicksPerSecond)));
}

Eigen::Matrix3d rotation_of(const Eigen::Quaterniond& q) {
  if (std::abs(q.norm() - 1) > kRotationTolerance)
    throw std::invalid_argument("the quaternion's norm is " + std::to_string(q.norm()) +
                                ", not 1: no rotation");
  return q.normalized().toRotationMatrix();
}

Pose tum_pose(const Words& words) {
  Eigen::Matrix<double, 7, 1> v;
  for (int i = 0; i < 7; ++i) v[i] = number_of(words[i + 1]);
  Pose T = Pose::Identity();
  T.translation() = v.head<3>();
  T.linear() = rotation_of(Eigen::Quaterniond(v[6], v[3], v[4], v[5]));
  return T;
}

Pose kitti_pose(const Words& words) {
  Eigen::Matrix<double, 3, 4, Eigen::RowMajor> rows;
  for (int i = 0; i < 12; ++i) rows.data()[i] = number_of(words[i]);
  const Eigen::Matrix3d R = rows.leftCols<3>();
  if (!(R.transpose() * R).isIdentity(kRotationTolerance) || R.determinant() < 0)
    throw std::invalid_argument("the first three columns are no rotation");
  Pose T = Pose::Identity();
  T.linear() = R;
  T.translation() = rows.col(3);
  return renormalized(T);
}

// Gives what goes wrong in a line its place, and what was expected there.
template <typename Read>
auto in_line(const std::string& path, const Line& line, std::size_t num_words, const char* expected,
             const Read& read) {
  try {
    if (line.words.size() != num_words)
      throw std::invalid_argument(std::to_string(line.words.size()) + " numbers");
    return read(line.words);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(path + ", line " + std::to_string(line.number) + ": " + error.what() +
                             "; expected " + expected);
  }
}

std::vector<PoseSample> read_tum(const std::string& path) {
  std::vector<PoseSample> samples;
  for (const Line& line : read_lines(path))
    samples.push_back(in_line(path, line, 8, "t x y z qx qy qz qw", [](const Words& words) {
      return PoseSample{stamp_of(words[0]), tum_pose(words)};
    }));
  return samples;
}

std::vector<Stamp> read_times(const std::string& path, const std::vector<Stamp>& scans) {
  if (scans.empty()) throw std::runtime_error(path + ": the log has no scans to count from");
  std::vector<Stamp> stamps;
  for (const Line& line : read_lines(path))
    stamps.push_back(in_line(path, line, 1, "a time in seconds", [&](const Words& words) {
      const double seconds = number_of(words[0]);
      return seconds < kFirstUnixTime_s ? shifted(scans.front(), seconds) : stamp_of(words[0]);
    }));
  return stamps;
}

std::vector<PoseSample> read_kitti(const PoseFileOptions& options,
                                   const std::vector<Stamp>& scans) {
  const std::vector<Line> lines = read_lines(options.path);
  const std::vector<Stamp> stamps =
      options.times.empty() ? scans : read_times(options.times, scans);
  if (stamps.size() != lines.size())
    throw std::runtime_error(
        options.path + ": " + std::to_string(lines.size()) + " poses, but " +
        std::to_string(stamps.size()) +
        (options.times.empty()
             ? " scans in the log: a file of times is needed ([ego_motion] poses_times)"
             : " times in " + options.times));
  std::vector<PoseSample> samples;
  for (std::size_t i = 0; i < lines.size(); ++i)
    samples.push_back(
        {stamps[i], in_line(options.path, lines[i], 12,
                            "the 12 numbers of a 3x4 matrix, row by row", kitti_pose)});
  return samples;
}

Eigen::Matrix3d csv_rotation(const CsvTable& table, std::size_t row, const std::string& path) {
  const auto number = [&](const char* column) { return table.number(row, column); };
  if (table.has("yaw"))
    return (Eigen::AngleAxisd(number("yaw"), Eigen::Vector3d::UnitZ()) *
            Eigen::AngleAxisd(number("pitch"), Eigen::Vector3d::UnitY()) *
            Eigen::AngleAxisd(number("roll"), Eigen::Vector3d::UnitX()))
        .toRotationMatrix();
  if (!table.has("qw"))
    throw std::runtime_error(path +
                             ": the header names neither yaw,pitch,roll nor qx,qy,qz,qw; expected "
                             "stamp,x,y,z and one of them");
  try {
    return rotation_of({number("qw"), number("qx"), number("qy"), number("qz")});
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(table.place(row, "qw") + ": " + error.what());
  }
}

std::vector<PoseSample> read_csv(const std::string& path) {
  const CsvTable table(path);
  if (table.num_rows() == 0) throw std::runtime_error(path + ": holds no poses");
  std::vector<PoseSample> samples;
  for (std::size_t row = 0; row < table.num_rows(); ++row) {
    PoseSample sample{table.stamp(row, "stamp"), Pose::Identity()};
    sample.T_world_vehicle.translation() =
        Eigen::Vector3d(table.number(row, "x"), table.number(row, "y"), table.number(row, "z"));
    sample.T_world_vehicle.linear() = csv_rotation(table, row, path);
    samples.push_back(sample);
  }
  return samples;
}

}  // namespace

PoseFileFormat format_of(const PoseFileOptions& options) {
  if (options.format != PoseFileFormat::automatic) return options.format;
  const Line first = read_lines(options.path).front();
  const auto has_comma = [](const std::string& word) {
    return word.find(',') != std::string::npos;
  };
  if (std::any_of(first.words.begin(), first.words.end(), has_comma)) return PoseFileFormat::csv;
  if (first.words.size() == 12) return PoseFileFormat::kitti;
  if (first.words.size() == 8) return PoseFileFormat::tum;
  throw std::runtime_error(options.path + ", line " + std::to_string(first.number) + ": " +
                           std::to_string(first.words.size()) +
                           " numbers; expected 8 (tum), 12 (kitti), or a header with commas (csv)");
}

std::vector<PoseSample> read_pose_file(const PoseFileOptions& options,
                                       const std::vector<Stamp>& scans,
                                       const Pose& T_vehicle_sensor) {
  const PoseFileFormat format = format_of(options);
  std::vector<PoseSample> samples = format == PoseFileFormat::kitti ? read_kitti(options, scans)
                                    : format == PoseFileFormat::csv ? read_csv(options.path)
                                                                    : read_tum(options.path);
  for (PoseSample& sample : samples)
    sample.T_world_vehicle = sample.T_world_vehicle * T_vehicle_sensor.inverse();
  return samples;
}

}  // namespace lidar_upsampling
