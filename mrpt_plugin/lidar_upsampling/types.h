// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/core/Clock.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

/// Frames: `world`, `vehicle` and `lidar` have +X forward, +Y left, +Z up; `camera` has +Z forward,
/// +X right, +Y down. `T_target_source` takes source points to target. Instants: `_k` the key scan
/// (the last real one), `_t` the image. SI units.
namespace lidar_upsampling {

/// An instant, in MRPT's 100 ns ticks. Copied, never sent through a double.
using Stamp = mrpt::Clock::time_point;

/// How a log is packed that is written. MRPT before 2.15.7 reads no zstd.
struct Compression {
  enum class Format { none, fast, gzip, zstd };  ///< fast: gzip, at the speed of a disk

  Format format = Format::fast;
  int level = 0;  ///< of gzip 1 to 9, of zstd 1 to 19, as these programs have them

  static const Compression none, fast, small;

  bool operator==(const Compression& other) const {
    return format == other.format && level == other.level;
  }
};
inline constexpr Compression Compression::none{Format::none, 0};
inline constexpr Compression Compression::fast{Format::fast, 0};
inline constexpr Compression Compression::small{Format::gzip, 6};

/// @brief "none", "fast", "small", "gzip:6", "zstd:3". @throw std::invalid_argument with the
/// choices.
[[nodiscard]] Compression parse_compression(const std::string& text);
[[nodiscard]] std::string to_text(const Compression& compression);

/// A rigid motion; always named T_target_source.
using Pose = Eigen::Isometry3d;

/// A count of ticks that a damaged stamp may be beyond: 30,000 years.
constexpr double kMostTicks = 9e18;

/// Seconds from `from` to `to`, negative if `to` is the earlier one.
inline double seconds_between(Stamp from, Stamp to) {
  const double apart = static_cast<double>(to.time_since_epoch().count()) -
                       static_cast<double>(from.time_since_epoch().count());
  return 1e-7 * (std::abs(apart) < kMostTicks ? static_cast<double>((to - from).count()) : apart);
}

/// The instant `dt` seconds after `stamp`, to the nearest tick; the first or the last one, if it
/// lies beyond these.
inline Stamp shifted(Stamp stamp, double dt) {
  const double ticks = dt * 1e7 + (dt < 0 ? -0.5 : 0.5);
  const double sum = static_cast<double>(stamp.time_since_epoch().count()) + ticks;
  if (std::abs(ticks) > kMostTicks || std::abs(sum) > kMostTicks)
    return ticks < 0 ? Stamp::min() : Stamp::max();
  return stamp + mrpt::Clock::duration(static_cast<std::int64_t>(ticks));
}

/// @brief A stamp as text: MRPT ticks (an integer), or UNIX seconds with decimals, read without
/// passing through a double.
/// @throw std::invalid_argument neither of the two.
[[nodiscard]] Stamp parse_stamp(const std::string& text);

/// UNIX seconds with all seven decimals, as `1317046450.1234567`.
[[nodiscard]] std::string to_text(Stamp stamp);

/// A point cloud whose points are referred to one instant. `points` are finite, in the lidar frame;
/// every other per-point vector has either the length of `points` or none.
struct LidarScan {
  Stamp stamp;
  std::string label;
  Pose T_vehicle_lidar = Pose::Identity();
  std::vector<Eigen::Vector3f> points;
  std::vector<float> intensity;       ///< [0, 1]
  std::vector<std::uint16_t> ring;    ///< 0 is the lowest beam
  std::vector<std::uint16_t> column;  ///< azimuth step
  std::vector<float> time_s;          ///< from `stamp`, of each point's own measurement
  int num_rings = 0;                  ///< 0 where `ring` is empty
  int num_columns = 0;                ///< 0 where `column` is empty

  [[nodiscard]] std::size_t size() const { return points.size(); }
};

/// MRPT's and OpenCV's distortion models; `distortion` is k1 k2 p1 p2 k3 k4 k5 k6 (plumb bob), or
/// k1 k2 at 0, 1 and k3 k4 at 4, 5 (Kannala-Brandt), as in mrpt::img::TCamera.
enum class DistortionModel { none, plumb_bob, kannala_brandt };

struct CameraModel {
  int width = 0;
  int height = 0;
  double fx = 0, fy = 0, cx = 0, cy = 0;  ///< pixels
  DistortionModel distortion_model = DistortionModel::none;
  std::array<double, 8> distortion{};
};

/// One camera of the rig.
struct Camera {
  std::string label;
  CameraModel model;
  Pose T_vehicle_camera = Pose::Identity();
};

/// A picture and the camera that took it. `stamp` is the log's; `gray` is CV_8UC1 of the model's
/// size; `bgr` is CV_8UC3, or empty for a gray camera.
struct CameraImage {
  Stamp stamp;
  Camera camera;
  cv::Mat gray;
  cv::Mat bgr;
};

/// Pixels; `right` and `bottom` lie outside.
struct Box2d {
  double left = 0, top = 0, right = 0, bottom = 0;

