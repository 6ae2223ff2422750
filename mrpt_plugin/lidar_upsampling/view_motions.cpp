// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <tbb/parallel_for.h>

#include <algorithm>
#include <tuple>

#include "lidar_upsampling/camera_view.h"
#include "lidar_upsampling/next_scan_motions.h"
#include "lidar_upsampling/objects/covered_points.h"
#include "lidar_upsampling/objects/object_motion.h"
#include "lidar_upsampling/objects/standing_part.h"
#include "lidar_upsampling/registration/point_index.h"
#include "lidar_upsampling/vision/projection.h"

namespace lidar_upsampling {
namespace {

Box2d box_of(const CameraModel& camera, const LidarScan& scan, const std::vector<int>& points,
             const Pose& T_camera_t_lidar_k) {
  Box2d box = Box2d::around_nothing();
  for (const int i : points) {
    const auto pixel = project(camera, T_camera_t_lidar_k * scan.points[i].cast<double>());
    if (pixel) box.extend(pixel->x(), pixel->y());
  }
  return box.right < box.left ? Box2d{} : box;
}

// An object moves from its own instant on. An image taken before it, of an object behind, is taken
// for one right after it.
double since_measured(double dt, const Candidate& candidate) {
  constexpr double kLeast_s = 0.005;
  return candidate.time_s == 0 ? dt : std::max(kLeast_s, dt - candidate.time_s);
}

// The points were put on the anchor picture under `rate`; what was found is the motion since then,
// so the part between scan and anchor follows from it at constant velocity.
Pose over_whole_interval(const Pose& T_mov, const Twist& rate, double anchor_dt, double dt) {
  if (anchor_dt == 0 || dt - anchor_dt <= 0) return T_mov;
  const Pose since_anchor = T_mov * exp_se3(Twist(rate * anchor_dt)).inverse();
  return exp_se3(Twist(log_se3(since_anchor) * (dt / (dt - anchor_dt))));
}

// The query with what is known of the object's motion.
MotionQuery knowing(MotionQuery query, const std::optional<KnownMotion>& known,
                    const Candidate& candidate, const CameraView& view, const LidarScan& key_scan,
                    const ObjectMotionOptions& options) {
  query.known_evidence = known ? evidence_of_motion(*known) : 0;
  query.known_moving = known && known->found_moving;
  query.prior =
      expect_motion(known, shifted(key_scan.stamp, candidate.time_s),
                    view.R_rest_lidar_k.transpose(), candidate.centroid, query.dt, options.prior);
  return query;
}

Question question_about(const CameraView& view, std::size_t i, MotionQuery query,
                        const LidarScan& key_scan, const ObjectMotionOptions& options) {
  const Candidate& candidate = view.candidates[i];
  query.centroid_lidar_k = candidate.centroid;
  query.dt = since_measured(query.dt, candidate);
  return {knowing(query, candidate.known, candidate, view, key_scan, options),
          correspondences_of(view.points, static_cast<int>(i)),
          {}};
}

// Where this picture says nothing, an earlier one since the key scan may, if it is surer than the
// scans: where to look again, and else how to move on. It does not weigh in otherwise, as both
// pictures' tracks share their errors: they begin at the same points.
void fall_back_on_earlier_images(const CameraView& view, std::size_t i, Question& question,
                                 const LidarScan& key_scan, const ObjectMotionOptions& options) {
  const Candidate& candidate = view.candidates[i];
  const auto& [known, seen] = std::tie(candidate.known, candidate.seen);
  if (question.motion.num_inliers > 0 || !seen) return;
  if (question.motion.status == MotionStatus::predicted &&
      known->velocity_covariance.trace() <= seen->velocity_covariance.trace())
    return;
  question.query = knowing(question.query, candidate.seen, candidate, view, key_scan, options);
  question.motion = estimate_object_motion(question.pairs, question.query, options);
}

// The candidate without what stands beside it, which goes on as static scene.
void leave_standing(CameraView& view, std::size_t i, const Question& question,
                    const std::vector<std::uint8_t>& stands, const LidarScan& key_scan) {
  Candidate& candidate = view.candidates[i];
  std::vector<Eigen::Vector3f> followed;
  for (const Correspondence& pair : question.pairs)
    followed.emplace_back(pair.point_in_source.cast<float>());
  const PointIndex index(std::move(followed));
  const auto is_beside = [&](const Eigen::Vector3f& point) {
    return stands[index.nearest(point).index] != 0;
  };
  for (std::size_t j = 0; j < view.points.size(); ++j)
    if (view.points.owner[j] == static_cast<int>(i) &&
        is_beside(view.points.point[j].cast<float>()))
      view.points.owner[j] = kStaticOwner;
  auto& points = candidate.points;
  points.erase(std::remove_if(points.begin(), points.end(),
                              [&](int index_k) { return is_beside(key_scan.points[index_k]); }),
               points.end());
  const auto of_object = points_at(key_scan, points);
  candidate.centroid = mean_of(of_object);
  if (const auto past = view.past.find(candidate.track_id); past != view.past.end())
    past->second.points = of_object;
  candidate.to_next.reset();
  candidate.at_next.reset();
}

// Where moving objects are at the image.
CoverMap cover_map(const CameraView& view, const std::vector<Question>& questions,
                   const LidarScan& scan) {
  const CameraModel& camera = view.camera.model;
  CoverMap map(camera.width, camera.height, view.sampling.half_width_px,
               view.sampling.half_height_px);
  for (std::size_t i = 0; i < questions.size(); ++i) {
    const auto& [query, pairs, motion] = questions[i];
    if (!moves(motion)) continue;
    const Pose T_camera_t_lidar_k = query.T_camera_lidar * motion.T_lidar_t_lidar_k;
    for (const int index : view.candidates[i].points) {
      const Eigen::Vector3d point = T_camera_t_lidar_k * scan.points[index].cast<double>();
      if (const auto pixel = project(camera, point))
        map.add(*pixel, point.z(), static_cast<int>(i));
    }
  }
  return map;
}

// Pieces of one vehicle do not cover each other: what moves alike stays side by side.
std::vector<std::uint8_t> companions_of(std::size_t i, const std::vector<Question>& questions) {
  constexpr double kAlike = 1.5;  // m/s
  const Eigen::Vector3d& velocity = questions[i].motion.velocity_lidar_k;
  std::vector<std::uint8_t> alike(questions.size(), 0);
  for (std::size_t j = 0; j < questions.size(); ++j)
    alike[j] = i == j || (velocity - questions[j].motion.velocity_lidar_k).norm() < kAlike;
  return alike;
}

// Asks again those of whose points a nearer mover covers some by now.
void drop_covered_points(const CameraView& view, const LidarScan& key_scan,
                         const ObjectMotionOptions& options, std::vector<Question>& questions) {
  if (std::none_of(questions.begin(), questions.end(),
                   [](const Question& question) { return moves(question.motion); }))
    return;
  const CoverMap map = cover_map(view, questions, key_scan);
  std::vector<std::vector<std::uint8_t>> companions(questions.size());
  for (std::size_t i = 0; i < questions.size(); ++i) companions[i] = companions_of(i, questions);
  tbb::parallel_for(std::size_t{0}, questions.size(), [&](std::size_t i) {
    Question& question = questions[i];
    const MotionQuery& query = question.query;
    const auto uncovered = without_covered(
        question.pairs, map, query.camera,
        query.T_camera_lidar * query.T_lidar_t_lidar_k * query.prior.T_mov, companions[i]);
    if (uncovered.size() == question.pairs.size()) return;
    question.motion = estimate_object_motion(uncovered, query, options);
    question.pairs = uncovered;
  });
}

// Parts movers from what stands beside them; @return whom to ask again.
std::vector<std::size_t> leave_standing_parts(CameraView& view,
                                              const std::vector<Question>& questions,
                                              const LidarScan& key_scan,
                                              const ObjectMotionOptions& options) {
  std::vector<std::vector<std::uint8_t>> stands(questions.size());
  tbb::parallel_for(std::size_t{0}, questions.size(), [&](std::size_t i) {
    stands[i] = standing_part(questions[i].pairs, questions[i].query, options);
  });
  std::vector<std::size_t> parted;
  for (std::size_t i = 0; i < questions.size(); ++i) {
    if (stands[i].empty()) continue;
    leave_standing(view, i, questions[i], stands[i], key_scan);
    parted.push_back(i);
  }
  return parted;
}

// The answer with all that the virtual scan and the next picture want to know.
ObjectMotion completed(Question question, Candidate& candidate, const CameraView& view,
                       const LidarScan& key_scan, const MotionPriorOptions& options) {
  ObjectMotion motion = std::move(question.motion);
  const MotionQuery& query = question.query;
  if (motion.status == MotionStatus::moving) {
    const Pose T_mov = over_whole_interval(motion.T_mov, candidate.anchor_rate,
                                           view.anchor_dt - candidate.time_s, query.dt);
    set_motion(motion, query.T_lidar_t_lidar_k * T_mov, query);
    candidate.rate = log_se3(T_mov) / query.dt;
    // What an image told is known to the next one: with it, the last one knows all since the key
    // scan.
    if (options.from_images)
      candidate.seen = known_from(motion, shifted(key_scan.stamp, candidate.time_s), query.dt,
                                  view.R_rest_lidar_k);
    if (candidate.at_next) learn_from_picture(candidate, motion, query, view, options);
  }
  if (candidate.at_next && motion.num_inliers > 0)
    candidate.at_next->found_moving = motion.status == MotionStatus::moving;
  motion.track_id = candidate.track_id;
  motion.class_name = candidate.detection.class_name;
  motion.camera_label = view.camera.label;
  motion.points = candidate.points;
  motion.box = box_of(query.camera, key_scan, candidate.points,
                      query.T_camera_lidar * motion.T_lidar_t_lidar_k);
  return motion;
}

}  // namespace

std::vector<ObjectMotion> estimate_motions(CameraView& view, const Picture& picture,
                                           bool is_followed, const LidarScan& key_scan,
                                           const Pose& T_lidar_t_lidar_k, const NextScan* next,
                                           const Config& config) {
  const ObjectMotionOptions& options = config.object_motion;
  MotionQuery query;
  query.camera = view.camera.model;
  query.T_camera_lidar = T_camera_lidar_of(view.camera, key_scan.T_vehicle_lidar);
  query.T_lidar_t_lidar_k = T_lidar_t_lidar_k;
  query.dt = seconds_between(key_scan.stamp, picture.instant);

  std::vector<Question> questions(view.candidates.size());
  const auto ask = [&](std::size_t i) {
    Question& question = questions[i];
    question = question_about(view, i, query, key_scan, options);
    question.query.next_tells = next != nullptr;
    if (!is_followed) question.pairs.clear();
    question.motion = estimate_object_motion(question.pairs, question.query, options);
    fall_back_on_earlier_images(view, i, question, key_scan, options);
    if (next != nullptr)
      use_next_scan(view.candidates[i], question, view, key_scan, *next, options);
  };
  tbb::parallel_for(std::size_t{0}, questions.size(), ask);
  if (options.drop_covered) drop_covered_points(view, key_scan, options, questions);
  if (options.part_standing)
    for (const std::size_t i : leave_standing_parts(view, questions, key_scan, options)) ask(i);
  std::vector<ObjectMotion> motions(questions.size());
  tbb::parallel_for(std::size_t{0}, questions.size(), [&](std::size_t i) {
    motions[i] =
        completed(std::move(questions[i]), view.candidates[i], view, key_scan, options.prior);
  });
  return motions;
}

}  // namespace lidar_upsampling
