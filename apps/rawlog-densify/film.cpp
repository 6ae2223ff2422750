// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "film.h"

#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <vector>

#include "lidar_upsampling/io/output_file.h"

namespace lidar_upsampling {
namespace {

namespace fs = std::filesystem;

constexpr int kPanel_px = 560, kWidth_px = 2 * kPanel_px + 8;
constexpr double kSlower = 3;  // than it was

/// With black beside it, if it would be higher than half of a panel.
cv::Mat fitted(const cv::Mat& picture) {
  constexpr int kHighest_px = 420;
  const double scale =
      std::min(double(kWidth_px) / picture.cols, double(kHighest_px) / picture.rows);
  cv::Mat result;
  cv::resize(picture, result, {}, scale, scale, scale < 1 ? cv::INTER_AREA : cv::INTER_LINEAR);
  return result.rowRange(0, result.rows / 2 * 2);
}

/// glibc puts pictures on the heap once some have been freed. There small things that stay fall
/// into the gaps, which the next picture no longer fits into: 10 MB a second of log. An encoder
/// takes far longer than mapping them anew does.
void map_large_blocks() {
#ifdef M_MMAP_THRESHOLD
  constexpr int kLarge = 1 << 20;
  mallopt(M_MMAP_THRESHOLD, kLarge);
#endif
}

}  // namespace

Film::Film(std::string path) : path_(std::move(path)) {
  const std::string ending = fs::path(path_).extension();
  if (ending != ".mp4" && ending != ".avi" && ending != ".mkv")
    throw std::runtime_error(path_ + ": a film ends in .mp4, .avi or .mkv");
  unfinished_ = std::make_unique<TemporaryName>(path_, ending);
  map_large_blocks();
  writer_ = load_film_writer();
}

void Film::real_scan(const LidarScan& scan) {
  if (!real_) {
    view_ = BirdView::for_scan(scan, kPanel_px);
    depths_ = DepthScale::for_scan(scan);
  }
  real_ = scan;
  as_taken_.release();
}

void Film::image(const CameraImage& image) {
  constexpr std::size_t kMost = 20;  // more than lie between two scans
  if (!images_.empty() && images_.front().camera.label != image.camera.label) return;
  images_.push_back(image);
  if (images_.size() > kMost) images_.pop_front();
}

const CameraImage* Film::image_at(Stamp stamp) const {
  constexpr double kBeside_s = 0.05;  // a scan and its image are not taken at once everywhere
  const auto apart = [&](const CameraImage& image) {
    return std::abs(seconds_between(image.stamp, stamp));
  };
  const auto nearest = std::min_element(
      images_.begin(), images_.end(),
      [&](const CameraImage& a, const CameraImage& b) { return apart(a) < apart(b); });
  return nearest != images_.end() && apart(*nearest) < kBeside_s ? &*nearest : nullptr;
}

void Film::virtual_scan(const VirtualScan& scan) {
  if (!real_ || images_.empty()) return;
  if (scan.key_stamp != last_key_ && real_->stamp == scan.key_stamp) {
    const BirdScene key = scene_of_key(scan, *real_);
    trails_.remember(key);
    if (const CameraImage* image = image_at(scan.key_stamp))
      add(scan.key_stamp, key, overlay(*real_, *image, depths_));
  }
  last_key_ = scan.key_stamp;
  const BirdScene scene = scene_of(scan);
  trails_.remember(scene);
  if (const CameraImage* image = image_at(scan.scan.stamp))
    add(scan.scan.stamp, scene, on_image(scan, *image, depths_));
}

void Film::add(Stamp stamp, const BirdScene& scene, const cv::Mat& camera) {
  const std::vector<Camera> cameras{images_.front().camera};
  if (as_taken_.empty()) {
    BirdScene scene_as_taken = scene_of(*real_);
    scene_as_taken.title = "as the sensor took it";
    as_taken_ = from_above(scene_as_taken, nullptr, {}, cameras, real_->T_vehicle_lidar, view_);
  }
  const cv::Mat& left = as_taken_;
  const cv::Mat right = from_above(scene, nullptr, trails_, cameras, real_->T_vehicle_lidar, view_);
  const cv::Mat above = fitted(camera);
  frame_.create((above.rows + left.rows + 8) / 2 * 2, kWidth_px, CV_8UC3);
  frame_.setTo(cv::Scalar::all(0));
  const int margin = (kWidth_px - above.cols) / 2;
  above.copyTo(frame_.rowRange(0, above.rows).colRange(margin, margin + above.cols));
  const cv::Mat below = frame_.rowRange(frame_.rows - left.rows, frame_.rows);
  left.copyTo(below.colRange(0, left.cols));
  right.copyTo(below.colRange(kWidth_px - right.cols, kWidth_px));
  write(stamp);
}

void Film::write(Stamp stamp) {
  if (!is_open_ && !waiting_) {
    waiting_ = {stamp, frame_.clone()};
    return;
  }
  if (!is_open_) {
    const double interval_s = seconds_between(waiting_->stamp, stamp);
    const double rate = std::clamp(1 / (kSlower * std::max(1e-3, interval_s)), 1., 60.);
    is_open_ = writer_->open(unfinished_->path(), rate, frame_.size());
    if (!is_open_)
      throw std::runtime_error(path_ + ": OpenCV cannot write a film of this kind; try .avi");
    writer_->write(waiting_->picture);
    waiting_.reset();
  }
  writer_->write(frame_);
}

bool Film::finish() {
  if (!is_open_) return false;
  writer_->close();
  // A copy, as the encoder does not tell of what a full disk did not take.
  // Opened first: the output removes temporary names that nobody has locked.
  std::ifstream encoded(unfinished_->path(), std::ios::binary);
  OutputFile film(path_, {true});
  for (std::vector<char> block(1U << 20U); encoded;) {
    encoded.read(block.data(), static_cast<std::streamsize>(block.size()));
    film.write(block.data(), static_cast<std::size_t>(encoded.gcount()));
  }
  if (film.size() == 0) throw std::runtime_error(path_ + ": the encoder has written nothing");
  film.commit();
  return true;
}

}  // namespace lidar_upsampling
