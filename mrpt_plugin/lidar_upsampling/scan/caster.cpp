// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/scan/caster.h"

#include <algorithm>
#include <cmath>

namespace lidar_upsampling {

RowCaster::RowCaster(const CastScene& scene, const ResampleOptions& options)
    : scene_(scene),
      reach_(static_cast<float>(1 + options.overlap)),
      max_gap_(static_cast<float>(options.max_gap)),
      same_surface_(static_cast<float>(options.same_surface_m)) {}

std::vector<BeamHit> RowCaster::cast(int row, const RowBeams& beams) {
  take_row(row, beams);
  for (const FootprintsOfRow& from : scene_.footprints)
    for (const Footprint& print : from.on_row[row]) meet(print, from.origin, beams);
  std::vector<BeamHit> hits;
  for (int k = 0; k < static_cast<int>(beams.beams.size()); ++k)
    if (const BeamHit hit = hit_of(k, beams.beams[k].point >= 0); hit.patch >= 0)
      hits.push_back(hit);
  return hits;
}

void RowCaster::take_row(int row, const RowBeams& beams) {
  const std::vector<Eigen::Isometry3f>& back = scene_.motions.back;
  turns_.clear();
  origins_.clear();
  for (const Eigen::Isometry3f& motion : back) {
    turns_.emplace_back(motion.linear() * back[0].linear().transpose());
    origins_.emplace_back(motion * scene_.pattern.rows[row].origin());
  }
  const Eigen::Matrix3f R = back[0].linear();
  const std::size_t size = beams.beams.size();
  for (auto* values : {&x_, &y_, &z_}) values->resize(size + 3, 0);
  for (std::size_t k = 0; k < size; ++k) {
    const Eigen::Vector3f& v = beams.beams[k].direction;
    x_[k] = R(0, 0) * v.x() + R(0, 1) * v.y() + R(0, 2) * v.z();
    y_[k] = R(1, 0) * v.x() + R(1, 1) * v.y() + R(1, 2) * v.z();
    z_[k] = R(2, 0) * v.x() + R(2, 1) * v.y() + R(2, 2) * v.z();
  }
  last_.assign(size, -1);
  num_meetings_ = 0;
}

// Four beams at a time.
void RowCaster::meet(const Footprint& print, const Eigen::Vector3f& origin, const RowBeams& beams) {
  const int motion = scene_.motions.of_patch[print.patch];
  const Patch& patch = scene_.patches[print.patch];
  const Eigen::Array4f from = patch.in_frame(origins_[motion] - origin);
  Eigen::Matrix<float, 4, 3> turned_frame;
  if (motion != 0) turned_frame = patch.frame * turns_[motion];
  const auto& frame = motion == 0 ? patch.frame : turned_frame;
  const Eigen::Array4f& inverse_reach = patch.inverse_reach;
  const int begin = beams.first[print.first_column], end = beams.first[print.last_column + 1];
  if (num_meetings_ + end - begin > static_cast<int>(meetings_.size()))
    meetings_.resize(2 * meetings_.size() + end - begin);
  Meeting* const meetings = meetings_.data();
  int *const last = last_.data(), count = num_meetings_;
  for (int k = begin; k < end; k += 4) {
    using Four = Eigen::Map<const Eigen::Array4f>;
    const Eigen::Array4f x = Four(&x_[k]), y = Four(&y_[k]), z = Four(&z_[k]);
    const Eigen::Array4f approach = frame(0, 0) * x + frame(0, 1) * y + frame(0, 2) * z;
    const Eigen::Array4f range = (1 - from[0]) / approach;
    const Eigen::Array4f ahead =
        from[1] + range * (frame(1, 0) * x + frame(1, 1) * y + frame(1, 2) * z);
    const Eigen::Array4f left =
        from[2] + range * (frame(2, 0) * x + frame(2, 1) * y + frame(2, 2) * z);
    const Eigen::Array4f up =
        from[3] + range * (frame(3, 0) * x + frame(3, 1) * y + frame(3, 2) * z);
    const Eigen::Array4f sideways = (left * inverse_reach[0]).max(left * inverse_reach[1]);
    const Eigen::Array4f upwards = (up * inverse_reach[2]).max(up * inverse_reach[3]);
    const Eigen::Array4f offset = sideways.max(upwards) / ahead;
    // Not if it is parallel or seen from behind.
    const Eigen::Array4f is_near = (max_gap_ - offset).min(ahead).min(range);
    // Without branches, as there is no telling which beams are near.
    for (int i = 0; i < std::min(4, end - k); ++i) {
      meetings[count] = {print.patch, last[k + i], range[i], offset[i], approach[i]};
      const int counts = static_cast<int>(is_near[i] > 0);
      last[k + i] += counts * (count - last[k + i]);
      count += counts;
    }
  }
  num_meetings_ = count;
}

// Of a beam's meetings with the surface that comes first, the mean; the closest one's point is the
// source.
BeamHit RowCaster::hit_of(int beam, bool is_measured) const {
  const Meeting *first = nullptr, *nearest = nullptr;
  int num_hits = 0;
  for_each(beam, [&](const Meeting& meeting) {
    if (nearest == nullptr || meeting.offset < nearest->offset) nearest = &meeting;
    if (meeting.offset > reach_) return;
    ++num_hits;
    if (first == nullptr || meeting.range < first->range) first = &meeting;
  });
  // Where nothing came back before, nothing is expected but what has moved there.
  if (nearest == nullptr || (num_hits == 0 && !is_measured)) return {};
  if (num_hits <= 1) return {beam, nearest->patch, nearest->range};
  // Across the plane of the first one, so that ground seen at a flat angle counts as one surface.
  const float farthest = first->range + same_surface_ *
                                            scene_.patches[first->patch].frame.row(0).norm() /
                                            std::abs(first->approach);
  float sum = 0, sum_weights = 0;
  nearest = first;
  for_each(beam, [&](const Meeting& meeting) {
    if (meeting.offset > reach_ || meeting.range > farthest) return;
    const float weight = 0.001F + reach_ - meeting.offset;
    sum += weight * meeting.range;
    sum_weights += weight;
    if (meeting.offset < nearest->offset) nearest = &meeting;
  });
  return {beam, nearest->patch, sum / sum_weights};
}

}  // namespace lidar_upsampling
