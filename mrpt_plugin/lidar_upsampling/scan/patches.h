// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <vector>

#include "lidar_upsampling/scan/beam_pattern.h"

namespace lidar_upsampling {

/// @brief The piece of surface that one measured point stands for: flat, and as large as the cell
/// of its beam, half-way to the beams around. Laid out for four products at a time.
struct Patch {
  /// Rows, from the origin of its beam: n with n . p = 1 for its points p; unit vectors along the
  /// beam, to the left, upwards.
  Eigen::Matrix<float, 4, 3> frame;
  /// Of its reach to the left, right (negative), up and down (negative): tangents of the angles as
  /// seen from the origin of its beam.
  Eigen::Array4f inverse_reach;

  /// n . v, and v along the three axes.
  [[nodiscard, gnu::always_inline]] Eigen::Array4f in_frame(const Eigen::Vector3f& v) const {
    return frame.col(0).array() * v.x() + frame.col(1).array() * v.y() +
           frame.col(2).array() * v.z();
  }
};

/// @brief Patches that lie elsewhere, of one scan or several, without copies.
class PatchRefs {
 public:
  PatchRefs() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): a view of all of them
  PatchRefs(const std::vector<Patch>& patches) { append(patches); }

  void append(const std::vector<Patch>& patches) {
    refs_.reserve(refs_.size() + patches.size());
    for (const Patch& patch : patches) refs_.push_back(&patch);
  }
  void replace(int i, const Patch& patch) { refs_[i] = &patch; }
  [[nodiscard]] const Patch& operator[](int i) const { return *refs_[i]; }
  [[nodiscard]] std::size_t size() const { return refs_.size(); }

 private:
  std::vector<const Patch*> refs_;
};

/// When neighbouring points are of one surface.
struct PatchOptions {
  double max_step_m = 0.15;          ///< difference in range, where there is nothing else to go by
  double max_step_per_range = 0.01;  ///< added per metre from the sensor
  double max_bend_m = 0.1;           ///< deviation from straight over three beams
  double max_bend_per_range = 0.02;  ///< added per metre from the sensor
};

/// @brief Makes the patches of a scan's points. Their slopes lead to the neighbours of the same
/// surface, so never over a depth edge; where a point has none, its patch faces the sensor.
class PatchMaker {
 public:
  /// @param points in the pattern's order. Both must outlive the maker.
  PatchMaker(const std::vector<Eigen::Vector3f>& points, const BeamPattern& pattern,
             const PatchOptions& options);

  /// @param point of that row. @param owner of each point; neighbours of another owner are another
  /// surface. Null: all have the same.
  [[nodiscard]] Patch make(int row, int point, const int* owner = nullptr) const;

  [[nodiscard]] const std::vector<BeamNeighbours>& neighbours() const { return neighbours_; }

 private:
  const std::vector<Eigen::Vector3f>& points_;
  const BeamPattern& pattern_;
  PatchOptions options_;
  std::vector<BeamNeighbours> neighbours_;  // of each point
  std::vector<Eigen::Vector3f> cells_;      // of each row
};

}  // namespace lidar_upsampling
