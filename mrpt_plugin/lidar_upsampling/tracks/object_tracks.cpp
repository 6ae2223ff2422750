// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/tracks/object_tracks.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "lidar_upsampling/registration/voxel_grid.h"
#include "lidar_upsampling/tracks/hidden_part.h"
#include "lidar_upsampling/tracks/new_track.h"
#include "lidar_upsampling/tracks/pieces.h"
#include "lidar_upsampling/tracks/scan_factor.h"
#include "lidar_upsampling/tracks/touching.h"

namespace lidar_upsampling {
namespace {

/// Whether the covariance no longer says where to look: it is as wide as 0.4 s after the first
/// sight of an object that may go anywhere.
bool is_lost(const ObjectTrack& track, Stamp now, const TrackOptions& options) {
  constexpr double kWide_s = 0.4;
  return !is_known_within(predicted(track.latest, now, options.noise),
                          kWide_s * options.noise.unknown_speed_sigma);
}

/// The end of the first passage, with what the others tell.
TrackState smoothed_first(const std::vector<Passage>& passages, const MotionNoise& noise) {
  TrackState arrived = passages.back().arrived;
  for (std::size_t i = passages.size() - 1; i > 0; --i)
    arrived = passages[i].surprised ? passages[i - 1].arrived
                                    : with_velocity(passages[i - 1].arrived,
                                                    smoothed(passages[i].from, arrived, noise));
  return arrived;
}

/// m, level.
double extent_of(const std::vector<Eigen::Vector3f>& points) {
  Eigen::AlignedBox3f bounds;
  for (const Eigen::Vector3f& point : points) bounds.extend(point);
  return bounds.sizes().head<2>().norm();
}

void see_anew(ObjectTrack& track, const ScanObject& object, std::shared_ptr<const Surface> surface,
              const TrackedScan& scan) {
  track.ahead.reset();
  track.settled.reset();
  track.latest = track.state;
  track.latest_log_odds = track.log_odds;
  track.external_id = object.external_id;
  track.class_name = object.class_name;
  track.stamp = shifted(scan.scan.stamp, object.time_s);
  track.T_rest_lidar = scan.T_rest_lidar;
  track.seen = scan.seen;
  track.surface = std::move(surface);
  track.centroid_rest = scan.T_rest_lidar * object.centroid;
  track.length = object.length;
  track.whole_length = std::max(object.length, extent_of(track.surface->points()));
  track.num_missed = 0;
  track.size = static_cast<double>(object.points.size()) * object.centroid.squaredNorm();
}

/// An object does not shrink as something hides it.
std::shared_ptr<const Surface> with_hidden_part(std::shared_ptr<const Surface> seen,
                                                const ObjectTrack& track, const ScanLesson& lesson,
                                                const ScanObject& object, const TrackedScan& scan) {
  TrackState now = lesson.state;
  if (lesson.log_odds <= 0) now.mean.head<3>().setZero();
  std::vector<Eigen::Vector3f> points = hidden_part(track, now, object, scan);
  if (points.empty()) return seen;
  points.insert(points.end(), seen->points().begin(), seen->points().end());
  return std::make_shared<const Surface>(std::move(points));
}

/// Of what moves; what stands is where it was. After births: a scan that shows a piece of something
/// has not missed it before that piece is judged.
void count_missed(TrackStore& store, const std::vector<int>& track_of, const TrackedScan& scan,
                  const TrackOptions& options) {
  std::vector<bool> is_seen(store.tracks.size(), false);
  for (const int track : track_of)
    if (track >= 0) is_seen[track] = true;
  for (std::size_t i = 0; i < store.tracks.size(); ++i) {
    ObjectTrack& track = store.tracks[i];
    if (is_seen[i] || track.latest_log_odds <= 0) continue;
    const TrackState now = predicted(track.latest, scan.scan.stamp, options.noise);
    if (!is_hidden(*scan.seen, points_by(track, now, scan.T_rest_lidar))) ++track.num_missed;
  }
}

}  // namespace

Eigen::Matrix2d level_axes(const Eigen::Matrix3d& R_rest_lidar) {
  return Eigen::Rotation2Dd(std::atan2(R_rest_lidar(1, 0), R_rest_lidar(0, 0))).toRotationMatrix();
}

Eigen::Matrix2d ego_error(const TrackedScan& scan, const Eigen::Vector3d& place) {
  Eigen::Matrix<double, 3, 6> by_twist;
  by_twist << -skew(place), Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d error = by_twist * scan.step_covariance * by_twist.transpose();
  const Eigen::Matrix2d R = level_axes(scan.T_rest_lidar.linear());
  return R * error.topLeftCorner<2, 2>() * R.transpose();
}

std::vector<int> take_up_scan(TrackStore& store, std::vector<ScanObject>& objects,
                              const TrackedScan& scan, const TrackOptions& options) {
  auto& tracks = store.tracks;
  const auto lost = [&](const ObjectTrack& track) {
    return is_lost(track, scan.scan.stamp, options);
  };
  tracks.erase(std::remove_if(tracks.begin(), tracks.end(), lost), tracks.end());
  part_touching(store, scan, options, objects);
  std::vector<int> track_of = associate(tracks, objects, scan, options);
  join_pieces(store, scan, options, objects, track_of);
  const std::size_t num_known = tracks.size();
  std::vector<std::shared_ptr<const Surface>> surfaces(objects.size());
  tbb::parallel_for(std::size_t{0}, objects.size(), [&](std::size_t i) {
    surfaces[i] = std::make_shared<const Surface>(
        group_by_voxel(points_at(scan.scan, objects[i].points), kFine_m).means);
    if (track_of[i] < 0) return;
    ObjectTrack& track = tracks[track_of[i]];
    const ScanLesson lesson = learn_from_scans(track, objects[i], *surfaces[i], scan, options);
    surfaces[i] = with_hidden_part(surfaces[i], track, lesson, objects[i], scan);
    track.passage = Passage{lesson.from, lesson.state, lesson.surprises};
    track.state = from_here(lesson.state);
    track.by_scans = from_here(lesson.by_scans);
    track.beginnings.clear();
    track.log_odds = lesson.log_odds;
    see_anew(track, objects[i], surfaces[i], scan);
  });
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (track_of[i] >= 0) continue;
    track_of[i] = static_cast<int>(tracks.size());
    ObjectTrack track = new_track(objects[i], scan, tracks, num_known, options);
    see_anew(track, objects[i], surfaces[i], scan);
    track.id = store.next_id++;
    tracks.push_back(std::move(track));
  }
  count_missed(store, track_of, scan, options);
  return track_of;
}

