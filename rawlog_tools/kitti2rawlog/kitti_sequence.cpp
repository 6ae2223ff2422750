// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "kitti2rawlog/kitti_sequence.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "import/input_file.h"
#include "lidar_upsampling/se3.h"

namespace lidar_upsampling::kitti {
namespace {

constexpr double kLongestDrive = 1e6;  // s

std::string place(const std::string& path, std::size_t line) {
  return path + ", line " + std::to_string(line);
}

std::vector<double> numbers_of(const std::string& line) {
  std::istringstream in(line);
  std::vector<double> numbers;
  for (double value = 0; in >> value;) numbers.push_back(value);
  if (!in.eof()) numbers.push_back(NAN);
  return numbers;
}

// The rows of a table of numbers; empty lines at its end do not count.
std::vector<std::vector<double>> read_rows(const std::string& path, const std::string& what,
                                           std::size_t columns) {
  std::ifstream in = importing::open_file(path);
  if (!in) throw std::runtime_error("cannot read the " + what + " " + path);
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(in, line);) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    rows.push_back(numbers_of(line));
    bool good = rows.back().size() == columns;
    for (const double value : rows.back()) good = good && std::isfinite(value);
    if (!good) {
      throw std::runtime_error(place(path, rows.size()) + ": '" + line + "' are not " +
                               std::to_string(columns) + " numbers");
    }
  }
  return rows;
}

}  // namespace

FrameStamps read_times(const std::string& path) {
  const Stamp epoch = parse_stamp("1970-01-01 00:00:00").value();
  FrameStamps stamps;
  for (const auto& row : read_rows(path, "times", 1)) {
    if (row[0] < 0 || row[0] > kLongestDrive) {
      throw std::runtime_error(place(path, stamps.size() + 1) + ": " + std::to_string(row[0]) +
                               " s is no time since the first frame");
    }
    stamps.emplace_back(shifted(epoch, row[0]));
  }
  return stamps;
}

std::vector<Pose> read_poses(const std::string& path, const Pose& T_vehicle_camera_0) {
  std::vector<Pose> poses;
  for (const auto& row : read_rows(path, "poses", 12)) {
    using Stored = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;
    const Eigen::Map<const Stored> T(row.data());
    Pose T_first_camera = Pose::Identity();
    T_first_camera.linear() = T.leftCols<3>();
    T_first_camera.translation() = T.col(3);
    // The files hold seven digits, so rotations are not quite orthogonal.
    poses.push_back(T_vehicle_camera_0 * renormalized(T_first_camera) *
                    T_vehicle_camera_0.inverse());
  }
  return poses;
}

}  // namespace lidar_upsampling::kitti
