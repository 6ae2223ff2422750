// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <cmath>
#include <map>
#include <memory>
#include <optional>

#include "lidar_upsampling/ego/trajectory.h"

namespace GeographicLib {
class LocalCartesian;
}

namespace lidar_upsampling {

/// One position fix: WGS84 degrees, ellipsoidal height in metres, and where the antenna sits.
struct GnssSample {
  Stamp stamp;
  double latitude_deg = 0;
  double longitude_deg = 0;
  double height_m = 0;
  Eigen::Vector3d antenna_in_vehicle = Eigen::Vector3d::Zero();
};

/// Whether its numbers are finite, and a place on Earth.
[[nodiscard]] inline bool is_on_globe(const GnssSample& sample) {
  constexpr double kFarthest_m = 1e6;  // above it, and from the vehicle: nobody drives there
  return std::abs(sample.latitude_deg) <= 90 && std::abs(sample.longitude_deg) <= 540 &&
         std::abs(sample.height_m) < kFarthest_m && sample.antenna_in_vehicle.norm() < kFarthest_m;
}

/// @brief The vehicle's motion from position fixes alone, in local east-north-up metres about the
/// first.
///
/// Around the asked instants a parabola is fitted to the fixes, over a second of them where they
/// are good to a centimetre, 5 s where they scatter by a metre (estimated from the fixes
/// themselves). Its direction is the heading of the vehicle's origin (which is taken not to slip
/// sideways nor to reverse), held while the vehicle stands; roll and pitch are zero.
class GnssTrack {
 public:
  explicit GnssTrack(const InterpolationLimits& limits = {}, double min_step_m = 0.3);

  /// A second fix with the same stamp replaces the first.
  /// @throw std::invalid_argument coordinates outside of the globe or not finite.
  void add(const GnssSample& sample);

  /// @return vehicle poses at two instants, made to fit together; none where the limits forbid it.
  [[nodiscard]] std::optional<std::pair<TrajectoryPose, TrajectoryPose>> at(Stamp from,
                                                                            Stamp to) const;

  /// Drops fixes that no query from `stamp` on needs.
  void forget_before(Stamp stamp);

  [[nodiscard]] std::size_t size() const { return antenna_in_world_.size(); }

 private:
  struct LocalFit;
  [[nodiscard]] double half_window(Stamp center) const;
  [[nodiscard]] LocalFit fit(Stamp center, double half_span, double half_window) const;
  [[nodiscard]] std::optional<double> course(Stamp center) const;
  [[nodiscard]] double held_heading(Stamp stamp) const;
  [[nodiscard]] Pose pose_of(const LocalFit& fit, Stamp stamp) const;

  InterpolationLimits limits_;
  double min_step_m_;
  std::shared_ptr<const GeographicLib::LocalCartesian> world_;
  Eigen::Vector3d antenna_in_vehicle_ = Eigen::Vector3d::Zero();
  std::map<Stamp, Eigen::Vector3d> antenna_in_world_;
  std::optional<double> forgotten_heading_;
};

}  // namespace lidar_upsampling
