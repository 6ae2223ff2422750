// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/metrics/emd.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string>

#include "lidar_upsampling/metrics/point_blocks.h"
#include "lidar_upsampling/robust/assignment.h"

namespace lidar_upsampling {
namespace {

using Values = PointBlocks::Values;

/// Weights below exp(-50) are passed over: even where the guard against zero raises a weight a
/// billionfold, all of them together stay below a float's resolution.
constexpr float kNegligible = 50;
constexpr float kGuard = 1e-9F;

/// exp() of values in [-kNegligible, 0] to 1e-7 of it, twice as fast as Eigen's, which must cope
/// with every value: 2^n * exp(rest), rest by the polynomial of Cephes' expf. Four at a time stay
/// in registers.
Values exp_of(const Values& values) {
  using Four = Eigen::Array<float, 4, 1>;
  Values result;
  for (int i = 0; i < PointBlocks::kSize; i += 4) {
    const Four x = values.segment<4>(i);
    const Eigen::Array4i n = (x * 1.44269504F - 0.5F).cast<int>();
    const Four whole = n.cast<float>();
    const Four r = (x - whole * 0.693359375F) + whole * 2.12194440e-4F;
    const Four slope = ((((1.9875691500e-4F * r + 1.3981999507e-3F) * r + 8.3334519073e-3F) * r +
                         4.1665795894e-2F) *
                            r +
                        1.6666665459e-1F) *
                           r +
                       5.0000001201e-1F;
    // Not shiftLeft(), which Eigen 5.0 does not compile.
    Eigen::Array4i exponent = n + 127;
    for (int& value : exponent) value <<= 23;
    Four power;
    std::memcpy(power.data(), exponent.data(), sizeof(power));
    result.segment<4>(i) = power * (slope * r.square() + r + 1.F);
  }
  return result;
}

/// One cloud, and per block of it what is still to be matched and its share at this temperature.
struct Side {
  PointBlocks cloud;
  std::vector<Values> left;
  std::vector<Values> share;

