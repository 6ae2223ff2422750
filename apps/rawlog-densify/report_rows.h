// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

#include "lidar_upsampling/scene/object_scene.h"
#include "lidar_upsampling/types.h"
#include "record_file.h"

namespace lidar_upsampling {

/// What a report tells of an object at an image.
struct ReportRow {
  Stamp stamp;
  std::size_t num_points = 0;
  ObjectMotion object;                   ///< without its points
  std::optional<ObjectBox> box;          ///< none: no points of it are left in the virtual scan
  Pose T_rest_lidar = Pose::Identity();  ///< at `stamp`, as in VirtualScan
};

/// Rows of a report on their way to it.
class ReportRows {
 public:
  /// @param beside what the file lies on one disk with. @throw std::runtime_error as OutputFile
  explicit ReportRows(const std::string& beside) : file_(beside) {}

  /// @throw std::runtime_error the disk is full
  void add(const ReportRow& row);
  void add(Stamp key_stamp, const OtherCluster& cluster);

  using UseRow = std::function<void(ReportRow&)>;
  using UseCluster = std::function<void(Stamp key_stamp, const OtherCluster&)>;
  /// All of them in their order; an empty function leaves its kind out.
  void for_each(const UseRow& use_row, const UseCluster& use_cluster) const;

 private:
  enum class Kind : char { row, cluster };

  RecordFile file_;
};

}  // namespace lidar_upsampling
