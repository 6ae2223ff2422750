// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lidar_upsampling/config.h"
#include "lidar_upsampling/ego/ego_fusion.h"
#include "lidar_upsampling/ego/ego_motion.h"
#include "lidar_upsampling/se3.h"
#include "lidar_upsampling/tracks/object_tracks.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

struct CameraView;
struct ImageResult;
struct KeyObjects;
struct Picture;
struct PreparedScan;
struct SteadyMotion;

/// How much work there is time for at an image.
enum class Effort {
  full,
  prediction  ///< nothing is followed on it: objects go on as they are known to move
};

/// @brief Scans and images in, virtual scans out: the whole method, streaming. Observations come in
/// the order of the log; memory stays at one scan and a few images per camera however long the log.
///
/// Of a scan ground and clusters are found (objects/), and joined to the tracks (tracks/); at every
/// image their points are followed on the picture (vision/), ego-motion (ego/) and each object's
/// own motion (tracks/) are estimated, and the scan is moved (scan/). Images of several cameras
/// that lie within `group_tolerance_ms` make one virtual scan.
class LidarUpsampler {
 public:
  /// @throw std::invalid_argument, std::runtime_error settings that cannot work together, a
  /// detector's missing file.
  explicit LidarUpsampler(const Config& config);
  ~LidarUpsampler();
  LidarUpsampler(const LidarUpsampler&) = delete;
  LidarUpsampler& operator=(const LidarUpsampler&) = delete;

  /// Poses, odometry and fixes go in here; those of a whole log at once, or as they come.
  EgoMotion& ego_motion() { return ego_motion_; }

  /// Real scans that are to come, where a log on disk tells: no virtual scan is made within
  /// `min_gap_ms` of one. Without it only the scans already inserted count.
  void expect_scans(std::vector<Stamp> stamps);

  /// @brief The cameras whose images are to come; a virtual scan is due as soon as each of them has
  /// delivered its image of an instant. Without it, the cameras seen so far.
  void expect_cameras(const std::vector<std::string>& labels);

  /// @brief A real scan that is to be inserted later, where a log on disk tells (`mode = offline`),
  /// in the log's order: it tells of the motions until then; virtual scans that lie on beams are
  /// drawn from the next one, too. Each scan ahead takes some ten megabytes.
  void expect(LidarScan scan);

  /// @brief A real scan: it becomes the key scan.
  /// @return the virtual scan of an earlier instant that still waited for other cameras, if any.
  std::optional<VirtualScan> insert_scan(LidarScan scan);

  /// @return the virtual scan at the image's instant if it is due (one key scan at least, not too
  /// close to a real scan, all cameras in), or a waiting one of an earlier instant.
  std::optional<VirtualScan> insert_image(const CameraImage& image, Effort effort = Effort::full);

  /// @return the virtual scan that still waits for other cameras, if any.
  std::optional<VirtualScan> flush();

  /// Images so far on which objects would have been followed, had there been time.
  [[nodiscard]] std::size_t num_hurried() const { return num_hurried_; }

 private:
  [[nodiscard]] CameraView& view_of(const Camera& camera);
  [[nodiscard]] bool is_due(Stamp instant) const;
  void start(CameraView& view);
  void process(CameraView& view, const Picture& picture, Effort effort);
  [[nodiscard]] VirtualScan compose(ScanMotion motion);
  // Ego-motion (upsampler_ego.cpp).
  [[nodiscard]] std::optional<EgoStep> given_step(const LidarScan& from, Stamp instant) const;
  [[nodiscard]] EgoStep ego_step(Stamp instant) const;
  [[nodiscard]] EgoStep steady_step(Stamp instant) const;
  [[nodiscard]] SteadyMotion& steady_motion() const;
  [[nodiscard]] CameraEgoOptions camera_ego_options(double dt) const;
  [[nodiscard]] EgoStep camera_step(const CameraView& view, const Picture& picture,
                                    const EgoStep& predicted);
  [[nodiscard]] std::vector<Eigen::Vector3f> standing_points(const PreparedScan& before) const;
  void step_between_scans(const PreparedScan& before, PreparedScan& now);
  // Real scans (upsampler_scans.cpp).
  void straighten(LidarScan& scan, const std::vector<float>& times, const Twist& rate) const;
  [[nodiscard]] std::unique_ptr<PreparedScan> prepared(LidarScan scan, const PreparedScan* before);
  void take_up(const Picture* anchor);

  Config config_;
  EgoMotion ego_motion_;
  std::unique_ptr<Detector> detector_;  ///< null: clusters
  std::unique_ptr<PreparedScan> key_;   ///< the last real scan
  std::deque<std::unique_ptr<PreparedScan>> to_come_;
  std::map<std::string, std::unique_ptr<CameraView>> views_;
  std::vector<ImageResult> group_;  ///< of the instant under way
  TrackStore store_;
  std::vector<int> track_of_;      ///< of each of the key scan's objects, once they are taken up
  bool is_taken_up_ = false;       ///< whether they are
  PoseNoise pose_noise_;           ///< of given poses, where they are not taken at their word
  std::vector<StageTime> timing_;  ///< since the last virtual scan
  std::vector<Stamp> expected_scans_;
  std::size_t expected_cameras_ = 0, num_hurried_ = 0;
  double scan_period_s_ = 0;
};

}  // namespace lidar_upsampling
