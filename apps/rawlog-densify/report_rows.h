// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

#include "lidar_upsampling/io/output_file.h"
#include "lidar_upsampling/scene/object_scene.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// What a report tells of an object at an image.
struct ReportRow {
  Stamp stamp;
  std::size_t num_points = 0;
  ObjectMotion object;                   ///< without its points
  std::optional<ObjectBox> box;          ///< none: no points of it are left in the virtual scan
  Pose T_rest_lidar = Pose::Identity();  ///< at `stamp`, as in VirtualScan
};

/// @brief Rows of a report on their way to it: in a file without a name, as memory would grow with
/// the log.
class ReportRows {
 public:
  /// @param beside what the file lies on one disk with. @throw std::runtime_error as OutputFile
  explicit ReportRows(const std::string& beside);

  /// @throw std::runtime_error the disk is full
  void add(const ReportRow& row);
  void add(Stamp key_stamp, const OtherCluster& cluster);

  using UseRow = std::function<void(ReportRow&)>;
  using UseCluster = std::function<void(Stamp key_stamp, const OtherCluster&)>;
  /// All of them in their order; an empty function leaves its kind out.
  void for_each(const UseRow& use_row, const UseCluster& use_cluster);

 private:
  enum class Kind : char { row, cluster };
  void begin(Kind kind);
  void end();
  void write_out();
  static std::size_t use_records(const std::string& block, const UseRow& use_row,
                                 const UseCluster& use_cluster);

  OutputFile file_;
  std::string waiting_;    ///< to be written
  std::size_t begin_ = 0;  ///< of the record under way
};

}  // namespace lidar_upsampling
