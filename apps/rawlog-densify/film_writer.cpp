// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "film_writer.h"

#include <filesystem>
#include <opencv2/videoio.hpp>

namespace lidar_upsampling {
namespace {

class OpenCvWriter final : public FilmWriter {
 public:
  bool open(const std::string& path, double rate_hz, cv::Size size) override {
    const int codec = std::filesystem::path(path).extension() == ".avi"
                          ? cv::VideoWriter::fourcc('M', 'J', 'P', 'G')
                          : cv::VideoWriter::fourcc('a', 'v', 'c', '1');
    return writer_.open(path, codec, rate_hz, size);
  }
  void write(const cv::Mat& frame) override { writer_.write(frame); }
  void close() override { writer_.release(); }

 private:
  cv::VideoWriter writer_;
};

}  // namespace
}  // namespace lidar_upsampling

/// What load_film_writer() looks for; its caller owns what it gets.
extern "C" lidar_upsampling::FilmWriter* lidar_upsampling_film_writer() {
  return new lidar_upsampling::OpenCvWriter;
}
