// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <gtest/gtest.h>
#include <mrpt/obs/CObservation3DScene.h>

#include <algorithm>

#include "lidar_upsampling/compat/mrpt.h"
#include "lidar_upsampling/io/rawlog_stream.h"
#include "small_logs.h"
#include "test_folder.h"

namespace lidar_upsampling {
namespace {

/// Where the name of an object's class ends among its bytes.
std::size_t end_of_name(const Bytes& bytes, const std::string& name) {
  const auto at = std::search(bytes.begin(), bytes.end(), name.begin(), name.end());
  EXPECT_NE(at, bytes.end());
  return static_cast<std::size_t>(at - bytes.begin()) + name.size();
}

/// What is said of a log of a good object and this one.
std::string error_of(const Bytes& object) {
  const TestFolder folder;
  write_bytes(folder / "a.rawlog", joined({entry_of(odometry(0)).bytes, object}));
  const ReadResult result = read_all(folder / "a.rawlog");
  EXPECT_EQ(result.num_good, 1);
  EXPECT_EQ(result.error.find('\n'), std::string::npos) << result.error;
  return result.error;
}

TEST(LogsOfANewerMrpt, whose_class_has_another_version_are_told_by_class_and_version) {
  const auto object = odometry(1);
  Bytes bytes = entry_of(object).bytes;
  bytes.at(end_of_name(bytes, object->GetRuntimeClass()->className)) = 99;
  const std::string error = error_of(bytes);
  EXPECT_NE(error.find("class mrpt::obs::CObservationOdometry of version 99 is not known here"),
            std::string::npos)
      << error;
}

TEST(LogsOfANewerMrpt, whose_object_holds_one_of_an_unknown_class_are_told_by_that) {
  const auto scene = compat::Scene::Create();
  mrpt::obs::CObservation3DScene observation;
  observation.scene = scene;
  Bytes bytes;
  mrpt::serialization::ObjectToOctetVector(&observation, bytes);
  const std::string name = scene->GetRuntimeClass()->className;
  bytes.at(end_of_name(bytes, name) - 1) = 'Q';
  const std::string error = error_of(bytes);
  EXPECT_NE(error.find("class " + name.substr(0, name.size() - 1) + "Q is not known here"),
            std::string::npos)
      << error;
}

}  // namespace
}  // namespace lidar_upsampling
