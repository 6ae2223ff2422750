// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <gtest/gtest.h>

#include <cstring>

#include "lidar_upsampling/io/rawlog_stream.h"
#include "small_logs.h"
#include "test_folder.h"

namespace lidar_upsampling {
namespace {

constexpr std::size_t kDescriptor = 4;  // behind the magic number
constexpr std::size_t kWindow = 5;
constexpr std::uint8_t kEightByteSize = 0xc0, kSingleSegment = 0x20;

Bytes zstd_log(int num_objects) {
  const TestFolder folder;
  RawlogWriter writer(folder / "a.rawlog", false, parse_compression("zstd:3"));
  for (int i = 0; i < num_objects; ++i) writer.write(*odometry(i));
  writer.commit();
  return file_bytes(folder / "a.rawlog");
}

ReadResult read_again(const Bytes& bytes) {
  const TestFolder folder;
  write_bytes(folder / "a.rawlog", bytes);
  return read_all(folder / "a.rawlog");
}

/// The frame, which tells no size, with one in its header.
Bytes claiming(Bytes frame, std::uint64_t size, bool single_segment) {
  Bytes stated(sizeof size);
  std::memcpy(stated.data(), &size, sizeof size);
  frame[kDescriptor] |= kEightByteSize;
  if (single_segment) {
    frame[kDescriptor] |= kSingleSegment;
    frame.erase(frame.begin() + kWindow);
  }
  const auto at = frame.begin() + static_cast<long>(single_segment ? kWindow : kWindow + 1);
  frame.insert(at, stated.begin(), stated.end());
  return frame;
}

TEST(ZstdLogs, are_told_by_their_first_bytes_and_read) {
  const Bytes bytes = zstd_log(20);
  EXPECT_EQ(Bytes(bytes.begin(), bytes.begin() + 4), (Bytes{0x28, 0xb5, 0x2f, 0xfd}));
  const ReadResult result = read_again(bytes);
  EXPECT_EQ(result.error, "");
  EXPECT_EQ(result.num_good, 20);
}

TEST(ZstdLogs, of_many_frames_are_read_through) {
  const ReadResult result = read_again(joined({zstd_log(3), zstd_log(0), zstd_log(4)}));
  EXPECT_EQ(result.error, "");
  EXPECT_EQ(result.num_good, 7);
}

TEST(ZstdLogs, hold_the_objects_bytes_as_they_were) {
  const TestFolder folder;
  write_bytes(folder / "a.rawlog", zstd_log(2));
  EXPECT_EQ(uncompressed(folder / "a.rawlog"),
            joined({entry_of(odometry(0)).bytes, entry_of(odometry(1)).bytes}));
}

TEST(ZstdLogs, cut_anywhere_never_end_quietly) {
  const Bytes whole = zstd_log(20);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const ReadResult result = read_again({whole.begin(), whole.begin() + static_cast<long>(size)});
    EXPECT_FALSE(result.error.empty()) << "cut to " << size << " of " << whole.size() << " bytes";
    EXPECT_EQ(result.error.find('\n'), std::string::npos) << result.error;
    if (size > 4) {
      EXPECT_NE(result.error.find("cut off"), std::string::npos) << result.error;
    }
  }
}

TEST(ZstdLogs, damaged_never_end_quietly) {
  const Bytes whole = zstd_log(20);
  for (std::size_t at = 0; at < whole.size(); ++at) {
    if (at == kWindow) continue;  // a larger one than is needed changes nothing
    Bytes damaged = whole;
    damaged[at] ^= 0x40U;
    const ReadResult result = read_again(damaged);
    EXPECT_FALSE(result.error.empty()) << "byte " << at;
    EXPECT_EQ(result.error.find('\n'), std::string::npos) << result.error;
  }
}

TEST(ZstdLogs, what_follows_a_frame_and_is_none_is_a_defect) {
  const ReadResult result = read_again(joined({zstd_log(3), Bytes{'e', 'n', 'd', '.', '.', '.'}}));
  EXPECT_EQ(result.num_good, 3);
  EXPECT_NE(result.error.find("damaged"), std::string::npos) << result.error;
}

TEST(ZstdLogs, a_frame_that_claims_a_hundred_gigabytes_is_refused_without_taking_them) {
  constexpr std::uint64_t kHundredGigabytes = 100'000'000'000;
  const ReadResult at_once = read_again(claiming(zstd_log(20), kHundredGigabytes, true));
  EXPECT_EQ(at_once.num_good, 0);
  EXPECT_NE(at_once.error.find("more memory than any log"), std::string::npos) << at_once.error;
  const ReadResult piece_by_piece = read_again(claiming(zstd_log(20), kHundredGigabytes, false));
  EXPECT_NE(piece_by_piece.error.find("damaged"), std::string::npos) << piece_by_piece.error;
}

}  // namespace
}  // namespace lidar_upsampling
