// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/tracks/hidden_part.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "lidar_upsampling/azimuth.h"

namespace lidar_upsampling {
namespace {

/// By direction from the sensor: azimuth from a middle one, elevation.
class Directions {
 public:
  explicit Directions(const Eigen::Vector3f& middle)
      : ahead_(middle.head<2>().normalized()), left_(-ahead_.y(), ahead_.x()) {}

  [[nodiscard]] Eigen::Vector2f of(const Eigen::Vector3f& place) const {
    const Eigen::Vector2f level = place.head<2>();
    return {std::atan2(left_.dot(level), ahead_.dot(level)), elevation_of(level.norm(), place.z())};
  }

 private:
  Eigen::Vector2f ahead_, left_;
};

}  // namespace

bool is_hidden(const SeenSpace& seen, const std::vector<Eigen::Vector3f>& places) {
  const auto hidden =
      std::count_if(places.begin(), places.end(),
                    [&](const Eigen::Vector3f& place) { return seen.at(place) == Sight::hidden; });
  return 2 * static_cast<std::size_t>(hidden) > places.size();
}

std::vector<Eigen::Vector3f> hidden_part(const ObjectTrack& track, const TrackState& now,
                                         const ScanObject& object, const TrackedScan& scan) {
  const Directions directions(object.centroid.cast<float>());
  Eigen::AlignedBox2f front;
  for (const int i : object.points) front.extend(directions.of(scan.scan.points[i]));
  std::vector<Eigen::Vector3f> places = points_by(track, now, scan.T_rest_lidar);
  places.erase(std::remove_if(places.begin(), places.end(),
                              [&](const Eigen::Vector3f& place) {
                                return front.contains(directions.of(place)) ||
                                       scan.seen->at(place) != Sight::hidden;
                              }),
               places.end());
  return places;
}

}  // namespace lidar_upsampling
