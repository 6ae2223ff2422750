// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <gtest/gtest.h>

#include <algorithm>

#include "lidar_upsampling/io/rawlog_stream.h"
#include "small_logs.h"
#include "test_folder.h"

namespace lidar_upsampling {
namespace {

TEST(RawlogReader, what_is_written_is_read_again) {
  const TestFolder folder;
  write_log(folder / "a.rawlog", 5);
  RawlogReader reader(folder / "a.rawlog");
  for (int i = 0; i < 5; ++i) {
    const auto entry = reader.next();
    ASSERT_TRUE(entry);
    const auto read = std::dynamic_pointer_cast<mrpt::obs::CObservationOdometry>(entry->object);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->timestamp, odometry(i)->timestamp);
    EXPECT_EQ(read->odometry, odometry(i)->odometry);
  }
  EXPECT_FALSE(reader.next());
  EXPECT_DOUBLE_EQ(reader.progress(), 1);
}

TEST(RawlogReader, a_gzip_log_cut_anywhere_never_ends_quietly) {
  const TestFolder folder;
  write_log(folder / "a.rawlog", 20);
  const Bytes whole = file_bytes(folder / "a.rawlog");
  for (std::size_t size = 0; size < whole.size(); ++size) {
    write_bytes(folder / "cut.rawlog", {whole.begin(), whole.begin() + static_cast<long>(size)});
    const ReadResult result = read_all(folder / "cut.rawlog");
    EXPECT_FALSE(result.error.empty()) << "cut to " << size << " of " << whole.size() << " bytes";
    EXPECT_LE(result.num_good, 20);
  }
}

TEST(RawlogReader, a_plain_log_cut_within_an_object_never_ends_quietly) {
  const TestFolder folder;
  const Bytes one = entry_of(odometry(0)).bytes;
  Bytes two = one;
  two.insert(two.end(), one.begin(), one.end());
  for (std::size_t size = 0; size <= two.size(); ++size) {
    write_bytes(folder / "cut.rawlog", {two.begin(), two.begin() + static_cast<long>(size)});
    const ReadResult result = read_all(folder / "cut.rawlog");
    const bool at_border = size == one.size() || size == two.size();
    EXPECT_EQ(result.error.empty(), at_border) << size << ": " << result.error;
    EXPECT_EQ(result.num_good, static_cast<int>(size / one.size()));
  }
}

TEST(RawlogReader, a_cut_log_says_how_many_objects_are_good) {
  const TestFolder folder;
  Bytes bytes;
  for (int i = 0; i < 3; ++i) {
    const Bytes one = entry_of(odometry(i)).bytes;
    bytes.insert(bytes.end(), one.begin(), one.end());
  }
  bytes.resize(bytes.size() - 4);
  write_bytes(folder / "cut.rawlog", bytes);
  const ReadResult result = read_all(folder / "cut.rawlog");
  EXPECT_EQ(result.num_good, 2);
  EXPECT_NE(result.error.find("2 good objects"), std::string::npos) << result.error;
  EXPECT_NE(result.error.find("in the middle of an object"), std::string::npos) << result.error;
  EXPECT_EQ(result.error.find('\n'), std::string::npos);
}

TEST(RawlogReader, a_damaged_gzip_log_never_ends_quietly) {
  const TestFolder folder;
  write_log(folder / "a.rawlog", 20);
  const Bytes whole = file_bytes(folder / "a.rawlog");
  // Not the header, of which gzip checks little: time stamp and system mean nothing.
  for (std::size_t at = 10; at < whole.size(); at += 7) {
    Bytes damaged = whole;
    damaged[at] ^= 0x10U;
    write_bytes(folder / "damaged.rawlog", damaged);
    EXPECT_FALSE(read_all(folder / "damaged.rawlog").error.empty()) << "byte " << at;
  }
}

TEST(RawlogReader, logs_joined_by_cat_are_read_through) {
  const TestFolder folder;
  write_log(folder / "a.rawlog", 3);
  Bytes twice = file_bytes(folder / "a.rawlog");
  twice.insert(twice.end(), twice.begin(), twice.end());
  write_bytes(folder / "aa.rawlog", twice);
  const ReadResult result = read_all(folder / "aa.rawlog");
  EXPECT_EQ(result.error, "");
  EXPECT_EQ(result.num_good, 6);
}

TEST(RawlogReader, another_file_is_no_rawlog) {
  const TestFolder folder;
  const std::string text = "# a readme, and certainly no log\nwith two lines\n";
  write_bytes(folder / "a.rawlog", {text.begin(), text.end()});
  const ReadResult result = read_all(folder / "a.rawlog");
  EXPECT_NE(result.error.find("is no rawlog"), std::string::npos) << result.error;
  write_bytes(folder / "empty.rawlog", {});
  EXPECT_NE(read_all(folder / "empty.rawlog").error.find("empty"), std::string::npos);
}

TEST(RawlogReader, an_unknown_class_is_named) {
  const TestFolder folder;
  Bytes bytes = entry_of(odometry(0)).bytes;
  Bytes unknown = bytes;
  const std::string name = "mrpt::obs::CObservationOdometry";
  const auto at = std::search(unknown.begin(), unknown.end(), name.begin(), name.end());
  ASSERT_NE(at, unknown.end());
  *(at + static_cast<long>(name.size()) - 1) = 'Q';
  bytes.insert(bytes.end(), unknown.begin(), unknown.end());
  write_bytes(folder / "a.rawlog", bytes);
  const ReadResult result = read_all(folder / "a.rawlog");
  EXPECT_EQ(result.num_good, 1);
  EXPECT_NE(result.error.find("mrpt::obs::CObservationOdometrQ is not known"), std::string::npos)
      << result.error;
}

TEST(RawlogReader, a_missing_input_or_a_folder_is_named) {
  const TestFolder folder;
  EXPECT_THROW(RawlogReader(folder / "none.rawlog"), std::runtime_error);
  EXPECT_THROW(RawlogReader(folder / ""), std::runtime_error);
}

}  // namespace
}  // namespace lidar_upsampling
