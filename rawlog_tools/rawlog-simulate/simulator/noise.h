// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>

namespace lidar_upsampling::sim {

/// A hash of two words: random numbers that depend on their name only, never on the order of
/// drawing.
[[nodiscard]] inline std::uint32_t hash(std::uint32_t a, std::uint32_t b) {
  std::uint32_t h = a * 0x9e3779b1U ^ (b + 0x7f4a7c15U) * 0x85ebca77U;
  h = (h ^ (h >> 15)) * 0x2c1b3c6dU;
  h = (h ^ (h >> 12)) * 0x297a2d39U;
  return h ^ (h >> 15);
}

/// Uniform in [0, 1).
[[nodiscard]] inline double uniform(std::uint32_t a, std::uint32_t b) {
  return hash(a, b) * (1. / 4294967296.);
}

/// Standard normal (Box-Muller).
[[nodiscard]] double gaussian(std::uint32_t a, std::uint32_t b);

/// Octaves of value noise.
struct NoiseSpectrum {
  double coarsest = 1;       ///< lattice spacing of the first octave, m
  int octaves = 7;           ///< each half as wide as the one before
  double persistence = 0.8;  ///< amplitude of an octave over the one before
};

/// @brief Band-limited noise in three dimensions, about -1 to 1, attached to the coordinates it is
/// given. Octaves too fine for a filter of `size` metres fade out, so a picture of it never
/// flickers.
[[nodiscard]] float fractal_noise(const Eigen::Vector3d& p, std::uint32_t seed,
                                  const NoiseSpectrum& spectrum, double size);

/// Share of a filter of width `size` about x that lies in [from, to]: an antialiased stripe.
[[nodiscard]] inline float stripe(double x, double from, double to, double size) {
  const double half = 0.5 * size;
  const double covered = std::min(x + half, to) - std::max(x - half, from);
  return static_cast<float>(std::max(0., covered) / size);
}

/// The same for stripes [0, width] repeated every `period`.
[[nodiscard]] float stripes(double x, double period, double width, double size);

/// Antialiased disc.
[[nodiscard]] inline float disc(double distance, double radius, double size) {
  return static_cast<float>(std::min(1., std::max(0., (radius - distance) / size + 0.5)));
}

}  // namespace lidar_upsampling::sim
