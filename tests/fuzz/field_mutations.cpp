// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "fuzz/field_mutations.h"

#include <opencv2/core.hpp>

namespace lidar_upsampling::fuzz {

Stamp odd_stamp(Stamp stamp, Random& random) {
  switch (random.below(6)) {
    case 0:
      return INVALID_TIMESTAMP;
    case 1:
      return Stamp(Stamp::duration(static_cast<std::int64_t>(random.bits())));
    case 2:
      return Stamp(Stamp::duration(std::numeric_limits<std::int64_t>::max()));
    case 3:
      return Stamp(Stamp::duration(1));
    case 4:
      return shifted(stamp, random.one_in(2) ? 3600. : -3600.);
    default:
      return shifted(stamp, 1e-3 * (static_cast<double>(random.below(400)) - 200));
  }
}

mrpt::poses::CPose3D odd_pose(mrpt::poses::CPose3D pose, Random& random) {
  const double value = random.odd_number();
  if (random.one_in(2)) {
    pose.x(value);
    return pose;
  }
  pose.setYawPitchRoll(value, random.one_in(2) ? value : 0, 0);
  return pose;
}

void spoil(mrpt::img::TCamera& camera, Random& random) {
  const double value = random.odd_number();
  switch (random.below(6)) {
    case 0:
      camera.fx(value);
      return;
    case 1:
      camera.fy(value);
      return;
    case 2:
      camera.cx(value);
      return;
    case 3:
      camera.ncols = random.odd_count();
      return;
    case 4:
      camera.nrows = random.odd_count();
      return;
    default:
      camera.distortion = static_cast<mrpt::img::DistortionModel>(random.below(5));
      camera.dist[random.below(camera.dist.size())] = value;
  }
}

mrpt::img::CImage odd_picture(Random& random) {
  const int rows = static_cast<int>(1 + random.below(70));
  const int columns = static_cast<int>(1 + random.below(70));
  if (random.one_in(6)) return {};
  cv::Mat pixels(rows, columns, random.one_in(2) ? CV_8UC1 : CV_8UC3, cv::Scalar::all(77));
  return {pixels, mrpt::img::DEEP_COPY};
}

}  // namespace lidar_upsampling::fuzz
