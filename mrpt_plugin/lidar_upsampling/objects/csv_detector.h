// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <iosfwd>
#include <map>
#include <string>
#include <vector>

#include "lidar_upsampling/objects/detector.h"
#include "lidar_upsampling/stamp_text.h"

namespace lidar_upsampling {

/// @brief Boxes from a file: `label,stamp,class,score,left,top,right,bottom[,track]`, any order of
/// rows, an optional header; `label` is the image's sensor label.
class CsvDetector : public Detector {
 public:
  /// @throw std::runtime_error no such file, or a bad row, with its line number.
  explicit CsvDetector(const CsvDetectorOptions& options);
  /// @param name of the file, for messages.
  CsvDetector(std::istream& rows, const std::string& name, double stamp_tolerance_ms);

  /// The boxes of the image's label at the stamp nearest to its own, none outside the tolerance.
  std::vector<Detection> detect(const DetectorInput& input) override;

 private:
  void load(std::istream& rows, const std::string& name);

  double tolerance_s_;
  std::map<std::string, std::map<Stamp, std::vector<Detection>>> boxes_;
};

}  // namespace lidar_upsampling
