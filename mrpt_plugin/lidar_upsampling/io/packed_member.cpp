// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/io/packed_member.h"

#include <libdeflate.h>

namespace lidar_upsampling {
namespace {

constexpr std::size_t kTrailer = 8;  // RFC 1952: checksum and size, least significant byte first

std::uint32_t checksum_of(const PackedMember& member) {
  const std::uint8_t* const trailer = member.bytes.data() + member.bytes.size() - kTrailer;
  std::uint32_t checksum = 0;
  for (int i = 3; i >= 0; --i) checksum = checksum << 8U | trailer[i];
  return checksum;
}

}  // namespace

bool ends_with(const std::vector<std::uint8_t>& bytes, const PackedMember& member) {
  if (member.bytes.size() < kTrailer || member.unpacked_size > bytes.size()) return false;
  const std::uint8_t* const begin = bytes.data() + bytes.size() - member.unpacked_size;
  // Not ISA-L's: it leaves the upper halves of vector registers dirty, and what this thread does
  // next by SSE takes twice the time.
  return libdeflate_crc32(0, begin, member.unpacked_size) == checksum_of(member);
}

}  // namespace lidar_upsampling
