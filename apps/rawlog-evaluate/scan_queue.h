// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <tbb/task_group.h>

#include <deque>
#include <memory>
#include <vector>

#include "evaluation.h"
#include "instant_reference.h"

namespace lidar_upsampling {

/// A virtual scan with all that it is judged by.
struct ScanToJudge {
  std::shared_ptr<const LidarScan> key;
  LidarScan scan;
  std::optional<LidarScan> paper;
  InstantReference reference;
  Pictured pictures;
};

/// @brief Judges virtual scans beside the thread that reads the log and finds their references;
/// results come in the scans' order.
class ScanQueue {
 public:
  /// All must outlive this. @param results of the scans, in their order.
  ScanQueue(const EvaluationJob& job, const std::vector<Camera>& cameras, ScanResults& results)
      : job_(job), cameras_(cameras), results_(results) {}
  ~ScanQueue();
  ScanQueue(const ScanQueue&) = delete;
  ScanQueue& operator=(const ScanQueue&) = delete;

  void add(ScanToJudge scan);
  void finish();

 private:
  struct Task {
    ScanToJudge given;
    LidarScan real;
    ScanResult result;
    tbb::task_group group;
  };

  void take_first();

  const EvaluationJob& job_;
  const std::vector<Camera>& cameras_;
  ScanResults& results_;
  std::deque<Task> tasks_;
};

}  // namespace lidar_upsampling