  explicit Side(const std::vector<Eigen::Vector3f>& points)
      : cloud(make_point_blocks(points)),
        left(cloud.blocks.size(), Values::Ones()),
        share(cloud.blocks.size(), Values::Zero()) {
    const auto& last = cloud.blocks.back();
    left.back().tail(PointBlocks::kSize - last.count).setZero();
  }
};

/// What the points of a block gave, and how far it went.
struct Match {
  Values mass = Values::Zero();
  Values squared = Values::Zero();   ///< m^2 of that mass
  Values distance = Values::Zero();  ///< m
};

/// Calls visit(block of `others`, squared distances, weights) for what is near a point.
template <class Visit>
void for_near(const PointBlocks& others, const std::vector<int>& candidates,
              const Eigen::Vector3f& point, float sharpness, const Visit& visit) {
  for (const int b : candidates) {
    const PointBlocks::Block& block = others.blocks[b];
    if (sharpness * block.sq_distance(point) < kNegligible) {
      const Values sq_distances = block.sq_distances(point);
      visit(b, sq_distances,
            sharpness > 0 ? exp_of((-sharpness * sq_distances).max(-kNegligible)) : Values::Ones());
    }
  }
}

std::vector<int> near_blocks(const PointBlocks& others, const PointBlocks::Block& block,
                             float sharpness) {
  std::vector<int> candidates;
  for (std::size_t b = 0; b < others.blocks.size(); ++b) {
    if (sharpness * others.blocks[b].sq_distance(block) < kNegligible) {
      candidates.push_back(static_cast<int>(b));
    }
  }
  return candidates;
}

/// Calls visit(block, place in it, point, candidate blocks of `others`) for the points of `side`
/// that hold any of `mass`; the blocks in parallel.
template <class Visit>
void for_points(const Side& side, const std::vector<Values>& mass, const Side& others,
                float sharpness, const Visit& visit) {
  tbb::parallel_for(std::size_t{0}, side.cloud.blocks.size(), [&](std::size_t b) {
    const PointBlocks::Block& block = side.cloud.blocks[b];
    const std::vector<int> candidates = near_blocks(others.cloud, block, sharpness);
    for (int i = 0; i < block.count; ++i) {
      if (mass[b][i] > 0) {
        visit(b, i, block.point(i), candidates);
      }
    }
  });
}

/// What each point of `first` gives per unit of demand around it.
void share_out(Side& first, const Side& second, float sharpness) {
  std::fill(first.share.begin(), first.share.end(), Values::Zero());
  for_points(first, first.left, second, sharpness,
             [&](std::size_t b, int i, const Eigen::Vector3f& point, const auto& candidates) {
               Values demand = Values::Zero();
               for_near(second.cloud, candidates, point, sharpness,
                        [&](int other, const Values& /*sq*/, const Values& weights) {
                          demand += weights * second.left[other];
                        });
               first.share[b][i] = first.left[b][i] / (kGuard + demand.sum());
             });
}

/// What each point of `second` takes of what is offered: no more than it has room for.
void take(const Side& first, Side& second, float sharpness) {
  std::fill(second.share.begin(), second.share.end(), Values::Zero());
  for_points(second, second.left, first, sharpness,
             [&](std::size_t b, int i, const Eigen::Vector3f& point, const auto& candidates) {
               Values supply = Values::Zero();
               for_near(first.cloud, candidates, point, sharpness,
                        [&](int other, const Values& /*sq*/, const Values& weights) {
                          supply += weights * first.share[other];
                        });
               float& left = second.left[b][i];
               const float offered = left * supply.sum();
               second.share[b][i] = std::min(left / (offered + kGuard), 1.F) * left;
               left = std::max(0.F, left - offered);
             });
}

/// Books the match of this temperature and takes it off what is left.
void book(Side& first, const Side& second, float sharpness, std::vector<Match>& matches) {
  for_points(first, first.share, second, sharpness,
             [&](std::size_t b, int i, const Eigen::Vector3f& point, const auto& candidates) {
               Match sum;
               for_near(second.cloud, candidates, point, sharpness,
                        [&](int other, const Values& sq_distances, const Values& weights) {
                          const Values mass = weights * second.share[other];
                          sum.mass += mass;
                          sum.squared += mass * sq_distances;
                          sum.distance += mass * sq_distances.sqrt();
                        });
               const float share = first.share[b][i];
               first.left[b][i] = std::max(0.F, first.left[b][i] - share * sum.mass.sum());
               matches[b].squared[i] += share * sum.squared.sum();
               matches[b].distance[i] += share * sum.distance.sum();
             });
}

/// A shift adds the same to the squared costs of every one-to-one match: without it the best one is
/// the same, and found many times sooner.
Eigen::Matrix3Xd centred(const std::vector<Eigen::Vector3f>& points) {
  Eigen::Matrix3Xd result(3, points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    result.col(static_cast<Eigen::Index>(i)) = points[i].cast<double>();
  }
  return result.colwise() - result.rowwise().mean();
}

}  // namespace

EarthMoverDistance approximate_emd(const std::vector<Eigen::Vector3f>& first,
                                   const std::vector<Eigen::Vector3f>& second) {
  if (first.size() != second.size() || first.empty()) {
    throw std::invalid_argument("approximate EMD of " + std::to_string(first.size()) + " and " +
                                std::to_string(second.size()) +
                                " points: the clouds must be of one size; see sample_points()");
  }
  Side from(first), to(second);
  std::vector<Match> matches(from.cloud.blocks.size());
  for (int power = 7; power >= -2; --power) {
    const float sharpness = power == -2 ? 0 : std::ldexp(1.F, 2 * power);
    share_out(from, to, sharpness);
    take(from, to, sharpness);
    book(from, to, sharpness, matches);
  }
  EarthMoverDistance sum;
  for (const Match& match : matches) {
    sum.squared_m2 += match.squared.cast<double>().sum();
    sum.plain_m += match.distance.cast<double>().sum();
  }
  const auto count = static_cast<double>(first.size());
  return {sum.squared_m2 / count, sum.plain_m / count};
}

EarthMoverDistance exact_emd(const std::vector<Eigen::Vector3f>& first,
                             const std::vector<Eigen::Vector3f>& second) {
  if (first.size() != second.size() || first.empty() || first.size() > kMaxExactEmdPoints) {
    throw std::invalid_argument("exact EMD of " + std::to_string(first.size()) + " and " +
                                std::to_string(second.size()) +
                                " points: the clouds must be of one size, at most " +
                                std::to_string(kMaxExactEmdPoints) + "; see sample_points()");
  }
  const auto count = static_cast<Eigen::Index>(first.size());
  const Eigen::Matrix3Xd from = centred(first), to = centred(second);
  CostMatrix cost(count, count);
  for (Eigen::Index row = 0; row < count; ++row) {
    cost.row(row) = (to.colwise() - from.col(row)).colwise().squaredNorm();
  }
  const std::vector<int> column_of_row = solve_assignment(cost);
  EarthMoverDistance sum;
  for (Eigen::Index row = 0; row < count; ++row) {
    const auto column = static_cast<std::size_t>(column_of_row[row]);
    const double squared =
        (first[row].cast<double>() - second[column].cast<double>()).squaredNorm();
    sum.squared_m2 += squared;
    sum.plain_m += std::sqrt(squared);
  }
  return {sum.squared_m2 / static_cast<double>(count), sum.plain_m / static_cast<double>(count)};
}

}  // namespace lidar_upsampling