bool is_mover(const ObjectTrack& track, const TrackOptions& options) {
  return track.latest_log_odds > std::log(options.loss_ratio);
}

double probability_of_being_there(const ObjectTrack& track) {
  constexpr double kMissed = 0.1;  // of what is there to be seen, in one scan
  return std::pow(kMissed, track.num_missed);
}

bool is_known_within(const TrackState& state, double sigma_m) {
  return state.covariance.topLeftCorner<2, 2>().trace() < 2 * sigma_m * sigma_m;
}

bool is_predictable(const ObjectTrack& track, const TrackState& now, const TrackOptions& options) {
  return is_mover(track, options) && is_known_within(now, kReach_m);
}

Eigen::Isometry3f from_sight(const ObjectTrack& track, const TrackState& now,
                             const Pose& T_rest_lidar) {
  Twist motion = Twist::Zero();
  motion[2] = now.mean[2];
  motion.segment<2>(3) = now.mean.head<2>();
  const Pose T_rest_then = motion_pose(motion, track.centroid_rest) * track.T_rest_lidar;
  return (T_rest_lidar.inverse() * T_rest_then).cast<float>();
}

std::vector<Eigen::Vector3f> points_by(const ObjectTrack& track, const TrackState& now,
                                       const Pose& T_rest_lidar) {
  const Eigen::Isometry3f T_lidar_then = from_sight(track, now, T_rest_lidar);
  std::vector<Eigen::Vector3f> points;
  points.reserve(track.surface->points().size());
  for (const Eigen::Vector3f& point : track.surface->points())
    points.emplace_back(T_lidar_then * point);
  return points;
}

void go_on(ObjectTrack& track, TrackState now, const Pose& T_rest_lidar,
           const TrackOptions& options) {
  track.surface = std::make_shared<const Surface>(points_by(track, now, T_rest_lidar));
  track.centroid_rest.head<2>() += now.mean.head<2>();
  track.T_rest_lidar = T_rest_lidar;
  track.log_odds = log_odds_at(now.stamp, track.class_name, track, track.latest_log_odds, options);
  track.latest_log_odds = track.log_odds;
  track.stamp = now.stamp;
  track.seen.reset();
  track.num_missed = 0;
  now.mean.head<3>().setZero();  // its covariance stays: that is how well its place is known
  track.state = track.by_scans = track.latest = now;
  track.beginnings.clear();
  track.passage.reset();
  track.ahead.reset();
  track.settled.reset();
}

TrackState ObjectTrack::expected_at(Stamp instant, const MotionNoise& noise) const {
  if (!ahead) return predicted(state, instant, noise);
  TrackState now = smoothed(predicted(ahead->from, instant, noise), ahead->next, noise);
  // Of what was hidden at its last sight, the scans to come tell that place, too.
  now.mean.head<3>() -= smoothed(ahead->from, ahead->next, noise).mean.head<3>();
  return now;
}

void look_ahead(TrackStore& store, const std::vector<ScanToCome>& to_come,
                const TrackOptions& options) {
  TrackStore later = store;
  std::map<int, std::vector<Passage>> passages;  // by track id
  std::map<int, double> log_odds;
  for (const ScanToCome& next : to_come) {
    std::vector<ScanObject> objects = next.objects;
    for (const int i : take_up_scan(later, objects, next.scan, options)) {
      const ObjectTrack& track = later.tracks[i];
      if (track.passage) passages[track.id].push_back(*track.passage);
      log_odds[track.id] = track.log_odds;
    }
  }
  for (ObjectTrack& track : store.tracks) {
    const auto found = passages.find(track.id);
    if (found == passages.end()) continue;
    track.ahead = Ahead{found->second.front().from, smoothed_first(found->second, options.noise),
                        log_odds[track.id]};
  }
}

}  // namespace lidar_upsampling
