// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/obs/CObservation.h>

#include <chrono>
#include <condition_variable>
#include <deque>
#include <limits>
#include <mutex>
#include <optional>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

using SteadyTime = std::chrono::steady_clock::time_point;

/// What the upsampler does with an observation, in the order that helps it most among those of one
/// instant: `other` ones tell of the ego-motion at most.
enum class Role { other, scan, image };

/// A real observation on its way through the sensor.
struct Arrived {
  mrpt::obs::CObservation::Ptr observation;
  /// Of a frame's first observation: where the vehicle is by the actions so far (T_world_vehicle).
  std::optional<Pose> pose_by_actions;
  Role role = Role::other;
  SteadyTime time = std::chrono::steady_clock::now();
  bool is_hurried = false;  ///< little time is left to work on it
  bool is_late = false;     ///< passed on as it is: there is no time left to work on it
};

struct QueueOptions {
  using Milliseconds = std::chrono::duration<double, std::milli>;
  static constexpr Milliseconds kNever{std::numeric_limits<double>::infinity()};

  Milliseconds hurry_after = kNever;    ///< a scan or an image that has waited longer is hurried
  Milliseconds give_up_after = kNever;  ///< and after this, late
  /// An observation is held back so long for ones of an earlier stamp that arrive after it, which
  /// counts for no waiting.
  Milliseconds merge_window{0};
};

/// @brief Observations in the order of their stamps; all that go in come out. What is bounded is
/// the work, by the time for which scans and images have waited for it.
class WorkQueue {
 public:
  explicit WorkQueue(const QueueOptions& options) : options_(options) {}

  void push(Arrived arrived);
  /// @brief Waits until no scan or image is left that nobody works on. For sources that can wait.
  void wait_for_room();
  /// @return the next observation as soon as there is one whose time has come; none at the end.
  [[nodiscard]] std::optional<Arrived> pop();

  /// No more is let in; what is in still comes out.
  void close();
  /// Nobody will ask any more: whoever waits goes on.
  void abandon();

 private:
  [[nodiscard]] bool goes_before(const Arrived& a, const Arrived& b) const;
  void mark(Arrived& first) const;
  [[nodiscard]] std::optional<SteadyTime> next_due() const;
  [[nodiscard]] SteadyTime due(const Arrived& arrived) const;

  QueueOptions options_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Arrived> waiting_;
  bool closed_ = false, abandoned_ = false;
};

}  // namespace lidar_upsampling
