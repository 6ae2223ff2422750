// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "lidar_upsampling/config.h"
#include "lidar_upsampling/io/log_index.h"
#include "lidar_upsampling/io/output_file.h"
#include "lidar_upsampling/io/rig_overrides.h"
#include "report.h"

namespace lidar_upsampling {

struct DensifyJob {
  std::string input, output;
  std::string pictures;  ///< folder for pictures, empty: none
  std::string film;      ///< empty: none
  bool overwrite = false;
  bool accept_truncated = false;  ///< keep what is readable of a broken log
  /// A report row per object and image is kept, in a file on one disk with this; empty: none.
  std::string rows_beside;
  Config config;
  RigOverrides rig;
};

/// @brief The main job: a log in, the same log with a virtual scan after every image between two
/// scans out. Observations go through byte for byte.
/// @param progress gets the share done, 0 to 1.
/// @throw std::runtime_error with one line that says what, where and what to do.
[[nodiscard]] DensifyReport densify(const DensifyJob& job,
                                    const std::function<void(double)>& progress);

/// A part of a log, from the first entry that has a stamp or a later one, to the next part's.
struct LogPart {
  const LogIndex* index = nullptr;  ///< of the whole log, with the poses that are to be used
  std::optional<Stamp> from;        ///< none: the log's begin
  std::optional<Stamp> to;          ///< none: the log's end
  bool ego_goes_by = false;         ///< the index is without it
  double warm_up_s = 0;             ///< what goes before `from` is looked at for so long
};

struct PartReport {
  DensifyReport report;
  DensifyReport warm_up;  ///< of what went before, and is not in the output
};

/// Lets the output find the input's externally stored images, or warns.
void link_external_images(const DensifyJob& job, DensifyReport& report);

/// @brief The same of a part. External images are not linked.
/// @param output gets all of it, and is the caller's to commit.
/// @throw std::runtime_error as densify()
[[nodiscard]] PartReport densify_part(const DensifyJob& job, const LogPart& part,
                                      OutputFile& output,
                                      const std::function<void(double)>& progress);

}  // namespace lidar_upsampling
