// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "scan_feed.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationPointCloud.h>

#include <filesystem>
#include <fstream>

#include "evaluate/stamps.h"
#include "io/test_folder.h"
#include "lidar_upsampling/io/carriers.h"

namespace lidar_upsampling {
namespace {

using mrpt::obs::CObservationPointCloud;

/// A log of two scans of one point, x metres ahead, which lie in files of the same names as another
/// such log's.
LogFile log_of_external_scans(const TestFolder& folder, const std::string& name, float x) {
  const std::string files = folder / (name + "_Images");
  std::filesystem::create_directory(files);
  RawlogWriter writer(folder / (name + ".rawlog"), false);
  for (const int number : {1, 2}) {
    const std::string file = std::to_string(number) + ".bin";
    const float point[4] = {x, 0, 0, 0};
    std::ofstream(std::filesystem::path(files) / file, std::ios::binary)
        .write(reinterpret_cast<const char*>(point), sizeof point);
    CObservationPointCloud scan;
    scan.sensorLabel = "LIDAR";
    scan.timestamp = at(number);
    scan.setAsExternalStorage(file, CObservationPointCloud::ExternalStorageFormat::KittiBinFile);
    writer.write(scan);
  }
  writer.commit();
  return {folder / (name + ".rawlog")};
}

TEST(ScanFeed, leaves_the_external_files_of_a_log_in_hand_where_they_are) {
  const TestFolder folder;
  RawlogReader in_hand(log_of_external_scans(folder, "a", 5));
  const RawlogEntry first = *in_hand.next();
  ScanFeed feed(log_of_external_scans(folder, "b", 9),
                [](const std::string&, Stamp) { return true; });
  EXPECT_EQ(feed.next()->points.front().x(), 9);
  const auto scan =
      scan_from_observation(dynamic_cast<const mrpt::obs::CObservation&>(*first.object));
  EXPECT_EQ(scan->points.front().x(), 5);
  EXPECT_EQ(feed.next()->points.front().x(), 9);
}

}  // namespace
}  // namespace lidar_upsampling
