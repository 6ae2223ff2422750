// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "scan_queue.h"

#include <utility>

namespace lidar_upsampling {

namespace {

// At once, so that few scans lie in memory.
constexpr std::size_t kMostTasks = 4;

ScanSet scan_set(const ScanToJudge& given, const LidarScan& real) {
  return {*given.key, given.scan, real, given.paper ? &*given.paper : nullptr};
}

}  // namespace

ScanQueue::~ScanQueue() {
  group_.cancel();
  group_.wait();
}

void ScanQueue::add(ScanToJudge scan) {
  if (tasks_.size() == kMostTasks) finish();
  LidarScan real = std::move(scan.reference.scan);
  Task& task = tasks_.emplace_back(Task{std::move(scan), std::move(real), {}});
  group_.run([this, &task] {
    task.result = evaluate_scan(scan_set(task.given, task.real), std::move(task.given.reference),
                                cameras_, job_.options);
  });
}

void ScanQueue::finish() {
  group_.wait();
  for (Task& task : tasks_) {
    results_.push_back(std::move(task.result));
    if (job_.on_scan)
      job_.on_scan(scan_set(task.given, task.real), results_.back(), task.given.pictures);
  }
  tasks_.clear();
}

}  // namespace lidar_upsampling
