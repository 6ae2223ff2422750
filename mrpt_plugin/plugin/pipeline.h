// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/obs/CObservation.h>

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "plugin/messages.h"
#include "plugin/statistics.h"
#include "plugin/work_queue.h"

namespace lidar_upsampling {

/// An observation on its way out.
struct Emitted {
  mrpt::obs::CObservation::Ptr observation;
  std::optional<SteadyTime> image_arrival;  ///< of a virtual scan: when its image had come in
};

/// What the pipeline's thread does with each observation.
class Upsampling {
 public:
  Upsampling() = default;
  virtual ~Upsampling() = default;
  Upsampling(const Upsampling&) = delete;
  Upsampling& operator=(const Upsampling&) = delete;

  /// @return what is ready, in the order it is to go out.
  [[nodiscard]] virtual std::vector<Emitted> feed(const Arrived& arrived) = 0;
  [[nodiscard]] virtual std::vector<Emitted> finish() = 0;
  /// Images so far on which, being hurried, it did less. Others need no more anyhow.
  [[nodiscard]] virtual std::size_t num_hurried() const = 0;
};

/// @brief From the sources' threads through the upsampler's own thread to the sensor's.
class Pipeline {
 public:
  /// @param role_of asked by one thread at a time.
  Pipeline(const QueueOptions& options, std::function<Role(const mrpt::obs::CObservation&)> role_of,
           std::unique_ptr<Upsampling> upsampling, Messages& messages);
  ~Pipeline();
  Pipeline(const Pipeline&) = delete;
  Pipeline& operator=(const Pipeline&) = delete;

  /// @param pose_by_actions see Arrived.
  /// @throw what `role_of` throws; the observation is lost then.
  void push(const mrpt::obs::CObservation::Ptr& observation,
            const std::optional<Pose>& pose_by_actions = {});
  /// Waits until a push hurries no work.
  void wait_for_room() { queue_.wait_for_room(); }

  /// @brief No more will come. @param reason the first one given counts.
  void finish(const std::string& reason);
  /// Nobody will take anything any more; ends waits.
  void abandon() { queue_.abandon(); }

  /// @brief What is ready, virtual scans among it, in time order.
  [[nodiscard]] std::vector<mrpt::obs::CObservation::Ptr> take();
  /// The reason, once all that came has been taken.
  [[nodiscard]] std::optional<std::string> end() const;
  [[nodiscard]] SensorStatistics statistics() const;

 private:
  void work();
  void count(const Arrived& arrived);
  void put_out(std::vector<Emitted> emitted);

  WorkQueue queue_;
  std::function<Role(const mrpt::obs::CObservation&)> role_of_;
  std::unique_ptr<Upsampling> upsampling_;
  Messages& messages_;
  std::mutex push_mutex_;
  mutable std::mutex mutex_;  // of all below
  std::vector<Emitted> ready_;
  SensorStatistics statistics_;
  Stamp last_stamp_{};
  std::optional<std::string> end_;
  bool is_done_ = false;
  std::thread worker_;
};

}  // namespace lidar_upsampling
