// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <string>
#include <vector>

#include "import/object_tracks.h"

namespace lidar_upsampling::importing {

/// No labelled object drives faster; a label that asks for it is of another object, or misplaced.
constexpr double kFastestObject = 60;  // m/s
/// Labels this near are of one object, however short the time between them.
constexpr double kNoJump = 3;  // m

struct SteadyTracks {
  std::vector<ObjectTrack> tracks;
  int num_left_out = 0;  ///< labels that fit to no other of their track
  int num_split = 0;     ///< tracks that were several objects' one after the other
  int num_jumping = 0;   ///< objects with either
};

/// @brief Takes labels out of their track that no object could drive to from the others, and makes
/// tracks of their own of those that fit among themselves; these get numbers after the highest.
[[nodiscard]] SteadyTracks without_jumps(const std::vector<ObjectTrack>& tracks);

/// A line that counts them; empty if there is nothing to say.
[[nodiscard]] std::string warning_of(const SteadyTracks& steady);

}  // namespace lidar_upsampling::importing
