// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/obs/CObservation.h>

#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "densify.h"
#include "film.h"
#include "lidar_upsampling/front_end/usable_observations.h"
#include "lidar_upsampling/io/log_index.h"
#include "lidar_upsampling/upsampler.h"
#include "odd_inputs.h"
#include "pictures.h"
#include "scans_ahead.h"
#include "streams.h"

namespace lidar_upsampling {

/// @brief Better ego-motion than a log's beginning has comes up later: to use it from the start,
/// all of the log must be known.
struct EgoComesLate : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// @brief One run of the method over a log: its observations go in one by one, in the log's order,
/// virtual scans come out.
class Densification {
 public:
  /// @param job only its settings, its folder of pictures and its film are used. Must outlive the
  /// run, as the report must.
  /// @param index of the whole log, or of its beginning. @throw std::runtime_error as
  /// select_streams()
  Densification(const DensifyJob& job, const LogIndex& index, DensifyReport& report);

  /// @brief Takes what more has been read of a log, ahead of its turn.
  /// @throw std::runtime_error streams have come up that leave none to choose.
  /// @throw EgoComesLate, if the log can be read again.
  void learn(LogIndexer& indexer);
  /// @brief Takes the vehicle's motion that comes up ahead of its turn, where ego_goes_by(), of a
  /// log whose streams are known. What is long past is forgotten.
  void go_on_by(const EgoNews& news);
  /// @brief With `mode = offline`, takes the scans of an entry of the log, ahead of its turn.
  void look_ahead(const RawlogEntry& entry);
  /// Whether the next scan needs entries from further ahead.
  [[nodiscard]] bool wants_scans() const;

  /// @return the virtual scan that became due: the observation's own, or a waiting one of before.
  [[nodiscard]] std::optional<VirtualScan> feed(const mrpt::obs::CObservation::Ptr& observation);

  /// @return the virtual scan that still waits for other cameras, if any.
  [[nodiscard]] std::optional<VirtualScan> flush();

  /// Warns of what is odd about the settings, now that the log has gone by.
  /// A film, if one is asked for, appears. @throw std::runtime_error it cannot.
  void finish();

  /// The last real scan as the log held it; null before the first.
  [[nodiscard]] const mrpt::obs::CObservation::Ptr& last_real() const { return last_real_; }

 private:
  std::optional<VirtualScan> feed_scan(const mrpt::obs::CObservation::Ptr& observation);
  void take_streams(const StreamSelection& streams);
  void take_ego(const EgoNews& news);
  void expect_scans();
  std::optional<VirtualScan> feed_image(const mrpt::obs::CObservation& observation);
  std::optional<VirtualScan> noted(std::optional<VirtualScan> scan);

  const DensifyJob& job_;
  DensifyReport& report_;
  LidarUpsampler upsampler_;
  UsableObservations usable_;
  mrpt::obs::CObservation::Ptr last_real_;
  std::string lidar_label_;
  Stamp last_stamp_;                              ///< of a scan
  bool learns_ = false;                           ///< of the log while it goes by
  std::size_t num_streams_ = 0, num_stamps_ = 0;  ///< of the log, of the LiDAR: that are known
  std::set<std::string> camera_labels_;
  std::set<std::string> labels_;  ///< that there are
  StampWatch stamps_;
  std::optional<Pictures> pictures_;
  std::optional<Film> film_;
  std::optional<ScansAhead> ahead_;  ///< with mode = offline
  std::size_t num_fed_ = 0;          ///< scans, readable or not
  std::size_t num_expected_ = 0;     ///< scans that were told ahead
};

}  // namespace lidar_upsampling
