// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/metrics/point_blocks.h"

#include <algorithm>
#include <numeric>

namespace lidar_upsampling {

namespace {

using Indices = std::vector<int>::iterator;

/// Orders [begin, end) so that each run of kSize are neighbours.
void order(const std::vector<Eigen::Vector3f>& points, Indices begin, Indices end) {
  const auto num_blocks = (end - begin + PointBlocks::kSize - 1) / PointBlocks::kSize;
  if (num_blocks < 2) {
    std::sort(begin, end);
    return;
  }
  Eigen::AlignedBox3f box;
  std::for_each(begin, end, [&](int i) { box.extend(points[i]); });
  int axis = 0;
  box.sizes().maxCoeff(&axis);
  const auto middle = begin + num_blocks / 2 * PointBlocks::kSize;
  // Equal coordinates are told apart by index, or the order would be the library's choice.
  std::nth_element(begin, middle, end, [&](int i, int j) {
    return points[i][axis] != points[j][axis] ? points[i][axis] < points[j][axis] : i < j;
  });
  order(points, begin, middle);
  order(points, middle, end);
}

}  // namespace

PointBlocks make_point_blocks(const std::vector<Eigen::Vector3f>& points) {
  std::vector<int> indices(points.size());
  std::iota(indices.begin(), indices.end(), 0);
  order(points, indices.begin(), indices.end());
  PointBlocks result;
  for (std::size_t start = 0; start < indices.size(); start += PointBlocks::kSize) {
    PointBlocks::Block block;
    block.count =
        static_cast<int>(std::min<std::size_t>(PointBlocks::kSize, indices.size() - start));
    Eigen::AlignedBox3f box;
    for (int i = 0; i < PointBlocks::kSize; ++i) {
      const Eigen::Vector3f& point = points[indices[start + (i < block.count ? i : 0)]];
      block.x[i] = point.x();
      block.y[i] = point.y();
      block.z[i] = point.z();
      box.extend(point);
    }
    block.min = box.min();
    block.max = box.max();
    result.blocks.push_back(block);
  }
  return result;
}

}  // namespace lidar_upsampling
