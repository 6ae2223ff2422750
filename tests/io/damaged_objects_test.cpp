// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <mrpt/core/aligned_allocator.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/io/lazy_load_path.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/poses/CPosePDFGaussian.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <array>
#include <limits>
#include <list>
#include <memory>
#include <new>
#include <thread>

#include "damage.h"
#include "lidar_upsampling/io/carriers.h"
#include "lidar_upsampling/io/reading_guard.h"
#include "test_folder.h"

namespace lidar_upsampling {
namespace {

constexpr std::size_t kMany = 5000000;  // numbers of 8 bytes

std::size_t make_numbers() { return std::vector<double>(kMany, 1.).size(); }

// A good object, then this one.
ReadResult read_after_a_good_one(const Bytes& second) {
  const TestFolder folder;
  write_bytes(folder / "a.rawlog", joined({entry_of(odometry(0)).bytes, second}));
  testing::internal::CaptureStderr();
  ReadResult result = read_all(folder / "a.rawlog");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  return result;
}

void expect_told(const ReadResult& result, const std::string& words) {
  EXPECT_EQ(result.num_good, 1);
  EXPECT_NE(result.error.find("broken after 1 good objects, the last one of 2019"),
            std::string::npos)
      << result.error;
  EXPECT_NE(result.error.find(words), std::string::npos) << result.error;
  EXPECT_NE(result.error.find("--accept-truncated"), std::string::npos) << result.error;
  EXPECT_EQ(result.error.find('\n'), std::string::npos) << result.error;
}

TEST(ReadingGuard, memory_that_the_rest_of_a_file_cannot_fill_is_refused) {
  const ReadingGuard guard([] { return 1000000; });
  EXPECT_THROW(make_numbers(), std::bad_alloc);
  EXPECT_THROW(mrpt::obs::CObservation3DRangeScan().rangeImage_setSize(3001, 3000), std::bad_alloc);
}

TEST(ReadingGuard, many_small_pieces_that_the_rest_cannot_fill_are_refused) {
  const auto make_list = [](std::size_t count) {
    std::list<std::array<char, 1000>> list;
    for (std::size_t i = 0; i < count; ++i) list.emplace_back();
    return list.size();
  };
  const ReadingGuard guard([] { return 1000000; });
  EXPECT_EQ(make_list(10000), 10000U);
  EXPECT_THROW(make_list(100000), std::bad_alloc);
}

TEST(ReadingGuard, memory_that_it_can_fill_is_given) {
  const ReadingGuard guard([] { return 100000000; });
  EXPECT_EQ(make_numbers(), kMany);
  EXPECT_NO_THROW(mrpt::obs::CObservation3DRangeScan().rangeImage_setSize(3002, 3000));
}

TEST(ReadingGuard, holds_as_long_as_it_lives_and_for_its_own_thread) {
  {
    const ReadingGuard guard([] { return 0; });
    std::thread([] { EXPECT_EQ(make_numbers(), kMany); }).join();
    {
      const ReadingGuard inner([] { return 100000000; });
      EXPECT_EQ(make_numbers(), kMany);
    }
    {
      const ReadingGuard::Pause pause;
      EXPECT_EQ(make_numbers(), kMany);
    }
    EXPECT_THROW(make_numbers(), std::bad_alloc);
  }
  EXPECT_EQ(make_numbers(), kMany);
}

TEST(ReadingGuard, memory_that_there_is_not_is_an_exception_thereafter) {
  {
    const ReadingGuard guard([] { return 0; });
  }
  constexpr auto kMost = static_cast<std::size_t>(std::numeric_limits<std::ptrdiff_t>::max());
  EXPECT_THROW(mrpt::aligned_malloc(kMost + 64, 16), std::bad_alloc);
#if !defined(__SANITIZE_ADDRESS__)  // it ends the process by itself where memory is short
  EXPECT_THROW(mrpt::aligned_malloc(kMost / 2, 16), std::bad_alloc);
#endif
}

TEST(DamagedObject, a_size_that_the_file_cannot_fill_is_told) {
  const std::uint32_t large = 0x40000000;
  expect_told(read_after_a_good_one(range_picture_of(large, 2)), "bytes");
  expect_told(read_after_a_good_one(range_picture_of(60000, 60000)), "bytes");
  expect_told(read_after_a_good_one(range_picture_of(0xffffffff, 0xffffffff)), "");
}

TEST(DamagedObject, a_small_size_that_is_wrong_is_told_too) {
  expect_told(read_after_a_good_one(range_picture_of(1000, 41)), "in the middle of an object");
}

TEST(DamagedObject, a_size_is_believed_where_the_file_has_the_data) {
  const TestFolder folder;
  mrpt::obs::CObservation3DRangeScan scan;
  scan.hasRangeImage = true;
  scan.rangeImage_setSize(3000, 3000);  // 18 MB
  scan.rangeImage.fill(7);
  {
    RawlogWriter writer(folder / "a.rawlog", false);
    writer.write(*odometry(0));
    writer.write(scan);
    writer.commit();
  }
  const ReadResult result = read_all(folder / "a.rawlog");
  EXPECT_EQ(result.error, "");
  EXPECT_EQ(result.num_good, 2);
}

TEST(DamagedObject, in_a_file_of_its_own_has_no_more_points_than_that_can_hold) {
  const TestFolder folder;
  mrpt::io::setLazyLoadPathBase(folder.path().string());
  mrpt::obs::CObservation3DRangeScan scan;
  scan.hasPoints3D = true;
  scan.resizePoints3DVectors(2);
  scan.points3D_convertToExternalStorage("points.bin", folder.path().string());
  write_bytes(folder / "points.bin", {0xff, 0xff, 0xff, 0x3f, 0, 0, 0, 0});
  try {
    static_cast<void>(scan_from_observation(scan));
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("more than the file can fill"), std::string::npos)
        << error.what();
  }
}

TEST(DamagedObject, a_broken_jpeg_picture_is_told_and_does_not_end_the_process) {
  expect_told(read_after_a_good_one(broken_jpeg()), "JPEG");
}

TEST(DamagedObject, of_a_class_that_has_no_objects_is_told_in_our_line_alone) {
  const std::string name = "mrpt::obs::CObservation";
  Bytes bytes{static_cast<std::uint8_t>(0x80U | name.size())};
  bytes.insert(bytes.end(), name.begin(), name.end());
  bytes.insert(bytes.end(), 20, 0);
  expect_told(read_after_a_good_one(bytes), name);
}

Bytes bytes_of(const mrpt::serialization::CSerializable* object) {
  mrpt::io::CMemoryStream memory;
  mrpt::serialization::archiveFrom(memory).WriteObject(object);
  const auto* const begin = static_cast<const std::uint8_t*>(memory.getRawBufferData());
  return {begin, begin + memory.getTotalBytesCount()};
}

// What stands in the place of a whole object's bytes.
Bytes with_other(const Bytes& all, const Bytes& object, const Bytes& other) {
  const auto place = std::search(all.begin(), all.end(), object.begin(), object.end());
  EXPECT_NE(place, all.end());
  return joined({Bytes(all.begin(), place), other,
                 Bytes(place + static_cast<std::ptrdiff_t>(object.size()), all.end())});
}

TEST(DamagedObject, that_holds_none_or_another_than_it_may_is_told) {
  mrpt::obs::CActionRobotMovement2D action;
  action.estimationMethod = mrpt::obs::CActionRobotMovement2D::emScan2DMatching;
  action.poseChange = mrpt::poses::CPosePDFGaussian::Create();
  const Bytes motion = bytes_of(&*action.poseChange), whole = bytes_of(&action);
  const Bytes actions = bytes_of(std::make_unique<mrpt::obs::CActionCollection>(action).get());
  for (const Bytes& other : {bytes_of(nullptr), entry_of(odometry(0)).bytes}) {
    expect_told(read_after_a_good_one(with_other(actions, whole, other)), "cannot be read");
    expect_told(read_after_a_good_one(with_other(whole, motion, other)), "cannot be read");
  }
}

}  // namespace
}  // namespace lidar_upsampling
