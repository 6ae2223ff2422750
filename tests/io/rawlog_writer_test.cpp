// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>

#include "lidar_upsampling/io/rawlog_stream.h"
#include "small_logs.h"
#include "test_folder.h"

namespace fs = std::filesystem;

namespace lidar_upsampling {
namespace {

TEST(RawlogWriter, copied_entries_are_the_same_byte_for_byte) {
  const TestFolder folder;
  {  // a JPEG inside, as other tools write it: decoding and encoding it again would change it
    Bytes bytes = entry_of(odometry(0)).bytes;
    Bytes jpeg;
    mrpt::serialization::ObjectToOctetVector(colour_picture().get(), jpeg);
    bytes.insert(bytes.end(), jpeg.begin(), jpeg.end());
    write_bytes(folder / "a.rawlog", bytes);
  }
  RawlogReader reader(folder / "a.rawlog");
  RawlogWriter writer(folder / "b.rawlog", false);
  while (const auto entry = reader.next()) writer.write(*entry);
  writer.commit();
  EXPECT_EQ(writer.num_written(), 2U);
  EXPECT_EQ(uncompressed(folder / "a.rawlog"), uncompressed(folder / "b.rawlog"));
}

TEST(RawlogWriter, copies_a_log_in_the_members_that_it_was_packed_in) {
  const TestFolder folder;
  const auto picture = colour_picture();
  {
    RawlogWriter writer(folder / "in.rawlog", false, parse_compression("gzip:9"));
    for (int i = 0; i < 300; ++i) writer.write(*picture);
    writer.commit();
  }
  const auto copy = [&](const std::string& name, bool with_others) {
    RawlogReader reader(folder / "in.rawlog");
    RawlogWriter writer(folder / name, false);
    while (const auto entry = reader.next()) {
      writer.write(*entry);
      if (with_others) writer.write(*odometry(1));
    }
    writer.commit();
    return file_bytes(folder / name);
  };
  EXPECT_EQ(copy("same.rawlog", false), file_bytes(folder / "in.rawlog"));
  copy("more.rawlog", true);
  RawlogReader more(folder / "more.rawlog");
  int count = 0;
  while (more.next()) ++count;
  EXPECT_EQ(count, 600);
}

TEST(RawlogWriter, colour_pictures_are_written_without_loss) {
  const TestFolder folder;
  const auto picture = colour_picture();
  {
    RawlogWriter writer(folder / "a.rawlog", false);
    writer.write(*picture);
    writer.commit();
  }
  RawlogReader reader(folder / "a.rawlog");
  const auto read =
      std::dynamic_pointer_cast<mrpt::obs::CObservationImage>(reader.next().value().object);
  EXPECT_EQ(cv::norm(image_from_observation(*read).bgr, image_from_observation(*picture).bgr,
                     cv::NORM_INF),
            0);
}

TEST(RawlogWriter, output_appears_only_when_complete) {
  const TestFolder folder;
  {
    RawlogWriter writer(folder / "a.rawlog", false);
    writer.write(*odometry(0));
    EXPECT_FALSE(fs::exists(folder / "a.rawlog"));
  }
  EXPECT_EQ(num_files(folder.path()), 0U);
  write_log(folder / "a.rawlog", 1);
  EXPECT_EQ(num_files(folder.path()), 1U);
}

TEST(RawlogWriter, an_existing_output_is_replaced_only_if_told) {
  const TestFolder folder;
  write_log(folder / "a.rawlog", 1);
  EXPECT_THROW(RawlogWriter(folder / "a.rawlog", false), std::runtime_error);
  {
    RawlogWriter writer(folder / "a.rawlog", true);
    writer.write(*odometry(0));
    writer.write(*odometry(1));
    EXPECT_EQ(read_all(folder / "a.rawlog").num_good, 1);
    writer.commit();
  }
  EXPECT_EQ(read_all(folder / "a.rawlog").num_good, 2);
  EXPECT_THROW(RawlogWriter("/dev/null", true), std::runtime_error);
  EXPECT_THROW(RawlogWriter(folder.path().string(), true), std::runtime_error);
  EXPECT_THROW(RawlogWriter(folder / "nowhere/a.rawlog", true), std::runtime_error);
}

TEST(RawlogWriter, a_link_as_output_stays_a_link) {
  const TestFolder folder;
  write_log(folder / "a.rawlog", 1);
  fs::create_symlink("a.rawlog", folder / "link.rawlog");
  RawlogWriter writer(folder / "link.rawlog", true);
  writer.write(*odometry(0));
  writer.write(*odometry(1));
  writer.commit();
  EXPECT_TRUE(fs::is_symlink(folder / "link.rawlog"));
  EXPECT_EQ(read_all(folder / "a.rawlog").num_good, 2);
}

// Lets no file grow beyond a size, as a full disk would.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limit = before_;
    limit.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int) = nullptr;
};

TEST(RawlogWriter, a_full_disk_is_an_error_and_leaves_nothing) {
  const TestFolder folder;
  const auto picture = colour_picture();
  const auto write_pictures = [&](int count, Compression compression) {
    RawlogWriter writer(folder / "a.rawlog", false, compression);
    for (int i = 0; i < count; ++i) writer.write(*picture);
    writer.commit();
  };
  {
    const FileSizeLimit limit(1000);
    // One is noticed on closing: all fits the buffer.
    EXPECT_THROW(write_pictures(1, Compression::none), std::runtime_error);
    for (const auto compression : {Compression::none, Compression::fast, Compression::small})
      EXPECT_THROW(write_pictures(5000, compression), std::runtime_error);
  }
  EXPECT_EQ(num_files(folder.path()), 0U);
  EXPECT_NO_THROW(write_pictures(1, Compression::none));
}

}  // namespace
}  // namespace lidar_upsampling
