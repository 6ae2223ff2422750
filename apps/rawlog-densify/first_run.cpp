// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "first_run.h"

#include <mrpt/obs/CSensoryFrame.h>

#include "densification.h"
#include "lidar_upsampling/io/rawlog_stream.h"
#include "lidar_upsampling/io/sensory_frame.h"

namespace lidar_upsampling {

using mrpt::obs::CObservation;

MoverHistory find_movers(const DensifyJob& job, const LogIndex& index,
                         const std::function<void(double)>& progress) {
  DensifyJob first = job;
  first.pictures.clear();
  first.config.resample = "none";
  DensifyReport unused;
  Densification run(first, index, unused);
  run.keep_movers();
  const auto feed = [&](const RawlogEntry& entry) {
    (void)run.feed(std::dynamic_pointer_cast<CObservation>(entry.object));
  };
  RawlogReader reader(job.input);
  for (std::size_t i = 0; i < index.num_objects; ++i) {
    const auto entry = reader.next();
    if (!entry) break;
    if (dynamic_cast<mrpt::obs::CSensoryFrame*>(entry->object.get()) != nullptr) {
      for (const RawlogEntry& part : split_frame(*entry)) feed(part);
      (void)run.flush();
    } else {
      feed(*entry);
    }
    progress(reader.progress());
  }
  (void)run.flush();
  return run.take_movers();
}

}  // namespace lidar_upsampling
