// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "scan_files.h"

#include "lidar_upsampling/io/output_file.h"

namespace lidar_upsampling::exporting {
namespace {

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "numbers are written as memory has them");

template <typename Number>
void append(std::string& bytes, Number value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void append_position(std::string& bytes, const Eigen::Vector3f& point) {
  for (int k = 0; k < 3; ++k) append(bytes, point[k]);
}

std::string ply_header(const LidarScan& scan) {
  std::string header = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                       std::to_string(scan.size()) +
                       "\nproperty float x\nproperty float y\nproperty float z\n";
  if (!scan.intensity.empty()) header += "property float intensity\n";
  if (!scan.ring.empty()) header += "property ushort ring\n";
  if (!scan.column.empty()) header += "property ushort column\n";
  if (!scan.time_s.empty()) header += "property float time\n";
  return header + "end_header\n";
}

}  // namespace

void write_ply(const std::string& path, const LidarScan& scan) {
  std::string bytes = ply_header(scan);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    append_position(bytes, scan.points[i]);
    if (!scan.intensity.empty()) append(bytes, scan.intensity[i]);
    if (!scan.ring.empty()) append(bytes, scan.ring[i]);
    if (!scan.column.empty()) append(bytes, scan.column[i]);
    if (!scan.time_s.empty()) append(bytes, scan.time_s[i]);
  }
  write_file(path, bytes);
}

void write_bin(const std::string& path, const LidarScan& scan) {
  std::string bytes;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    append_position(bytes, scan.points[i]);
    append(bytes, scan.intensity.empty() ? 0.F : scan.intensity[i]);
  }
  write_file(path, bytes);
}

}  // namespace lidar_upsampling::exporting
