// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/io/sensory_frame.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CSensoryFrame.h>

#include "small_logs.h"
#include "test_folder.h"

namespace lidar_upsampling {
namespace {

TEST(SensoryFrame, comes_apart_and_together_byte_for_byte) {
  const TestFolder folder;
  mrpt::obs::CSensoryFrame frame;
  frame.insert(odometry(0));
  frame.insert(colour_picture());
  frame.insert(odometry(1));
  Bytes with_jpeg;
  mrpt::serialization::ObjectToOctetVector(&frame, with_jpeg);
  write_bytes(folder / "a.rawlog", with_jpeg);
  RawlogReader reader(folder / "a.rawlog");
  const RawlogEntry entry = reader.next().value();

  std::vector<RawlogEntry> parts = split_frame(entry);
  ASSERT_EQ(parts.size(), 3U);
  EXPECT_EQ(parts[0].bytes, entry_of(odometry(0)).bytes);
  EXPECT_EQ(join_frame(parts).bytes, with_jpeg);

  parts.insert(parts.begin() + 1, entry_of(odometry(7)));
  const RawlogEntry longer = join_frame(parts);
  EXPECT_EQ(std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(longer.object)->size(), 4U);
  write_bytes(folder / "b.rawlog", longer.bytes);
  EXPECT_EQ(read_all(folder / "b.rawlog").error, "");
  const std::vector<RawlogEntry> again = split_frame(longer);
  ASSERT_EQ(again.size(), 4U);
  EXPECT_EQ(again[2].bytes, parts[2].bytes);
}

TEST(SensoryFrame, other_objects_are_refused) {
  EXPECT_THROW(static_cast<void>(split_frame(entry_of(odometry(0)))), std::invalid_argument);
  const RawlogEntry actions = entry_of(mrpt::obs::CActionCollection::Create());
  EXPECT_THROW(static_cast<void>(join_frame({actions})), std::invalid_argument);
}

}  // namespace
}  // namespace lidar_upsampling
