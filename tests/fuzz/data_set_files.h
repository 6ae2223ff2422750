// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <map>
#include <string>

namespace lidar_upsampling::fuzz {

/// Content by path.
using Files = std::map<std::string, std::string>;

/// Small ones of two frames, with a label each: a KITTI drive in `drive`, its day's calibration
/// beside it; a KITTI sequence; a log of Argoverse; a scene in the DGP layout.
[[nodiscard]] Files drive_files();
[[nodiscard]] Files sequence_files();
[[nodiscard]] Files argoverse_files();
[[nodiscard]] Files dgp_files();

}  // namespace lidar_upsampling::fuzz
