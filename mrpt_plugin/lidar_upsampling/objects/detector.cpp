// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/detector.h"

#include <stdexcept>

namespace lidar_upsampling {

std::unique_ptr<Detector> make_detector(const DetectorOptions& options) {
  switch (options.type) {
    case DetectorOptions::Type::clusters:
      return nullptr;
    case DetectorOptions::Type::network:
      return make_network_detector(options.network);
    case DetectorOptions::Type::csv:
      return make_csv_detector(options.csv);
  }
  throw std::invalid_argument("make_detector: unknown detector type");
}

}  // namespace lidar_upsampling
