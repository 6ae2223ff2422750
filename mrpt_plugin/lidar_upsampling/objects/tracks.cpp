// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/objects/tracks.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "lidar_upsampling/robust/assignment.h"

namespace lidar_upsampling {
namespace {

using MaybePlace = std::optional<Place>;

constexpr double kForbidden = 1e3;
constexpr double kSmoothing = 0.5;  ///< weight of the newest rate

Eigen::Vector4d sides(const Box2d& box) { return {box.left, box.top, box.right, box.bottom}; }

TrackPrediction predict(const Track& track, Stamp stamp) {
  const double dt = seconds_between(track.stamp, stamp);
  const Eigen::Vector4d moved = sides(track.box) + dt * track.box_rate;
  TrackPrediction prediction{{moved[0], moved[1], moved[2], moved[3]}, std::nullopt};
  if (prediction.box.area() <= 0) prediction.box = track.box;
  if (track.place) prediction.centroid = track.place->centroid + dt * track.velocity;
  return prediction;
}

/// 0 at the predicted place to 1 at the gate; with both places known the scene decides who may be
/// whom, for on the picture objects cross without meeting.
double place_cost(const TrackPrediction& predicted, const Box2d& box, const MaybePlace& place,
                  double gate, double min_overlap) {
  const double apart = 1 - intersection_over_union(predicted.box, box);
  if (predicted.centroid && place) {
    const double distance = (*predicted.centroid - place->centroid).norm();
    return distance > gate ? kForbidden : 0.5 * (apart + distance / gate);
  }
  return apart > 1 - min_overlap ? kForbidden : apart;
}

double identity_cost(const Track& track, const Detection& detection, double class_change_cost) {
  if (track.external_id >= 0 || detection.external_track >= 0) {
    // The detector's identity settles it; beyond the picture's place and the gate.
    return track.external_id == detection.external_track ? -kForbidden : kForbidden;
  }
  return track.class_name == detection.class_name ? 0 : class_change_cost;
}

// A piece of a vehicle beside it is not that vehicle.
double size_cost(const MaybePlace& before, const MaybePlace& now, double size_change_cost) {
  if (!before || !now || before->size <= 0 || now->size <= 0) return 0;
  return size_change_cost * std::abs(std::log2(now->size / before->size));
}

void follow(Track& track, Stamp stamp, const Detection& detection, const MaybePlace& place) {
  const double dt = seconds_between(track.stamp, stamp);
  if (dt > 0) {
    const double weight = track.age == 1 ? 1 : kSmoothing;
    track.box_rate += weight * ((sides(detection.box) - sides(track.box)) / dt - track.box_rate);
    if (track.place && place) {
      track.velocity += weight * ((place->centroid - track.place->centroid) / dt - track.velocity);
    }
  }
  if (place) track.place = place;
  if (!place && track.place) track.place->centroid += dt * track.velocity;
  track.box = detection.box;
  track.class_name = detection.class_name;
  track.stamp = stamp;
  track.misses = 0;
  ++track.age;
}

Track born(int id, Stamp stamp, const Detection& detection, const MaybePlace& place) {
  Track track;
  track.id = id;
  track.external_id = detection.external_track;
  track.class_name = detection.class_name;
  track.stamp = stamp;
  track.box = detection.box;
  track.place = place;
  return track;
}

}  // namespace

double intersection_over_union(const Box2d& a, const Box2d& b) {
  const Box2d common{std::max(a.left, b.left), std::max(a.top, b.top), std::min(a.right, b.right),
                     std::min(a.bottom, b.bottom)};
  const double both = common.area();
  return both > 0 ? both / (a.area() + b.area() - both) : 0;
}

std::vector<int> Tracker::update(Stamp stamp, const std::vector<Detection>& detections,
                                 const std::vector<std::optional<Place>>& places,
                                 const std::map<int, TrackPrediction>& predictions) {
  if (!places.empty() && places.size() != detections.size()) {
    throw std::invalid_argument("Tracker: " + std::to_string(places.size()) + " places for " +
                                std::to_string(detections.size()) + " detections");
  }
  const auto place_of = [&](std::size_t i) { return places.empty() ? MaybePlace() : places[i]; };

  Eigen::MatrixXd cost(detections.size(), tracks_.size());
  for (std::size_t column = 0; column < tracks_.size(); ++column) {
    const Track& track = tracks_[column];
    const auto given = predictions.find(track.id);
    const TrackPrediction predicted =
        given != predictions.end() ? given->second : predict(track, stamp);
    const double dt = seconds_between(track.stamp, stamp);
    const double gate = options_.max_distance + 0.5 * options_.max_acceleration * dt * dt;
    for (std::size_t row = 0; row < detections.size(); ++row) {
      cost(row, column) =
          identity_cost(track, detections[row], options_.class_change_cost) +
          size_cost(track.place, place_of(row), options_.size_change_cost) +
          place_cost(predicted, detections[row].box, place_of(row), gate, options_.min_overlap);
    }
  }

  const std::vector<int> assigned = solve_assignment(cost, 0.5 * kForbidden);
  for (Track& track : tracks_) ++track.misses;
  std::vector<int> ids;
  for (std::size_t row = 0; row < detections.size(); ++row) {
    if (assigned[row] >= 0) {
      follow(tracks_[assigned[row]], stamp, detections[row], place_of(row));
      ids.push_back(tracks_[assigned[row]].id);
    } else {
      ids.push_back((*next_id_)++);
      tracks_.push_back(born(ids.back(), stamp, detections[row], place_of(row)));
    }
  }
  const auto lost = [&](const Track& track) { return track.misses > options_.max_misses; };
  tracks_.erase(std::remove_if(tracks_.begin(), tracks_.end(), lost), tracks_.end());
  return ids;
}

}  // namespace lidar_upsampling
