// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

namespace lidar_upsampling {

/// Whatever fills a pipeline, in threads of its own, from its construction to its destruction.
class Source {
 public:
  Source() = default;
  virtual ~Source() = default;
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;
};

}  // namespace lidar_upsampling
