// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "lidar_upsampling/config.h"
#include "lidar_upsampling/objects/detector.h"
#include "lidar_upsampling/objects/known_motion.h"
#include "lidar_upsampling/objects/motion_to_next.h"
#include "lidar_upsampling/objects/mover_history.h"
#include "lidar_upsampling/objects/point_tracks.h"
#include "lidar_upsampling/objects/scene_segments.h"
#include "lidar_upsampling/objects/tracks.h"
#include "lidar_upsampling/se3.h"
#include "lidar_upsampling/types.h"
#include "lidar_upsampling/vision/visibility.h"

namespace lidar_upsampling {

/// A picture, its instant on the LiDAR's clock, and what is computed from it once.
struct Picture {
  CameraImage image;
  Stamp instant;
  ImagePyramid pyramid;
};

/// An object candidate of the key scan on one camera.
struct Candidate {
  Detection detection;
  int track_id = -1;
  std::vector<int> points;  ///< indices into the key scan, followed or not
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  ///< lidar frame at k
  double time_s = 0;                 ///< of its points' own measurement, from the key scan's stamp
  int scans_moving = 0;              ///< as PastObject has it, of the scan before
  std::optional<KnownMotion> known;  ///< measured before the key scan's first image
  std::optional<KnownMotion> foreseen;  ///< told by later scans
  std::optional<KnownMotion> seen;      ///< on the last image since the key scan that told it
  std::optional<MotionToNext> to_next;  ///< where the next scan is known and shows it
  bool to_next_is_guided = false;       ///< whether a picture led there
  bool on_edges = false;  ///< whether its followed points lie on depth edges, for want of others
  std::optional<KnownMotion> at_next;  ///< its velocity at the next scan, where that is known
  Twist rate =
      Twist::Zero();  ///< motion over ground per second, in the lidar frame at k, as last estimated
  Twist anchor_rate = Twist::Zero();  ///< the same, as its points were put on the anchor
};

/// An object as the last scan that showed it did, for its motion from scan to scan.
struct PastObject {
  Stamp stamp;
  Pose T_rest_lidar;
  std::vector<Eigen::Vector3f> points;  ///< lidar frame then
  int scans_moving = 0;                 ///< in a row that have told it to move
};

/// @brief Whether an object has been seen to move for long enough to be one that is partly hidden,
/// where it seems not to have.
[[nodiscard]] inline bool is_proven(const Candidate& candidate) {
  return candidate.scans_moving > 1;
}

/// The key scan as the steps of every camera need it.
struct KeyScanView {
  const LidarScan& scan;
  const SceneSegments& segments;
  const SeenSpace& seen;
  Pose T_rest_lidar_k = Pose::Identity();  ///< lidar frame at k in a frame at rest
  const SeenSpace* seen_before = nullptr;  ///< by the scan before; null: there was none
  Stamp stamp_before;
  const NextScan* next = nullptr;              ///< the scan to come, where it is known
  const std::vector<ExpectedMover>& expected;  ///< who will be found to move
};

/// @brief One camera's memory: its last picture, and what is followed on it since the key scan.
struct CameraView {
  CameraView(Camera camera_in, const TrackerOptions& options, int& next_track_id)
      : camera(std::move(camera_in)), tracker(options, next_track_id) {}

  Camera camera;
  Tracker tracker;
  std::shared_ptr<const Picture> last;
  std::shared_ptr<const Picture>
      anchor;              ///< where the key scan's points were put; null: nowhere yet
  double anchor_dt = 0;    ///< s from the key scan to the anchor
  Neighbourhood sampling;  ///< of the key scan on the picture
  std::vector<Candidate> candidates;
  PointTracks points;
  std::map<int, PastObject> past;  ///< by track id
  Eigen::Matrix3d R_rest_lidar_k = Eigen::Matrix3d::Identity();
};

[[nodiscard]] Pose T_camera_lidar_of(const Camera& camera, const Pose& T_vehicle_lidar);

/// @brief Puts the key scan on the anchor picture: object candidates found, tracked from scan to
/// scan, their points and static ones chosen to be followed (paper, "Object Detection and
/// Tracking", "Defining Object Points and Tracking Them").
/// @param T_lidar_a_lidar_k ego-motion from the key scan to the anchor's instant.
/// @param known motions by track id, from images; the motion between the last two scans is measured
/// here.
/// @param with_static_points whether static ones are needed, for the camera's own ego-motion.
void start_view(CameraView& view, std::shared_ptr<const Picture> anchor, const KeyScanView& key,
                const Pose& T_lidar_a_lidar_k, const std::map<int, KnownMotion>& known,
                bool with_static_points, Detector& detector, const Config& config);

/// @brief Follows all points to the next picture.
/// @param T_lidar_t_lidar_k_predicted ego-motion from the key scan to the picture's instant.
void follow_view(CameraView& view, const Picture& picture, const LidarScan& key_scan,
                 const Pose& T_lidar_t_lidar_k_predicted, const Config& config);

/// @brief Motion of every candidate at the picture's instant; sets their rates for the next
/// picture.
/// @param is_followed whether the points were followed to it; else objects go on as they are known
/// to move.
/// @param next the real scan to come, where it is known: null for a live system.
[[nodiscard]] std::vector<ObjectMotion> estimate_motions(
    CameraView& view, const Picture& picture, bool is_followed, const LidarScan& key_scan,
    const Pose& T_lidar_t_lidar_k, const NextScan* next, const Config& config);

}  // namespace lidar_upsampling
