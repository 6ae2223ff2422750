// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "import/log_items.h"

#include <mrpt/obs/CObservationRobotPose.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <system_error>

#include "import/input_file.h"
#include "lidar_upsampling/io/images.h"
#include "lidar_upsampling/io/reading_guard.h"

namespace lidar_upsampling::importing {
namespace {

cv::Mat load_picture(const std::string& path) {
  check_is_no_pipe(path);
  std::error_code not_there;
  const auto size = std::filesystem::file_size(path, not_there);
  const ReadingGuard guard([&] { return not_there ? 0 : size; });
  try {
    cv::Mat pixels = cv::imread(path, cv::IMREAD_ANYCOLOR);
    if (!pixels.empty()) return pixels;
  } catch (const std::exception&) {  // says no more
  }
  throw std::runtime_error(path + " holds no picture, or a broken one");
}

}  // namespace

void check_room(const FileUse& output, const std::vector<LogItem>& items) {
  constexpr double kLeastShare = 0.2;  // of text; pictures take more than in their files
  double total = 0;
  for (const LogItem& item : items) {
    std::error_code not_there;
    const auto size = item.file.empty() ? 0 : std::filesystem::file_size(item.file, not_there);
    if (!not_there) total += static_cast<double>(size);
  }
  check_room(output, kLeastShare * total);
}

void write_items(RawlogWriter& writer, std::vector<LogItem> items,
                 const std::function<void(double)>& progress) {
  std::stable_sort(items.begin(), items.end(),
                   [](const LogItem& a, const LogItem& b) { return a.stamp < b.stamp; });
  for (std::size_t i = 0; i < items.size(); ++i) {
    writer.write(*items[i].make());
    progress(static_cast<double>(i + 1) / static_cast<double>(items.size()));
  }
}

mrpt::obs::CObservation::Ptr pose_observation(const PoseSample& sample, const std::string& label) {
  const auto observation = mrpt::obs::CObservationRobotPose::Create();
  observation->timestamp = sample.stamp;
  observation->sensorLabel = label;
  observation->pose.mean = to_mrpt(sample.T_world_vehicle);
  return observation;
}

CameraImage read_picture(const std::string& path, Stamp stamp, const Camera& camera) {
  const cv::Mat pixels = load_picture(path);
  if (pixels.cols != camera.model.width || pixels.rows != camera.model.height) {
    throw std::runtime_error(
        path + " has " + std::to_string(pixels.cols) + " x " + std::to_string(pixels.rows) +
        " pixels, its calibration says " + std::to_string(camera.model.width) + " x " +
        std::to_string(camera.model.height) + ": not of the same day, or not rectified");
  }
  CameraImage image;
  image.stamp = stamp;
  image.camera = camera;
  if (pixels.channels() == 1) {
    image.gray = pixels;
  } else {
    image.bgr = pixels;
    cv::cvtColor(pixels, image.gray, cv::COLOR_BGR2GRAY);
  }
  return image;
}

cv::Size size_of_picture(const std::string& path) { return load_picture(path).size(); }

}  // namespace lidar_upsampling::importing
