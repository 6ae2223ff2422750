// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <functional>
#include <optional>

#include "densification.h"
#include "densify.h"
#include "log_ahead.h"

namespace lidar_upsampling {

/// @brief A log as a run needs it: entry by entry, each told to the run a little ahead of its turn.
///
/// What must be known of a log before work begins, its first seconds tell, which are read twice
/// where they are too large to be held; where they do not, the log is read whole for it first:
/// where a sensor comes up later, the ego-motion is by GNSS (a heading is found from fixes far
/// around), the shortest time between scans is asked for (`scan_time = azimuth` without a period),
/// a file has a pose per scan, samples may be joined over long gaps, or not even what comes until
/// the next scan and sample of ego-motion can be held.
class LogInput {
 public:
  /// @param job, report must outlive it; reading is timed in the report.
  /// @throw std::runtime_error the log cannot be opened, or is damaged right at its beginning.
  LogInput(const DensifyJob& job, DensifyReport& report);

  /// @brief Of the log's beginning, or of all of it. To be called first.
  /// @param whole of all of it in any case. @param progress of reading that; may be null.
  /// @throw std::runtime_error damaged, no fitting poses.
  [[nodiscard]] LogIndex index(bool whole, const std::function<void(double)>& progress);

  /// @brief In place of index(), for a log whose index is known.
  /// @param ego_goes_by the vehicle's motion is not in it, and is taken while the log goes by.
  void know_all(const LogIndex& index, bool ego_goes_by);

  /// @brief Passes over what comes before the first entry that has this stamp, or a later one.
  /// @throw std::runtime_error damaged
  void skip_to(Stamp stamp);

  /// @brief The next entry, none after the last. Damage is an error, or with `accept_truncated` is
  /// left out with a warning.
  /// @param end the first entry that has this stamp, or a later one, is none any more.
  /// @throw std::runtime_error damaged; as Densification::learn()
  [[nodiscard]] std::optional<RawlogEntry> next(Densification& run, std::optional<Stamp> end = {});

  [[nodiscard]] double progress() const { return log_.progress(); }

 private:
  const RawlogEntry* read_on();
  void take_ego_from(Stamp stamp);
  [[nodiscard]] std::optional<LogIndex> index_of_beginning();
  [[nodiscard]] std::optional<LogIndex> index_of_heavy_beginning() const;

  const DensifyJob& job_;
  DensifyReport& report_;
  LogAhead log_;
  std::size_t num_told_ = 0;  ///< to the run, of the entries that wait
  bool knows_all_ = false;    ///< the run, of the log
  bool ego_goes_by_ = false;
  EgoNews passed_;  ///< of what was passed over, and still counts
};

}  // namespace lidar_upsampling
