// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/io/depth_image.h"

#include <cmath>
#include <limits>
#include <opencv2/core/mat.hpp>
#include <stdexcept>

#include "lidar_upsampling/io/depth_surface.h"
#include "lidar_upsampling/io/images.h"
#include "lidar_upsampling/vision/projection.h"

namespace lidar_upsampling {
namespace {

using mrpt::obs::CObservation3DRangeScan;

// Metres of range per metre of depth at a pixel.
double range_per_depth(const CameraModel& model, int row, int column, bool range_is_depth) {
  if (range_is_depth) return 1;
  const auto ray = undistort(model, Eigen::Vector2d(column, row));
  return ray ? std::hypot(1., ray->x(), ray->y()) : std::numeric_limits<double>::infinity();
}

void set_ranges(const cv::Mat& depth, const CameraModel& model,
                CObservation3DRangeScan& observation) {
  constexpr double kLargest = std::numeric_limits<std::uint16_t>::max();
  observation.hasRangeImage = true;
  observation.rangeImage_setSize(depth.rows, depth.cols);
  observation.rangeImage.fill(0);
  for (int row = 0; row < depth.rows; ++row) {
    for (int column = 0; column < depth.cols; ++column) {
      const double x = depth.at<float>(row, column);
      if (x == 0) continue;
      const double steps =
          std::round(x * range_per_depth(model, row, column, observation.range_is_depth) /
                     static_cast<double>(observation.rangeUnits));
      // What the unit cannot express is no return.
      if (steps <= kLargest) {
        observation.rangeImage(row, column) = static_cast<std::uint16_t>(steps);
      }
    }
  }
}

bool shows_intensity_of_points(const CObservation3DRangeScan& like) {
  return like.hasIntensityImage && like.doDepthAndIntensityCamerasCoincide() &&
         like.cameraParamsIntensity.ncols == like.cameraParams.ncols &&
         like.cameraParamsIntensity.nrows == like.cameraParams.nrows;
}

}  // namespace

bool is_depth_image(const CObservation3DRangeScan& observation) {
  return observation.hasRangeImage && is_calibrated(from_mrpt(observation.cameraParams));
}

CObservation3DRangeScan::Ptr make_depth_image(const LidarScan& scan,
                                              const CObservation3DRangeScan& like,
                                              bool with_points) {
  const CameraModel model = from_mrpt(like.cameraParams);
  if (!is_depth_image(like)) {
    throw std::invalid_argument("scan '" + like.sensorLabel + "' is no depth image: " +
                                (like.hasRangeImage ? "no intrinsics" : "no range picture"));
  }
  auto observation = CObservation3DRangeScan::Create();
  observation->cameraParams = like.cameraParams;
  observation->cameraParamsIntensity = like.cameraParamsIntensity;
  observation->relativePoseIntensityWRTDepth = like.relativePoseIntensityWRTDepth;
  observation->maxRange = like.maxRange;
  observation->stdError = like.stdError;
  observation->rangeUnits = like.rangeUnits;
  observation->range_is_depth = like.range_is_depth;

  const DepthSurface surface = draw_surface(scan, model);
  set_ranges(surface.depth, model, *observation);
  if (!scan.intensity.empty() && shows_intensity_of_points(like)) {
    cv::Mat gray;
    surface.intensity.convertTo(gray, CV_8U, 255.);
    observation->hasIntensityImage = true;
    observation->intensityImage = mrpt::img::CImage(gray, mrpt::img::DEEP_COPY);
  }
  if (with_points) observation->unprojectInto(*observation);
  return observation;
}

}  // namespace lidar_upsampling
