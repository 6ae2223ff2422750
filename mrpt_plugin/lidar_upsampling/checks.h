// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <stdexcept>
#include <string>

namespace lidar_upsampling {

/// @throw std::invalid_argument "<rule>, not <value>", if the value does not keep to its rule.
template <typename Value>
void require(bool keeps_to_it, const char* rule, Value value) {
  if (!keeps_to_it) throw std::invalid_argument(rule + (", not " + std::to_string(value)));
}

}  // namespace lidar_upsampling
