// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

#include "lidar_upsampling/scan/beams.h"
#include "lidar_upsampling/scan/patch_index.h"
#include "lidar_upsampling/scan/resample.h"

namespace lidar_upsampling {

struct Ray {
  Eigen::Vector3f origin, direction;
};

/// Where a ray ends.
struct BeamHit {
  int patch = -1;      ///< none: -1
  float range = 0;     ///< along the ray, metres
  float offset = 0;    ///< from the patch's centre, 1: at its edge
  float approach = 1;  ///< to the patch's plane, per range: slope times direction
};

/// @brief Finds the first moved patch in a ray's way. All arguments must outlive the caster.
class Caster {
 public:
  Caster(const PatchSet& patches, const PatchMotions& motions, const PatchIndex& index,
         const ResampleOptions& options);

  /// @param ray of `beam`, which is of that row of the index.
  [[nodiscard]] BeamHit cast(const Ray& ray, int row, const Beam& beam);

 private:
  void add(const Ray& ray, int patch, float reach);
  [[nodiscard]] BeamHit blended(const BeamHit& first) const;
  [[nodiscard]] BeamHit nearest_by(const Ray& ray, int row, float azimuth);

  const PatchSet& patches_;
  const PatchMotions& motions_;
  const PatchIndex& index_;
  const ResampleOptions& options_;
  Ray static_ray_{};  // the ray before the static scene's motion
  std::vector<BeamHit> hits_;
};

}  // namespace lidar_upsampling
