// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/cluster_extent.h"

#include <algorithm>
#include <limits>
#include <opencv2/imgproc.hpp>

namespace lidar_upsampling {
namespace {

constexpr std::size_t kFootprintPoints = 600;  ///< so many draw it to a few centimetres

}  // namespace

ClusterExtent cluster_extent(const std::vector<Eigen::Vector3f>& points,
                             const std::vector<float>& heights, const std::vector<int>& cluster) {
  ClusterExtent extent;
  extent.bottom = std::numeric_limits<float>::infinity();
  extent.top = -extent.bottom;
  const std::size_t stride = 1 + cluster.size() / kFootprintPoints;
  std::vector<cv::Point2f> footprint;
  footprint.reserve(cluster.size() / stride + 1);
  for (std::size_t i = 0; i < cluster.size(); ++i) {
    const int index = cluster[i];
    const Eigen::Vector3f& point = points[index];
    const float height = heights.empty() ? point.z() : heights[index];
    extent.bottom = std::min(extent.bottom, height);
    extent.top = std::max(extent.top, height);
    extent.centroid += point;
    if (i % stride == 0) footprint.emplace_back(point.x(), point.y());
  }
  extent.centroid /= static_cast<float>(cluster.size());

  const cv::RotatedRect rectangle = cv::minAreaRect(footprint);
  extent.length = std::max(rectangle.size.width, rectangle.size.height);
  extent.width = std::min(rectangle.size.width, rectangle.size.height);
  return extent;
}

}  // namespace lidar_upsampling
