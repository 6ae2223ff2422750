// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/io/gzip_members.h"

#include <isa-l/igzip_lib.h>
#include <unistd.h>

#include <array>
#include <memory>
#include <vector>

namespace lidar_upsampling {
namespace {

constexpr std::size_t kHeader = 10;  // without optional fields, of which nobody writes any
constexpr std::size_t kBlock = 1U << 18U;

using Bytes = std::vector<std::uint8_t>;

void read_at(int file, std::uint64_t from, Bytes& bytes) {
  bytes.resize(kBlock);
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t got =
        pread(file, bytes.data() + done, bytes.size() - done, static_cast<off_t>(from + done));
    if (got <= 0) break;
    done += static_cast<std::size_t>(got);
  }
  bytes.resize(done);
}

// Of what is none, codes make no sense after some bytes at most.
bool can_be_unpacked(const std::uint8_t* bytes, std::size_t size, std::uint32_t format) {
  const auto state = std::make_unique<inflate_state>();
  Bytes out(1U << 16U);
  isal_inflate_init(state.get());
  state->crc_flag = format;
  state->next_in = const_cast<std::uint8_t*>(bytes);  // only read
  state->avail_in = static_cast<std::uint32_t>(size);
  state->next_out = out.data();
  state->avail_out = static_cast<std::uint32_t>(out.size());
  return isal_inflate(state.get()) == ISAL_DECOMP_OK && state->total_out > 0;
}

bool begins_member(const std::uint8_t* bytes) {
  constexpr std::uint8_t kDeflate = 8, kUnknownFlags = 0xe0;
  return bytes[0] == 0x1f && bytes[1] == 0x8b && bytes[2] == kDeflate &&
         (bytes[3] & kUnknownFlags) == 0;
}

}  // namespace

std::optional<GzipMember> next_gzip_member(int file, std::uint64_t from, bool expected) {
  Bytes bytes;
  read_at(file, from, bytes);
  if (expected && bytes.size() > kHeader &&
      can_be_unpacked(bytes.data() + kHeader, bytes.size() - kHeader, ISAL_GZIP_NO_HDR_VER))
    return GzipMember{from + kHeader, false};
  while (bytes.size() > kHeader) {
    for (std::size_t i = 0; i + kHeader < bytes.size(); ++i) {
      if (!begins_member(bytes.data() + i)) continue;
      Bytes ahead;
      read_at(file, from + i, ahead);
      if (can_be_unpacked(ahead.data(), ahead.size(), ISAL_GZIP)) return GzipMember{from + i, true};
    }
    from += bytes.size() - kHeader;
    read_at(file, from, bytes);
  }
  return {};
}

}  // namespace lidar_upsampling
