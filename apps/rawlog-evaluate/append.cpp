// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <filesystem>
#include <utility>

#include "evaluation.h"

namespace lidar_upsampling {

namespace {

void add_named(const LogResult& log, ScanResults& scans) {
  const std::string& name = log.reference.empty() ? log.input : log.reference;
  const std::string stem = std::filesystem::path(name).stem().string();
  log.scans.for_each([&](ScanResult& scan) {
    for (ObjectResult& object : scan.objects) object.object.id = stem + "/" + object.object.id;
    scans.add(scan);
  });
}

}  // namespace

void append(LogResult& total, LogResult log) {
  if (total.input.empty()) {
    total = std::move(log);
    return;
  }
  if (total.num_logs == 1) {
    ScanResults named(total.scans.beside());
    add_named(total, named);
    total.scans = std::move(named);
  }
  add_named(log, total.scans);
  ++total.num_logs;
  total.has_truth = total.has_truth && log.has_truth;
  total.num_virtual += log.num_virtual;
  total.num_unmatched += log.num_unmatched;
  total.num_unlabelled += log.num_unlabelled;
  for (const Row row : kRows)
    if (total.labels[row] && log.labels[row]) append(*total.labels[row], *log.labels[row]);
  for (const std::string& note : log.notes) total.notes.push_back(log.input + ": " + note);
}

}  // namespace lidar_upsampling
