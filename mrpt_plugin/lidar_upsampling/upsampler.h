// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lidar_upsampling/config.h"
#include "lidar_upsampling/ego/ego_fusion.h"
#include "lidar_upsampling/ego/ego_motion.h"
#include "lidar_upsampling/objects/mover_history.h"
#include "lidar_upsampling/se3.h"
#include "lidar_upsampling/tracks/object_tracks.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

struct CameraView;
struct ImageResult;
struct NextScan;
struct NextView;
struct Picture;

/// How much work there is time for at an image.
enum class Effort {
  full,
  prediction  ///< nothing is followed on it: objects go on as they are known to move
};

/// @brief Scans and images in, virtual scans out: the whole method, streaming. Observations come in
/// the order of the log; memory stays at one scan and a few images per camera however long the log.
///
/// At the first image after a scan the object candidates of that scan are found and tracked
/// (objects/), at every image their points are followed on the picture (vision/), ego-motion (ego/)
/// and each object's own motion (objects/object_motion) are estimated, and the scan is moved
/// (scan/). Images of several cameras that lie within `group_tolerance_ms` make one virtual scan.
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

  /// @brief The real scan after the key scan, where a log on disk tells (`mode = offline`): the
  /// motions until then are measured, images place them in time; virtual scans that lie on beams
  /// are drawn from both. Before the key scan's images.
  void expect_next(const LidarScan& next);

  /// Has what is found to move kept, for another run over the same log: some ten kilobytes per
  /// scan. Before the first scan.
  void keep_movers();
  /// @return of the scans so far.
  [[nodiscard]] MoverHistory take_movers();

  /// @brief What another run over the same log has found to move. Before the first scan.
  void expect_movers(MoverHistory history);

  /// @brief A real scan: it becomes the key scan.
  /// @return the virtual scan of an earlier instant that still waited for other cameras, if any.
  std::optional<VirtualScan> insert_scan(LidarScan scan);

  /// @return the virtual scan at the image's instant if it is due (one key scan at least, not too
  /// close to a real scan, all cameras in), or a waiting one of an earlier instant.
  std::optional<VirtualScan> insert_image(const CameraImage& image, Effort effort = Effort::full);

  /// @return the virtual scan that still waits for other cameras, if any.
  std::optional<VirtualScan> flush();

 private:
  struct KeyScan;
  [[nodiscard]] CameraView& view_of(const Camera& camera);
  [[nodiscard]] bool is_key_image(Stamp instant) const;
  [[nodiscard]] bool is_due(Stamp instant) const;
  void start(CameraView& view, const std::shared_ptr<const Picture>& anchor);
  void process(CameraView& view, const Picture& picture, Effort effort);
  [[nodiscard]] std::optional<EgoStep> given_step(Stamp instant) const;
  [[nodiscard]] EgoStep ego_step(Stamp instant) const;
  [[nodiscard]] EgoStep steady_step(Stamp instant) const;
  [[nodiscard]] CameraEgoOptions camera_ego_options(double dt) const;
  [[nodiscard]] EgoStep camera_step(const CameraView& view, const Picture& picture,
                                    const EgoStep& predicted);
  [[nodiscard]] double turn_s() const;
  void straighten(LidarScan& scan, const std::vector<float>& times) const;
  /// Refers a real scan's points to its stamp. @return its T_scan_key.
  [[nodiscard]] Pose take_up(LidarScan& scan, const Pose* known_step);
  [[nodiscard]] Pose scan_step(const LidarScan& next);
  void learn(const std::vector<ObjectMotion>& objects, Stamp instant);
  // With tracks in the world (upsampler_tracks.cpp).
  void find_objects(const Picture* anchor, const CameraView* view);
  void start_tracked(CameraView& view, const std::shared_ptr<const Picture>& anchor);
  void follow_objects(CameraView& view, const Picture& picture, ImageResult& result) const;
  void note_sights(const CameraView& view, const Picture& picture, ImageResult& result) const;
  void follow_tracked(CameraView& view, const Picture& picture, ImageResult& result);
  [[nodiscard]] std::vector<ObjectMotion> tracked_motions(const std::vector<ImageResult>& group,
                                                          const ImageResult& newest);
  void keep(const std::vector<ObjectMotion>& objects, Stamp instant);
  [[nodiscard]] KnownMotion known_at(const ObjectMotion& object, Stamp instant) const;

  Config config_;
  EgoMotion ego_motion_;
  std::unique_ptr<Detector> detector_;
  std::unique_ptr<KeyScan> key_;
  std::unique_ptr<NextScan> next_;
  std::unique_ptr<NextView> next_view_;  ///< where virtual scans are drawn from both
  std::map<std::string, std::unique_ptr<CameraView>> views_;
  std::vector<ImageResult> group_;            ///< of the instant under way
  std::map<int, KnownMotion> known_motions_;  ///< by track id
  TrackOptions track_options_;
  TrackStore store_;
  std::optional<MoverHistory> found_;  ///< where it is kept
  std::map<int, Mover> movers_;        ///< of the key scan, by track id
  MoverHistory history_;               ///< of another run
  bool rate_is_measured_ = false;      ///< whether `lidar_rate_` is that between the last scans
  Matrix6d step_covariance_ = Matrix6d::Zero();  ///< of the ego-motion between the last two scans
  Twist lidar_rate_ = Twist::Zero();             ///< of the last ego-motion, per second
  PoseNoise pose_noise_;           ///< of given poses, where they are not taken at their word
  std::vector<StageTime> timing_;  ///< since the last virtual scan
  std::vector<Stamp> expected_scans_;
  std::size_t expected_cameras_ = 0;
  double scan_period_s_ = 0;
  int next_track_id_ = 0;
};

}  // namespace lidar_upsampling
