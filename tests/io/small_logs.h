// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationOdometry.h>

#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "lidar_upsampling/io/images.h"
#include "lidar_upsampling/io/packed_reader.h"
#include "lidar_upsampling/io/rawlog_stream.h"

namespace lidar_upsampling {

using Bytes = std::vector<std::uint8_t>;

inline mrpt::obs::CObservationOdometry::Ptr odometry(int i) {
  auto observation = mrpt::obs::CObservationOdometry::Create();
  observation->sensorLabel = "ODO";
  observation->timestamp = Stamp(mrpt::Clock::duration(132000000000000000LL + i * 1000003LL));
  observation->odometry = mrpt::poses::CPose2D(0.1 * i, 0.2, 0.3);
  return observation;
}

inline mrpt::obs::CObservationImage::Ptr colour_picture() {
  CameraImage image;
  image.camera.label = "CAM";
  image.camera.model.width = 40;
  image.camera.model.height = 30;
  image.bgr = cv::Mat(30, 40, CV_8UC3);
  cv::theRNG().state = 7;
  cv::randu(image.bgr, 0, 256);
  return observation_from_image(image);
}

inline void write_log(const std::string& path, int num_objects) {
  RawlogWriter writer(path, false);
  for (int i = 0; i < num_objects; ++i) writer.write(*odometry(i));
  writer.commit();
}

inline Bytes file_bytes(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline void write_bytes(const std::string& path, const Bytes& bytes) {
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
}

[[nodiscard]] inline Bytes joined(const std::vector<Bytes>& parts) {
  Bytes all;
  for (const Bytes& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

inline Bytes uncompressed(const std::string& path) {
  PackedReader reader(path);
  Bytes all, block(1U << 20U);
  while (const std::size_t step = reader.Read(block.data(), block.size()))
    all.insert(all.end(), block.data(), block.data() + step);
  EXPECT_FALSE(reader.defect());
  return all;
}

struct ReadResult {
  int num_good = 0;
  std::string error;  // empty: a clean end
};

inline ReadResult read_all(const std::string& path) {
  ReadResult result;
  try {
    RawlogReader reader(path);
    while (reader.next()) ++result.num_good;
  } catch (const CorruptRawlog& error) {
    result.error = error.what();
  }
  return result;
}

inline std::size_t num_files(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder),
                                                std::filesystem::directory_iterator()));
}
}  // namespace lidar_upsampling
