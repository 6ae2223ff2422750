// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "npz_layout.h"

#include <zlib.h>

#include <cstdint>
#include <fstream>
#include <string>

namespace fs = std::filesystem;

namespace lidar_upsampling {
namespace {

template <typename Number>
void append(std::string& bytes, Number value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string deflated(const std::string& bytes) {
  z_stream stream{};
  deflateInit2(&stream, 6, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY);
  std::string out(bytes.size() + 1000, '\0');
  std::string in = bytes;
  stream.next_in = reinterpret_cast<Bytef*>(in.data());
  stream.avail_in = static_cast<uInt>(in.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

std::string npy_of(const LidarScan& scan) {
  std::string header = "{'descr': '<f8', 'fortran_order': False, 'shape': (" +
                       std::to_string(scan.size()) + ", 4), }";
  while ((10 + header.size() + 1) % 64 != 0) header += ' ';
  header += '\n';
  std::string npy("\x93NUMPY\x01\0", 8);
  append(npy, static_cast<std::uint16_t>(header.size()));
  npy += header;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    for (int k = 0; k < 3; ++k) append(npy, static_cast<double>(scan.points[i][k]));
    append(npy, static_cast<double>(scan.intensity[i]));
  }
  return npy;
}

// The fields that both the header before a file and its entry in the directory have; numpy leaves
// the sizes to an extra field in the former.
std::string common_fields(bool packed, std::uint32_t packed_size, std::uint32_t size,
                          std::uint16_t extra) {
  std::string fields;
  for (const int value : {20, 0, packed ? 8 : 0, 0, 0}) {
    append(fields, static_cast<std::uint16_t>(value));
  }
  append(fields, std::uint32_t{0});  // checksum
  append(fields, packed_size);
  append(fields, size);
  append(fields, std::uint16_t{8});
  append(fields, extra);
  return fields;
}

}  // namespace

void write_npz(const fs::path& file, const LidarScan& scan, bool packed) {
  const std::string npy = npy_of(scan), content = packed ? deflated(npy) : npy;
  const auto size = static_cast<std::uint32_t>(npy.size());
  const auto packed_size = static_cast<std::uint32_t>(content.size());
  std::string zip = "PK\x03\x04" + common_fields(packed, ~0U, ~0U, 20) + "data.npy";
  append(zip, std::uint32_t{0x00100001});
  append(zip, std::uint64_t{size});
  append(zip, std::uint64_t{packed_size});
  zip += content;
  const auto directory = static_cast<std::uint32_t>(zip.size());
  zip += "PK\x01\x02";
  append(zip, std::uint16_t{20});
  zip += common_fields(packed, packed_size, size, 0) + std::string(14, '\0') + "data.npy";
  const auto end = static_cast<std::uint32_t>(zip.size());
  zip += std::string("PK\x05\x06\0\0\0\0\x01\0\x01\0", 12);
  append(zip, end - directory);
  append(zip, directory);
  append(zip, std::uint16_t{0});
  std::ofstream(file, std::ios::binary) << zip;
}

}  // namespace lidar_upsampling
