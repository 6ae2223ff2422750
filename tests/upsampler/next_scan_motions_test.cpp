// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/next_scan_motions.h"

#include <gtest/gtest.h>

#include <numeric>

#include "lidar_upsampling/vision/projection.h"

namespace lidar_upsampling {
namespace {

constexpr double kNextScan_s = 0.1, kPicture_s = 0.05;
constexpr double kRingsApart_deg = 0.4;

// Someone 8 m ahead.
std::vector<Eigen::Vector3f> standing_at(float y) {
  std::vector<Eigen::Vector3f> points;
  for (float z = -1; z < 0.6F; z += 0.1F)
    for (float across = -0.2F; across < 0.25F; across += 0.1F)
      points.emplace_back(8, y + across, z);
  return points;
}

/// Someone who goes left by 0.4 m until the next scan, while all patches on him seem to stay.
class HeldBack {
 public:
  HeldBack() {
    key_scan_.points = standing_at(0);
    next_ = std::make_unique<NextScan>(
        NextScan{shifted(Stamp{}, kNextScan_s), Surface(standing_at(0.4F)), Pose::Identity(),
                 SeenSpace(standing_at(0.4F), kRingsApart_deg), nullptr, kRingsApart_deg});
    candidate_.points.resize(key_scan_.size());
    std::iota(candidate_.points.begin(), candidate_.points.end(), 0);
    candidate_.centroid = mean_of(key_scan_.points);
    camera_.model = {1200, 400, 700, 700, 600, 200, DistortionModel::none, {}};
    query_.camera = camera_.model;
    query_.T_camera_lidar.linear() << 0, -1, 0, 0, 0, -1, 1, 0, 0;
    query_.centroid_lidar_k = candidate_.centroid;
    query_.dt = kPicture_s;
    query_.next_tells = true;
  }

  void patches_lie_on_edges() { candidate_.on_edges = true; }
  void is_foreseen() {
    KnownMotion motion;
    motion.velocity_at_rest.y() = 4;
    motion.velocity_covariance = 0.25 * Eigen::Matrix2d::Identity();
    candidate_.known = candidate_.foreseen = motion;
  }
  /// @return its step until the picture.
  [[nodiscard]] Eigen::Vector2d step() {
    const ObjectMotionOptions options;
    Question question{query_, {}, {}};
    for (const Eigen::Vector3f& point : key_scan_.points) {
      const Eigen::Vector3d in_camera = query_.T_camera_lidar * point.cast<double>();
      question.pairs.push_back({point.cast<double>(), *project(camera_.model, in_camera)});
    }
    question.query.prior = expect_motion(candidate_.known, Stamp{}, Eigen::Matrix3d::Identity(),
                                         candidate_.centroid, kPicture_s, options.prior);
    question.motion = estimate_object_motion(question.pairs, question.query, options);
    int next_track_id = 0;
    const CameraView view(camera_, {}, next_track_id);
    use_next_scan(candidate_, question, view, key_scan_, *next_, options);
    return (question.motion.T_mov * candidate_.centroid - candidate_.centroid).head<2>();
  }

 private:
  LidarScan key_scan_;
  std::unique_ptr<NextScan> next_;
  Candidate candidate_;
  Camera camera_;
  MotionQuery query_;
};

TEST(UseNextScan, a_picture_that_sees_its_surface_stay_is_believed) {
  HeldBack walker;
  walker.is_foreseen();
  EXPECT_LT(walker.step().norm(), 0.02);
}

TEST(UseNextScan, patches_on_edges_do_not_hold_back_who_is_foreseen_to_move) {
  HeldBack walker;
  walker.is_foreseen();
  walker.patches_lie_on_edges();
  EXPECT_NEAR(walker.step().y(), 0.2, 0.03);
  EXPECT_NEAR(walker.step().x(), 0, 0.03);
}

TEST(UseNextScan, patches_on_edges_are_believed_of_whom_nothing_else_is_known) {
  HeldBack walker;
  walker.patches_lie_on_edges();
  EXPECT_LT(walker.step().norm(), 0.02);
}

}  // namespace
}  // namespace lidar_upsampling
