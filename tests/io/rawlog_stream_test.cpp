// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/io/rawlog_stream.h"

#include <gtest/gtest.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>

#include "lidar_upsampling/io/gzip_file.h"
#include "lidar_upsampling/io/images.h"
#include "lidar_upsampling/io/sensory_frame.h"
#include "test_folder.h"

namespace fs = std::filesystem;

namespace lidar_upsampling {
namespace {

using Bytes = std::vector<std::uint8_t>;

mrpt::obs::CObservationOdometry::Ptr odometry(int i) {
  const auto observation = mrpt::obs::CObservationOdometry::Create();
  observation->sensorLabel = "ODO";
  observation->timestamp = Stamp(mrpt::Clock::duration(132000000000000000LL + i * 1000003LL));
  observation->odometry = mrpt::poses::CPose2D(0.1 * i, 0.2, 0.3);
  return observation;
}

mrpt::obs::CObservationImage::Ptr colour_picture() {
  CameraImage image;
  image.camera.label = "CAM";
  image.camera.model.width = 40;
  image.camera.model.height = 30;
  image.bgr = cv::Mat(30, 40, CV_8UC3);
  cv::theRNG().state = 7;
  cv::randu(image.bgr, 0, 256);
  return observation_from_image(image);
}

void write_log(const std::string& path, int num_objects) {
  RawlogWriter writer(path, false);
  for (int i = 0; i < num_objects; ++i) writer.write(*odometry(i));
  writer.commit();
}

Bytes file_bytes(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write_bytes(const std::string& path, const Bytes& bytes) {
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
}

Bytes uncompressed(const std::string& path) {
  RecordingGzipReader reader(path);
  Bytes all(1U << 24U);
  all.resize(reader.Read(all.data(), all.size()));
  EXPECT_FALSE(reader.defect());
  return all;
}

struct ReadResult {
  int num_good = 0;
  std::string error;  // empty: a clean end
};

ReadResult read_all(const std::string& path) {
  ReadResult result;
  try {
    RawlogReader reader(path);
    while (reader.next()) ++result.num_good;
  } catch (const CorruptRawlog& error) {
    result.error = error.what();
  }
  return result;
}

std::size_t num_files(const fs::path& folder) {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(RawlogStream, what_is_written_is_read_again) {
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

TEST(RawlogStream, copied_entries_are_the_same_byte_for_byte) {
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

TEST(RawlogStream, colour_pictures_are_written_without_loss) {
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

TEST(RawlogStream, a_gzip_log_cut_anywhere_never_ends_quietly) {
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

TEST(RawlogStream, a_plain_log_cut_within_an_object_never_ends_quietly) {
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

TEST(RawlogStream, a_cut_log_says_how_many_objects_are_good) {
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

TEST(RawlogStream, a_damaged_gzip_log_never_ends_quietly) {
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

TEST(RawlogStream, logs_joined_by_cat_are_read_through) {
  const TestFolder folder;
  write_log(folder / "a.rawlog", 3);
  Bytes twice = file_bytes(folder / "a.rawlog");
  twice.insert(twice.end(), twice.begin(), twice.end());
  write_bytes(folder / "aa.rawlog", twice);
  const ReadResult result = read_all(folder / "aa.rawlog");
  EXPECT_EQ(result.error, "");
  EXPECT_EQ(result.num_good, 6);
}

TEST(RawlogStream, another_file_is_no_rawlog) {
  const TestFolder folder;
  const std::string text = "# a readme, and certainly no log\nwith two lines\n";
  write_bytes(folder / "a.rawlog", {text.begin(), text.end()});
  const ReadResult result = read_all(folder / "a.rawlog");
  EXPECT_NE(result.error.find("is no rawlog"), std::string::npos) << result.error;
  write_bytes(folder / "empty.rawlog", {});
  EXPECT_NE(read_all(folder / "empty.rawlog").error.find("empty"), std::string::npos);
}

TEST(RawlogStream, an_unknown_class_is_named) {
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

TEST(RawlogStream, a_missing_input_or_a_folder_is_named) {
  const TestFolder folder;
  EXPECT_THROW(RawlogReader(folder / "none.rawlog"), std::runtime_error);
  EXPECT_THROW(RawlogReader(folder / ""), std::runtime_error);
}

TEST(RawlogStream, output_appears_only_when_complete) {
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

TEST(RawlogStream, an_existing_output_is_replaced_only_if_told) {
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

TEST(RawlogStream, a_link_as_output_stays_a_link) {
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

TEST(RawlogStream, a_full_disk_is_an_error_and_leaves_nothing) {
  const TestFolder folder;
  const auto picture = colour_picture();
  const auto write_pictures = [&](int count) {
    RawlogWriter writer(folder / "a.rawlog", false, 0);
    for (int i = 0; i < count; ++i) writer.write(*picture);
    writer.commit();
  };
  {
    const FileSizeLimit limit(3000);
    EXPECT_THROW(write_pictures(1), std::runtime_error);  // noticed on closing: all fits the buffer
    EXPECT_THROW(write_pictures(1000), std::runtime_error);
  }
  EXPECT_EQ(num_files(folder.path()), 0U);
  EXPECT_NO_THROW(write_pictures(1));
}

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