  /// Of negative width, until it is extended.
  [[nodiscard]] static Box2d around_nothing() {
    constexpr double kFar = std::numeric_limits<double>::infinity();
    return {kFar, kFar, -kFar, -kFar};
  }
  void extend(double u, double v) {
    left = std::min(left, u);
    top = std::min(top, v);
    right = std::max(right, u);
    bottom = std::max(bottom, v);
  }
  [[nodiscard]] double width() const { return right - left; }
  [[nodiscard]] double height() const { return bottom - top; }
  [[nodiscard]] double area() const { return std::max(0., width()) * std::max(0., height()); }
  [[nodiscard]] bool contains(double u, double v) const {
    return u >= left && u < right && v >= top && v < bottom;
  }
};

[[nodiscard]] double intersection_over_union(const Box2d& a, const Box2d& b);

/// An object candidate on one image.
struct Detection {
  Box2d box;
  std::string class_name;
  double score = 1;
  int external_track = -1;  ///< identity given by the detector itself, -1 if none
};

/// What became of an object at one image.
enum class MotionStatus {
  moving,          ///< its own motion was estimated
  stationary,      ///< its own motion was estimated and is not distinguishable from none
  predicted,       ///< the picture said nothing: moved on as measured between the last real scans
  too_few_points,  ///< fewer tracked points than a pose needs: ego-motion used
  no_consensus     ///< the tracked points agree on no rigid motion: ego-motion used
};

/// The rigid motion of one object from the key scan to an image, and the evidence for it.
struct ObjectMotion {
  int track_id = -1;
  std::string class_name;
  std::string camera_label;  ///< that sees most of it; empty: none does
  MotionStatus status = MotionStatus::too_few_points;
  Pose T_lidar_t_lidar_k = Pose::Identity();  ///< ego- and object motion together (eq. 5, T_D)
  Pose T_mov = Pose::Identity();  ///< object motion alone, in the lidar frame at k (eq. 3)
  /// The same per second, as a twist about the lidar (se3.h).
  Eigen::Matrix<double, 6, 1> rate_lidar_k = Eigen::Matrix<double, 6, 1>::Zero();
  Eigen::Vector3d centroid_lidar_k = Eigen::Vector3d::Zero();  ///< of its points
  Eigen::Vector3d velocity_lidar_k = Eigen::Vector3d::Zero();  ///< of the centroid over ground, m/s
  double yaw_rate = 0;                                         ///< rad/s about lidar +Z
  Box2d box;                                                   ///< on the image
  std::vector<int> points;                                     ///< indices into the key scan
  int num_tracked = 0;                                         ///< points that KLT followed
  int num_inliers = 0;                                         ///< of them, those that agree
  double rmse_px = 0;                                          ///< of the inliers
  /// Of the centroid at the image, m^2, in the axes of the lidar frame then; zero: not known. Of
  /// one that is told to stand with how far it is off if it does not.
  Eigen::Matrix3d position_covariance = Eigen::Matrix3d::Zero();
};

/// How long a stage took for one image or scan.
struct StageTime {
  const char* stage;
  double ms;
};

/// Whether a virtual scan's points lie on the sensor's own beams.
enum class Resampling {
  none,           ///< not asked for: the key scan's points where they have moved to
  done,           ///< each beam ends on the first surface in its way
  little_motion,  ///< as with `none`: they lie on the beams anyway
  no_beams        ///< as with `none`: no rings, or not a spinning LiDAR's
};

/// A cluster of a real scan that is no object candidate.
struct OtherCluster {
  Eigen::Vector3d centroid_lidar_k = Eigen::Vector3d::Zero();
  Eigen::Vector3d size = Eigen::Vector3d::Zero();  ///< m: of the footprint, length >= width; height
  std::size_t num_points = 0;
  const char* why = "";  ///< a word: too_few_points, too_far, ...
};

/// A scan that no sensor took: the key scan's points at an image's instant.
struct VirtualScan {
  LidarScan scan;                             ///< stamp = the image's; label = the output label
  Stamp key_stamp;                            ///< of the real scan it was made from
  std::vector<int> source_index;              ///< of each point, in the key scan; -1: in none
  std::vector<int> track_id;                  ///< of each point, -1: static scene
  std::vector<ObjectMotion> objects;          ///< every candidate, whatever became of it
  Pose T_lidar_t_lidar_k = Pose::Identity();  ///< static scene (eq. 4, T_S)
  Pose T_rest_lidar_t = Pose::Identity();     ///< to a frame at rest, the first scan's
  bool ego_extrapolated = false;
  Resampling resampling = Resampling::none;
  std::vector<OtherCluster> other_clusters;  ///< of the key scan, at its first use
  std::vector<StageTime> timing;  ///< of its image; at first use, of the key scan's stages, too
};

[[nodiscard]] const char* to_string(MotionStatus status);
[[nodiscard]] const char* to_string(Resampling resampling);

/// The square root of its position's covariance in the least certain direction, m; 0: not known.
[[nodiscard]] double position_sigma(const ObjectMotion& object);

/// @brief The middle one, of an even number the upper of both.
/// @param values at least one.
template <typename T>
[[nodiscard]] T median(std::vector<T> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// @return zero of no points.
[[nodiscard]] Eigen::Vector3d mean_of(const std::vector<Eigen::Vector3f>& points);

[[nodiscard]] std::vector<Eigen::Vector3f> points_at(const LidarScan& scan,
                                                     const std::vector<int>& indices);

/// Mean of the chosen points' times; 0 without times or points.
[[nodiscard]] double mean_time(const std::vector<float>& times, const std::vector<int>& points);

/// Whether the object is moved by a motion of its own.
[[nodiscard]] inline bool moves(const ObjectMotion& object) {
  return object.status == MotionStatus::moving || object.status == MotionStatus::predicted;
}

}  // namespace lidar_upsampling
