// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <string>
#include <vector>

#include "evaluation.h"
#include "html.h"

namespace lidar_upsampling {

/// An object at one image, with its pictures ready for the page.
struct ShownObject {
  ObjectReference object;  ///< without its points
  std::size_t num_points = 0;
  PerRow<std::optional<ObjectError>> errors;
  Stamp stamp;
  double dt = 0;
  std::string camera;               ///< whose picture `crop` is of; empty: on none
  std::string crop, before, after;  ///< addresses of pictures
};

/// @brief Keeps the objects that our virtual scans put farthest from where they were, with their
/// pictures; takes memory for these alone, however long the log.
class WorstObjects {
 public:
  explicit WorstObjects(std::size_t capacity = 12) : capacity_(capacity) {}

  /// As EvaluationJob::on_scan gives them.
  void add(const ScanSet& scans, const ScanResult& result, const Pictured& pictures);

  /// The worst first.
  [[nodiscard]] const std::vector<ShownObject>& found() const { return found_; }

 private:
  std::size_t capacity_;
  std::vector<ShownObject> found_;
};

/// @param first_stamp of the comparison; times on the page count from there.
[[nodiscard]] std::string worst_objects_html(const std::vector<ShownObject>& objects,
                                             Stamp first_stamp);

}  // namespace lidar_upsampling
