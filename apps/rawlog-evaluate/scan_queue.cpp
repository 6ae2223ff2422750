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
  for (Task& task : tasks_) {
    task.group.cancel();
    task.group.wait();
  }
}

void ScanQueue::add(ScanToJudge scan) {
  if (tasks_.size() == kMostTasks) take_first();
  Task& task = tasks_.emplace_back();
  task.given = std::move(scan);
  task.real = std::move(task.given.reference.scan);
  task.group.run([this, &task] {
    task.result = evaluate_scan(scan_set(task.given, task.real), std::move(task.given.reference),
                                cameras_, job_.options);
  });
}

void ScanQueue::take_first() {
  Task& task = tasks_.front();
  task.group.wait();
  results_.add(task.result);
  if (job_.on_scan) job_.on_scan(scan_set(task.given, task.real), task.result, task.given.pictures);
  tasks_.pop_front();
}

void ScanQueue::finish() {
  while (!tasks_.empty()) take_first();
}

}  // namespace lidar_upsampling
