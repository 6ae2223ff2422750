// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

#include "lidar_upsampling/scan/beams.h"
#include "lidar_upsampling/scan/patch_index.h"
#include "lidar_upsampling/scan/resample.h"

namespace lidar_upsampling {

/// Where a beam ends.
struct BeamHit {
  int beam = -1;    ///< of its row
  int patch = -1;   ///< none: -1
  float range = 0;  ///< along the beam, metres
};

/// The beams of a row.
struct RowBeams {
  std::vector<Beam> beams;
  std::vector<int> first;  ///< of each column, as of first_of_columns()
};

/// The patches that beams may hit, and how they have moved.
struct CastScene {
  const BeamPattern& pattern;
  const PatchRefs& patches;
  const PatchMotions& motions;
  const std::vector<FootprintsOfRow>& footprints;  ///< of each row whose patches they are
};

/// @brief Finds the first moved patch in the way of each beam of a row. All arguments must outlive
/// the caster, which keeps its memory from row to row.
class RowCaster {
 public:
  RowCaster(const CastScene& scene, const ResampleOptions& options);

  /// @return a hit for each beam that has one, in their order.
  [[nodiscard]] std::vector<BeamHit> cast(int row, const RowBeams& beams);

 private:
  // A patch near a beam.
  struct Meeting {
    int patch;
    int next;        // of the same beam
    float range;     // along the beam, metres
    float offset;    // from the patch's centre, 1: its edge
    float approach;  // to the patch's plane, per range
  };

  void take_row(int row, const RowBeams& beams);
  void meet(const Footprint& print, const Eigen::Vector3f& origin, const RowBeams& beams);
  [[nodiscard]] BeamHit hit_of(int beam, bool is_measured) const;
  template <typename Visit>
  void for_each(int beam, Visit visit) const {
    for (int k = last_[beam]; k >= 0; k = meetings_[k].next) visit(meetings_[k]);
  }

  const CastScene& scene_;
  float reach_, max_gap_, same_surface_;
  // Directions of the row's beams as the static scene lay in the key scan, with room for reading
  // four from the last one on.
  std::vector<float> x_, y_, z_;
  std::vector<Eigen::Matrix3f> turns_;    // of each motion, from these to how its object lay
  std::vector<Eigen::Vector3f> origins_;  // of each motion, where the row's beams begin
  std::vector<Meeting> meetings_;         // and room for more
  int num_meetings_ = 0;
  std::vector<int> last_;  // meeting of each beam
};

}  // namespace lidar_upsampling
