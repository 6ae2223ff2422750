// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <functional>
#include <vector>

#include "lidar_upsampling/prepared_scan.h"
#include "lidar_upsampling/tracks/object_tracks.h"

/// What a scan shows of objects where they must be, candidates or not.
namespace lidar_upsampling {

/// @brief The scan's points above the ground that `belongs` says, with all of the clusters that
/// mostly do.
[[nodiscard]] std::vector<int> with_their_clusters(const PreparedScan& scan,
                                                   const std::function<bool(int)>& belongs);

/// @brief Likewise, those that lie at some of the places.
/// @param places lidar frame.
/// @param may_belong others do not.
[[nodiscard]] std::vector<int> points_near(const PreparedScan& scan,
                                           std::vector<Eigen::Vector3f> places,
                                           const std::function<bool(int)>& may_belong);

/// @brief Tracks that move and are none of the scan's candidates become objects of it by what is to
/// be seen of them where they are predicted: the few points that something nearer leaves, a part of
/// a cluster that is too large, or nothing, where all of it is hidden. It tells nothing of their
/// motion, which goes on as long as their place is known better than they are long.
/// @param track_of of the scan's objects; grows with them.
void take_up_hidden(PreparedScan& scan, TrackStore& store, std::vector<int>& track_of,
                    const TrackOptions& options);

}  // namespace lidar_upsampling
