// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "pictures.h"

#include <cmath>
#include <filesystem>
#include <iomanip>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <stdexcept>

#include "lidar_upsampling/io/output_file.h"

namespace lidar_upsampling {
namespace {

std::string numbered(int number, const std::string& what) {
  std::ostringstream name;
  name << std::setw(4) << std::setfill('0') << number << '_' << what << ".png";
  return name.str();
}

}  // namespace

void write_picture(const std::string& path, const cv::Mat& picture) {
  std::vector<std::uint8_t> bytes;
  if (!cv::imencode(".png", picture, bytes))
    throw std::runtime_error(path + ": cannot be made a PNG");
  OutputFile file(path, {true});
  file.write(bytes.data(), bytes.size());
  file.commit();
}

Pictures::Pictures(std::string folder) : folder_(std::move(folder)) {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error) throw std::runtime_error(folder_ + ": cannot make this folder: " + error.message());
}

void Pictures::real_scan(const LidarScan& scan) {
  constexpr int kWidth_px = 896;
  if (real_.points.empty()) {
    view_ = BirdView::for_scan(scan, kWidth_px);
    depths_ = DepthScale::for_scan(scan);
  }
  real_ = scan;
}

void Pictures::virtual_scan(const VirtualScan& scan) {
  constexpr double kSameInstant_s = 0.01;
  const BirdScene scene = scene_of(scan);
  trails_.remember(scene);
  std::vector<Camera> cameras;
  for (const auto& [label, image] : images_) {
    cameras.push_back(image.camera);
    if (std::abs(seconds_between(image.stamp, scan.scan.stamp)) < kSameInstant_s)
      write(numbered(number_, names_.of(label)), on_image(scan, image, depths_));
  }
  write(numbered(number_, "from_above"),
        from_above(scene, &real_, trails_, cameras, real_.T_vehicle_lidar, view_));
  ++number_;
}

void Pictures::write(const std::string& name, const cv::Mat& picture) const {
  write_picture((std::filesystem::path(folder_) / name).string(), picture);
}

}  // namespace lidar_upsampling
