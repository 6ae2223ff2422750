// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "simulator/noise.h"

#include <algorithm>
#include <cmath>

namespace lidar_upsampling::sim {

namespace {

// std::floor is a function call where the compiler may not assume SSE 4.1.
int floor_of(double x) {
  const int truncated = static_cast<int>(x);
  return truncated - static_cast<int>(x < truncated);
}

float lattice(std::uint32_t h) {
  h = (h ^ (h >> 15)) * 0x2c1b3c6dU;
  h = (h ^ (h >> 13)) * 0x297a2d39U;
  return static_cast<float>(static_cast<std::int32_t>(h)) * (1.F / 2147483648.F);
}

float smooth(float x) { return x * x * (3 - 2 * x); }

float mix(float a, float b, float share) { return a + (b - a) * share; }

float value_noise(double at_x, double at_y, double at_z, std::uint32_t seed) {
  constexpr std::uint32_t kX = 0x8da6b343U, kY = 0xd8163841U, kZ = 0xcb1ab31fU;
  const int x = floor_of(at_x), y = floor_of(at_y), z = floor_of(at_z);
  const float u = smooth(static_cast<float>(at_x - x)), v = smooth(static_cast<float>(at_y - y)),
              w = smooth(static_cast<float>(at_z - z));
  const std::uint32_t hx = static_cast<std::uint32_t>(x) * kX ^ seed;
  const std::uint32_t hx1 = (static_cast<std::uint32_t>(x) + 1) * kX ^ seed;
  const std::uint32_t hy = static_cast<std::uint32_t>(y) * kY,
                      hz = static_cast<std::uint32_t>(z) * kZ;
  const auto row = [&](std::uint32_t yz) { return mix(lattice(hx ^ yz), lattice(hx1 ^ yz), u); };
  const auto layer = [&](std::uint32_t hash_z) {
    return mix(row(hy ^ hash_z), row((hy + kY) ^ hash_z), v);
  };
  return mix(layer(hz), layer(hz + kZ), w);
}

// The integral of the stripes from 0 to x.
double stripes_integral(double x, double period, double width) {
  const double cycles = floor_of(x / period);
  return cycles * width + std::min(x - cycles * period, width);
}

}  // namespace

double gaussian(std::uint32_t a, std::uint32_t b) {
  const double u = 1 - uniform(a, b), v = uniform(a ^ 0x5bd1e995U, b);
  return std::sqrt(-2 * std::log(u)) * std::cos(2 * M_PI * v);
}

float fractal_noise(const Eigen::Vector3d& p, std::uint32_t seed, const NoiseSpectrum& spectrum,
                    double size) {
  const auto persistence = static_cast<float>(spectrum.persistence);
  float sum = 0, amplitude = 1, sq_total = 0;
  // In cells of the lattice. Halving them is exact, so that dividing once is enough.
  double x = p.x() / spectrum.coarsest, y = p.y() / spectrum.coarsest,
         z = p.z() / spectrum.coarsest, filters_per_cell = spectrum.coarsest / size;
  for (int i = 0; i < spectrum.octaves; ++i) {
    // A lattice needs two samples per cell; below that an octave is gone, above four it is whole.
    const float weight =
        static_cast<float>(std::clamp((filters_per_cell - 1.5) / 2, 0., 1.)) * amplitude;
    if (weight > 0) sum += weight * value_noise(x, y, z, seed + 0x9e37U * i);
    sq_total += amplitude * amplitude;
    amplitude *= persistence;
    x *= 2;
    y *= 2;
    z *= 2;
    filters_per_cell *= 0.5;
  }
  return sum / std::sqrt(sq_total);
}

float stripes(double x, double period, double width, double size) {
  return static_cast<float>((stripes_integral(x + 0.5 * size, period, width) -
                             stripes_integral(x - 0.5 * size, period, width)) /
                            size);
}

}  // namespace lidar_upsampling::sim
