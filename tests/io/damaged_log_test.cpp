// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <gtest/gtest.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <algorithm>
#include <cmath>

#include "damage.h"
#include "lidar_upsampling/io/packer.h"
#include "small_logs.h"
#include "test_folder.h"

namespace lidar_upsampling {
namespace {

/// A log whose damage is left out: which of its odometry is there, and what is told.
struct Salvaged {
  std::vector<int> numbers;
  std::size_t num_objects = 0;
  std::string told;
};

Salvaged salvaged(const Bytes& file) {
  const TestFolder folder;
  write_bytes(folder / "a.rawlog", file);
  RawlogReader reader({folder / "a.rawlog", true});
  Salvaged result;
  while (const auto entry = reader.next()) {
    ++result.num_objects;
    const auto read = std::dynamic_pointer_cast<mrpt::obs::CObservationOdometry>(entry->object);
    if (!read) continue;
    result.numbers.push_back(static_cast<int>(std::lround(read->odometry.x() / 0.1)));
  }
  result.told = reader.damage().value_or("");
  EXPECT_EQ(result.told.find('\n'), std::string::npos);
  return result;
}

Bytes packed(const Bytes& bytes) { return make_packer(Compression::fast)->pack(bytes); }

std::vector<Bytes> odometry_bytes(int count) {
  std::vector<Bytes> parts;
  for (int i = 0; i < count; ++i) parts.push_back(entry_of(odometry(i)).bytes);
  return parts;
}

void expect_told(const Salvaged& log, const std::string& words) {
  EXPECT_NE(log.told.find(words), std::string::npos) << log.told;
}

TEST(SalvagedLog, goes_on_behind_a_damaged_object_with_the_next_one) {
  std::vector<Bytes> parts = odometry_bytes(6);
  const auto whole_size = parts[2].size();
  parts[2][10] ^= 1U;  // of its class's name
  for (const Bytes& file : {joined(parts), packed(joined(parts))}) {
    const Salvaged log = salvaged(file);
    EXPECT_EQ(log.numbers, (std::vector<int>{0, 1, 3, 4, 5}));
    expect_told(log, "broken after 2 good objects");
    expect_told(log, "left out: " + std::to_string(whole_size) + " bytes of that data until 2019");
  }
}

TEST(SalvagedLog, goes_on_behind_sizes_that_take_what_follows_for_their_own) {
  const Bytes broken = range_picture_of(1000, 41);
  std::vector<Bytes> parts = odometry_bytes(200);
  parts.insert(parts.begin() + 1, broken);
  const Salvaged log = salvaged(joined(parts));
  EXPECT_EQ(log.numbers.size(), 200U);
  expect_told(log, "left out: " + std::to_string(broken.size()) + " bytes");
}

TEST(SalvagedLog, counts_the_places_where_it_is_damaged) {
  std::vector<Bytes> parts = odometry_bytes(9);
  for (const std::size_t i : {2U, 5U, 8U}) parts[i].resize(parts[i].size() - 3);
  const Salvaged log = salvaged(joined(parts));
  EXPECT_EQ(log.numbers, (std::vector<int>{0, 1, 3, 4, 6, 7}));
  expect_told(log, "in 2 places, the last one until 2019");
  expect_told(log, "and what is at its end");
}

TEST(SalvagedLog, goes_on_with_the_gzip_member_behind_a_damaged_one) {
  std::vector<Bytes> members;
  for (const Bytes& part : odometry_bytes(7)) members.push_back(packed(part));
  const std::vector<Bytes> whole = members;
  constexpr std::size_t kHeader = 10;
  for (std::size_t at = kHeader; at < members[3].size(); ++at) {
    members = whole;
    members[3][at] ^= 0x10U;
    const Salvaged log = salvaged(joined(members));
    EXPECT_GE(log.numbers.size(), 6U) << at;
    EXPECT_EQ(log.numbers.back(), 6) << at;
  }
}

TEST(SalvagedLog, of_a_member_whose_header_alone_is_damaged_has_all) {
  const Bytes first = packed(joined(odometry_bytes(3)));
  Bytes second = first;
  second[0] ^= 1U;
  const Salvaged log = salvaged(joined({first, second, first}));
  EXPECT_EQ(log.numbers, (std::vector<int>{0, 1, 2, 0, 1, 2, 0, 1, 2}));
  expect_told(log, "what follows it is none");
  expect_told(log, "left out: 0 bytes of that data and 10 of the file");
}

TEST(SalvagedLog, of_one_gzip_member_has_what_comes_before_the_damage) {
  Bytes file = packed(joined(odometry_bytes(4000)));
  std::fill_n(file.begin() + static_cast<std::ptrdiff_t>(file.size() / 2), 64, std::uint8_t{0xff});
  const Salvaged log = salvaged(file);
  ASSERT_GT(log.numbers.size(), 1000U);
  EXPECT_LT(log.numbers.size(), 4000U);
  for (std::size_t i = 0; i < log.numbers.size(); ++i)
    EXPECT_EQ(log.numbers[i], static_cast<int>(i));
  expect_told(log, "broken after");
}

TEST(SalvagedLog, of_frames_does_not_take_a_damaged_ones_observations_for_frames) {
  mrpt::obs::CSensoryFrame frame;
  for (int i = 0; i < 3; ++i) frame.insert(odometry(i));
  const Bytes actions = entry_of(mrpt::obs::CActionCollection::Create()).bytes;
  Bytes good;
  mrpt::serialization::ObjectToOctetVector(&frame, good);
  Bytes broken = good;
  broken.resize(broken.size() - 1);
  const Salvaged log = salvaged(joined({actions, good, actions, broken, actions, good}));
  EXPECT_EQ(log.numbers, std::vector<int>{});
  EXPECT_EQ(log.num_objects, 5U);
  expect_told(log, "left out: " + std::to_string(broken.size()) + " bytes");
}

TEST(SalvagedLog, that_ends_in_the_middle_of_an_object_lacks_that) {
  Bytes file = joined(odometry_bytes(3));
  file.resize(file.size() - 4);
  const Salvaged log = salvaged(file);
  EXPECT_EQ(log.numbers, (std::vector<int>{0, 1}));
  expect_told(log, "in the middle of an object");
  expect_told(log, "to its end");
}

TEST(SalvagedLog, without_damage_tells_of_none) {
  const Salvaged log = salvaged(packed(joined(odometry_bytes(3))));
  EXPECT_EQ(log.numbers.size(), 3U);
  EXPECT_EQ(log.told, "");
}

}  // namespace
}  // namespace lidar_upsampling
