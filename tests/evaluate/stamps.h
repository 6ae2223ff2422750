// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// So many seconds from where tests begin.
inline Stamp at(double seconds) { return shifted(Stamp{}, 100 + seconds); }

}  // namespace lidar_upsampling
