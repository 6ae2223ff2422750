// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "plugin/work_queue.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace lidar_upsampling {

void WorkQueue::push(Arrived arrived) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (closed_) return;
  const auto place =
      std::upper_bound(waiting_.begin(), waiting_.end(), arrived,
                       [this](const Arrived& a, const Arrived& b) { return goes_before(a, b); });
  waiting_.insert(place, std::move(arrived));
  changed_.notify_all();
}

void WorkQueue::wait_for_room() {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait(lock, [this] {
    const auto is_work = [](const Arrived& arrived) { return arrived.role != Role::other; };
    return abandoned_ || std::none_of(waiting_.begin(), waiting_.end(), is_work);
  });
}

std::optional<Arrived> WorkQueue::pop() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (!abandoned_) {
    const auto time = next_due();
    if (time && (closed_ || *time <= std::chrono::steady_clock::now())) {
      Arrived first = std::move(waiting_.front());
      waiting_.pop_front();
      mark(first);
      changed_.notify_all();
      return first;
    }
    if (closed_ && !time) return {};
    if (time)
      changed_.wait_until(lock, *time);
    else
      changed_.wait(lock);
  }
  return {};
}

void WorkQueue::close() {
  const std::lock_guard<std::mutex> lock(mutex_);
  closed_ = true;
  changed_.notify_all();
}

void WorkQueue::abandon() {
  const std::lock_guard<std::mutex> lock(mutex_);
  abandoned_ = true;
  changed_.notify_all();
}

// Between several sources it is chance which of one instant arrives first; what tells of the motion
// shall precede the scan, and the scan the image that shows it.
bool WorkQueue::goes_before(const Arrived& a, const Arrived& b) const {
  const Stamp stamp_a = a.observation->timestamp;
  const Stamp stamp_b = b.observation->timestamp;
  if (stamp_a != stamp_b || options_.merge_window.count() <= 0) return stamp_a < stamp_b;
  return a.role < b.role;
}

void WorkQueue::mark(Arrived& first) const {
  if (first.role == Role::other) return;
  const QueueOptions::Milliseconds waited = std::chrono::steady_clock::now() - due(first);
  first.is_hurried = waited > options_.hurry_after;
  first.is_late = waited > options_.give_up_after;
}

// The first in line goes as soon as any one's time has come: that one must not overtake it.
std::optional<SteadyTime> WorkQueue::next_due() const {
  if (waiting_.empty()) return {};
  const auto first =
      std::min_element(waiting_.begin(), waiting_.end(),
                       [](const Arrived& a, const Arrived& b) { return a.time < b.time; });
  return due(*first);
}

SteadyTime WorkQueue::due(const Arrived& arrived) const {
  return arrived.time +
         std::chrono::duration_cast<std::chrono::steady_clock::duration>(options_.merge_window);
}

}  // namespace lidar_upsampling
