// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <mrpt/obs/CObservationImage.h>

#include <filesystem>

#include "end_to_end/stock_maps.h"
#include "lidar_upsampling/io/carriers.h"
#include "lidar_upsampling/io/images.h"

namespace lidar_upsampling {
namespace {

struct Stored {
  std::string name, lidar, label;
  bool taken_back = true;  ///< MRPT 2.5.8 cannot embed external points with rings and columns again
};

void PrintTo(const Stored& stored, std::ostream* out) { *out << stored.name; }

class ExternalStorage : public testing::TestWithParam<Stored> {
 protected:
  /// Virtual scans, real scans and images of a log, wherever they lie.
  static void expect_same_data(const std::vector<Logged>& log, const std::vector<Logged>& whole) {
    EXPECT_EQ(with_label(log, GetParam().label + "_VIRTUAL").size(), 2U);
    const auto scans = with_label(log, GetParam().label);
    const auto expected = with_label(whole, GetParam().label);
    ASSERT_EQ(scans.size(), 2U);
    for (std::size_t i = 0; i < scans.size(); ++i) {
      EXPECT_EQ(scan_from_observation(*scans[i].observation).value().points,
                scan_from_observation(*expected[i].observation).value().points);
    }
    const auto images = with_label(log, "CAM0");
    EXPECT_EQ(images.size(), 4U);
    for (const Logged& image : images) {
      auto& observation = dynamic_cast<mrpt::obs::CObservationImage&>(*image.observation);
      const cv::Mat gray = image_from_observation(observation).gray;
      EXPECT_EQ(gray.cols, 414);
      EXPECT_EQ(gray.rows, 125);
    }
  }
};

/// A stock program run where the log lies, as MRPT 2.5.8 finds external files from there only.
std::string rawlog_edit(const std::string& folder, const std::string& operation,
                        const std::string& input, const std::string& output) {
  return "cd " + folder + " && rawlog-edit " + operation + " -i " + input + " -o " + output;
}

TEST_P(ExternalStorage, is_left_where_it_is_and_found_from_the_outputs_place) {
  if (!has_rawlog_edit()) GTEST_SKIP() << "rawlog-edit is not installed";
  const TestFolder folder;
  simulate(folder, "[scenario]\nduration_s = 0.1\n", GetParam().lidar);
  expect_done(rawlog_edit(folder.path().string(), "--externalize", "in.rawlog", "external.rawlog"));
  const std::string elsewhere = folder / "elsewhere";
  std::filesystem::create_directory(elsewhere);
  expect_done(densify_command(folder / "external.rawlog", elsewhere + "/out.rawlog"));

  const auto whole = observations_of(folder / "in.rawlog");
  const auto external = observations_of(folder / "external.rawlog");
  const auto out = observations_of(elsewhere + "/out.rawlog");
  const auto real = without_label(out, GetParam().label + "_VIRTUAL");
  ASSERT_EQ(real.size(), external.size());
  for (std::size_t i = 0; i < real.size(); ++i) {
    EXPECT_TRUE(real[i].bytes == external[i].bytes) << i;
  }
  expect_same_data(out, whole);
  if (!GetParam().taken_back) return;
  expect_done(rawlog_edit(elsewhere, "--de-externalize", "out.rawlog", "back.rawlog"));
  const auto back = observations_of(elsewhere + "/back.rawlog");
  std::filesystem::remove_all(folder / "external_Images");
  expect_same_data(back, whole);
}

INSTANTIATE_TEST_SUITE_P(
    Scans, ExternalStorage,
    testing::Values(Stored{"points", kSmallLidar, "LIDAR", false},
                    Stored{"point_clouds",
                           std::string(kSmallLidar) + "[log]\ncarrier = pointcloud\n", "LIDAR"},
                    Stored{"range_pictures", kDepthCamera, "DEPTH"}),
    [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace lidar_upsampling
