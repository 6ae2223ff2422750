// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <memory>

#include "lidar_upsampling/scan/patches.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

struct ResampleOptions {
  double min_motion_m = 0.03;  ///< nothing is done where nothing has moved as far, on average
  double overlap = 0.1;  ///< of patches, share of their reach: closes the cracks of a moved surface
  double max_gap = 1.5;  ///< a beam between patches takes one this near, in units of its reach
  double same_surface_m = 0.1;  ///< hits so far behind the first one's plane: averaged with it
  PatchOptions patches;
};

/// @brief Virtual scans as the sensor would have measured them: each beam of the key scan ends on
/// the first surface in its way. Every moved point stands for a patch of its surface (see
/// patches.h), so a moved object hides what is behind it, no surface leads over a depth edge, and
/// rings lie where they belong. Beams that hit nothing that the key scan has seen give no point;
/// beams that came back empty then may hit something now. Points are ordered by beam; ring, column
/// and time are the beam's, intensity, source and object those of the patch that was hit.
class BeamResampler {
 public:
  /// Finds the beams and patches of the scan.
  explicit BeamResampler(const LidarScan& key_scan, const ResampleOptions& options = {});
  ~BeamResampler();

  /// Another scan of the same scene, moved to the same instant.
  struct OtherView {
    const BeamResampler& scan;
    const VirtualScan& moved;
  };

  /// @param moved of the key scan, by assign_points(); points that it has are not looked at.
  /// @return its `resampling` says what was done; if nothing, it is as it was.
  /// @param other shows what the key scan does not, and again what it does: where both show a
  /// surface, each weighs as it is near the beam; what lies before hides what lies behind,
  /// whichever shows it. Null: none.
  /// @throw std::invalid_argument a scan that was moved is not the resampler's.
  [[nodiscard]] VirtualScan resample(VirtualScan moved, const OtherView* other = nullptr) const;

 private:
  struct Sensor;  // the key scan's beams and patches; none if it has none

  std::size_t num_points_;
  ResampleOptions options_;
  std::unique_ptr<const Sensor> sensor_;
};

}  // namespace lidar_upsampling
