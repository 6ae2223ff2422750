// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/registration/point_index.h"

#include <nanoflann.hpp>

namespace lidar_upsampling {

namespace {

// nanoflann's own set for any number of neighbours takes a tenth more time for one.
class NearestOne {
 public:
  using DistanceType = float;

  explicit NearestOne(float max_sq_distance) : nearest_{-1, max_sq_distance} {}

  [[nodiscard]] const PointIndex::Neighbor& nearest() const { return nearest_; }
  [[nodiscard]] std::size_t size() const { return nearest_.index < 0 ? 0 : 1; }
  [[nodiscard]] bool full() const { return true; }
  [[nodiscard]] float worstDist() const { return nearest_.sq_distance; }
  bool addPoint(float sq_distance, std::uint32_t index) {
    if (sq_distance < nearest_.sq_distance) nearest_ = {static_cast<int>(index), sq_distance};
    return true;
  }

 private:
  PointIndex::Neighbor nearest_;
};

}  // namespace

struct PointIndex::Tree {
  // What nanoflann asks of a data set; the names are its own.
  struct Cloud {
    std::vector<Eigen::Vector3f> points;

    [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }
    [[nodiscard]] float kdtree_get_pt(std::size_t index, std::size_t dim) const {
      return points[index][static_cast<int>(dim)];
    }
    template <class Box>
    bool kdtree_get_bbox(Box& /*box*/) const {
      return false;
    }
  };
  using Metric = nanoflann::L2_Simple_Adaptor<float, Cloud>;

  explicit Tree(std::vector<Eigen::Vector3f> points)
      : cloud{std::move(points)}, index(3, cloud, {/*leaf_max_size=*/16}) {}

  Cloud cloud;
  nanoflann::KDTreeSingleIndexAdaptor<Metric, Cloud, 3> index;
};

PointIndex::PointIndex(std::vector<Eigen::Vector3f> points)
    : tree_(std::make_shared<Tree>(std::move(points))) {}

const std::vector<Eigen::Vector3f>& PointIndex::points() const { return tree_->cloud.points; }

PointIndex::Neighbor PointIndex::nearest(const Eigen::Vector3f& query,
                                         float max_sq_distance) const {
  NearestOne found(max_sq_distance);
  tree_->index.findNeighbors(found, query.data(), {});
  return found.nearest();
}

void PointIndex::nearest(const Eigen::Vector3f& query, int k,
                         std::vector<Neighbor>& neighbors) const {
  std::vector<std::uint32_t> indices(k);
  std::vector<float> sq_distances(k);
  const std::size_t found =
      tree_->index.knnSearch(query.data(), k, indices.data(), sq_distances.data());
  neighbors.resize(found);
  for (std::size_t i = 0; i < found; ++i) {
    neighbors[i] = {static_cast<int>(indices[i]), sq_distances[i]};
  }
}

void PointIndex::within(const Eigen::Vector3f& query, float max_sq_distance,
                        std::vector<std::pair<int, float>>& neighbors) const {
  nanoflann::RadiusResultSet<float, int> found(max_sq_distance, neighbors);
  tree_->index.findNeighbors(found, query.data(), {});
}

}  // namespace lidar_upsampling
