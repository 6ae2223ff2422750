// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/registration/point_index.h"

#include <nanoflann.hpp>

namespace lidar_upsampling {

namespace {

// What nanoflann asks of a result besides its own business, from 1.5 on.
struct Result {
  using DistanceType = float;
  using IndexType = std::uint32_t;
  void sort() {}
};

// nanoflann asks these where to look; its own ones allocate for each query, or take a tenth more
// time for one neighbour, and how they take a limit differs from release to release.
class NearestOne : public Result {
 public:
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

class NearestTwo : public Result {
 public:
  explicit NearestTwo(float max_sq_distance) : found_{{-1, max_sq_distance}, max_sq_distance} {}

  [[nodiscard]] const PointIndex::Nearest& found() const { return found_; }
  [[nodiscard]] std::size_t size() const { return found_.first.index < 0 ? 0 : 1; }
  [[nodiscard]] bool full() const { return true; }
  [[nodiscard]] float worstDist() const { return found_.sq_others; }
  bool addPoint(float sq_distance, std::uint32_t index) {
    if (sq_distance < found_.first.sq_distance) {
      found_.sq_others = found_.first.sq_distance;
      found_.first = {static_cast<int>(index), sq_distance};
    } else if (sq_distance < found_.sq_others) {
      found_.sq_others = sq_distance;
    }
    return true;
  }

 private:
  PointIndex::Nearest found_;
};

class NearestFew : public Result {
 public:
  NearestFew(std::size_t count, std::vector<PointIndex::Neighbor>& found)
      : count_(count), found_(found) {
    found_.clear();
  }

  [[nodiscard]] std::size_t size() const { return found_.size(); }
  [[nodiscard]] bool full() const { return found_.size() == count_; }
  [[nodiscard]] float worstDist() const {
    return full() ? found_.back().sq_distance : std::numeric_limits<float>::max();
  }
  bool addPoint(float sq_distance, std::uint32_t index) {
    if (!(sq_distance < worstDist())) return true;
    if (!full()) found_.emplace_back();
    std::size_t place = found_.size() - 1;  // of the farthest, which goes
    for (; place > 0 && found_[place - 1].sq_distance > sq_distance; --place)
      found_[place] = found_[place - 1];
    found_[place] = {static_cast<int>(index), sq_distance};
    return true;
  }

 private:
  std::size_t count_;
  std::vector<PointIndex::Neighbor>& found_;
};

class AllWithin : public Result {
 public:
  AllWithin(float max_sq_distance, std::vector<PointIndex::Neighbor>& found)
      : max_sq_distance_(max_sq_distance), found_(found) {
    found_.clear();
  }

  [[nodiscard]] std::size_t size() const { return found_.size(); }
  [[nodiscard]] bool full() const { return true; }
  [[nodiscard]] float worstDist() const { return max_sq_distance_; }
  bool addPoint(float sq_distance, std::uint32_t index) {
    if (sq_distance < max_sq_distance_) found_.push_back({static_cast<int>(index), sq_distance});
    return true;
  }

 private:
  float max_sq_distance_;
  std::vector<PointIndex::Neighbor>& found_;
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

PointIndex::Nearest PointIndex::nearest_of_all(const Eigen::Vector3f& query,
                                               float max_sq_distance) const {
  NearestTwo found(max_sq_distance);
  tree_->index.findNeighbors(found, query.data(), {});
  return found.found();
}

void PointIndex::nearest(const Eigen::Vector3f& query, int k,
                         std::vector<Neighbor>& neighbors) const {
  NearestFew found(static_cast<std::size_t>(k), neighbors);
  tree_->index.findNeighbors(found, query.data(), {});
}

void PointIndex::within(const Eigen::Vector3f& query, float max_sq_distance,
                        std::vector<Neighbor>& neighbors) const {
  AllWithin found(max_sq_distance, neighbors);
  tree_->index.findNeighbors(found, query.data(), {});
}

}  // namespace lidar_upsampling
