// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "bird_view.h"
#include "drawing.h"
#include "film_writer.h"
#include "lidar_upsampling/io/temporary_names.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// @brief A film of a densification, slowed down: the camera above, below it from above on the left
/// the scans as the sensor took them, on the right with virtual ones. From then on the
/// process keeps large blocks of memory off its heap.
class Film {
 public:
  /// @param path .mp4, .avi or .mkv; it appears when the film is finished.
  /// @throw std::runtime_error another ending, or load_film_writer().
  explicit Film(std::string path);

  void real_scan(const LidarScan& scan);
  /// Of several cameras, the first is shown.
  void image(const CameraImage& image);
  /// @throw std::runtime_error the film cannot be written.
  void virtual_scan(const VirtualScan& scan);
  /// @return false, and there is no film, if there was nothing to show.
  /// @throw std::runtime_error as OutputFile
  [[nodiscard]] bool finish();

 private:
  struct Frame {
    Stamp stamp;
    cv::Mat picture;
  };
  void add(Stamp stamp, const BirdScene& scene, const cv::Mat& camera);
  void write(Stamp stamp);
  [[nodiscard]] const CameraImage* image_at(Stamp stamp) const;

  std::string path_;
  std::unique_ptr<TemporaryName> unfinished_;
  std::unique_ptr<FilmWriter> writer_;
  bool is_open_ = false;
  cv::Mat frame_;                 ///< the one being drawn
  std::optional<Frame> waiting_;  ///< the first, until the second tells the rate
  std::deque<CameraImage> images_;
  std::optional<LidarScan> real_;
  cv::Mat as_taken_;  ///< the real scan from above; empty: not drawn yet
  Stamp last_key_;
  Trails trails_;
  BirdView view_;      ///< by the first scan
  DepthScale depths_;  ///< by the first scan
};

}  // namespace lidar_upsampling
