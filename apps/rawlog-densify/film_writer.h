// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <string>

namespace lidar_upsampling {

/// @brief What encodes a film. It is a library of its own, loaded when a film is asked for:
/// OpenCV's video module brings a hundred others along, and all who start rawlog-densify would wait
/// for them.
class FilmWriter {
 public:
  FilmWriter() = default;
  FilmWriter(const FilmWriter&) = delete;
  FilmWriter& operator=(const FilmWriter&) = delete;
  virtual ~FilmWriter() = default;

  /// @param path its ending tells the container, and by it the codec.
  /// @return false: OpenCV cannot write such a film.
  virtual bool open(const std::string& path, double rate_hz, cv::Size size) = 0;
  /// @param frame of the size that was told, 8 bit BGR.
  virtual void write(const cv::Mat& frame) = 0;
  /// Writes what is left.
  virtual void close() = 0;
};

/// @throw std::runtime_error the library is not there, and why.
[[nodiscard]] std::unique_ptr<FilmWriter> load_film_writer();

}  // namespace lidar_upsampling
