// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/io/images.h"

#include <mrpt/system/datetime.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "lidar_upsampling/io/silence.h"
#include "lidar_upsampling/text.h"

namespace lidar_upsampling {
namespace {

using mrpt::img::CImage;

static_assert(static_cast<int>(DistortionModel::plumb_bob) ==
                  static_cast<int>(mrpt::img::DistortionModel::plumb_bob) &&
              static_cast<int>(DistortionModel::kannala_brandt) ==
                  static_cast<int>(mrpt::img::DistortionModel::kannala_brandt));

cv::Mat to_8_bit(const cv::Mat& pixels) {
  if (pixels.depth() == CV_8U) return pixels;
  cv::Mat out;
  pixels.convertTo(out, CV_8U, pixels.depth() == CV_16U ? 1. / 257. : 255.);
  return out;
}

cv::Mat load_pixels(const mrpt::obs::CObservationImage& observation) {
  const CImage& image = observation.image;
  const Silence silence;
  try {
    if (image.isExternallyStored()) image.forceLoad();
    cv::Mat pixels = to_8_bit(image.asCvMat<cv::Mat>(mrpt::img::DEEP_COPY));
    image.unload();  // does nothing to an embedded one
    if (pixels.empty()) throw std::runtime_error("it is empty");
    return pixels;
  } catch (const std::exception& error) {
    throw std::runtime_error("no picture in image '" + observation.sensorLabel + "' of " +
                             mrpt::system::dateTimeToString(observation.timestamp) +
                             (image.isExternallyStored()
                                  ? ", file " + image.getExternalStorageFileAbsolutePath()
                                  : std::string(", embedded")) +
                             ": " + one_line(error));
  }
}

}  // namespace

Pose from_mrpt(const mrpt::poses::CPose3D& pose) {
  Pose T;
  T.matrix() = pose.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>().asEigen();
  return T;
}

mrpt::poses::CPose3D to_mrpt(const Pose& pose) {
  return mrpt::poses::CPose3D(mrpt::math::CMatrixDouble44(pose.matrix()));
}

CameraModel from_mrpt(const mrpt::img::TCamera& camera) {
  CameraModel model;
  model.width = static_cast<int>(camera.ncols);
  model.height = static_cast<int>(camera.nrows);
  model.fx = camera.fx();
  model.fy = camera.fy();
  model.cx = camera.cx();
  model.cy = camera.cy();
  if (camera.distortion == mrpt::img::DistortionModel::none) return model;  // so are coefficients
  model.distortion_model = static_cast<DistortionModel>(camera.distortion);
  std::copy(camera.dist.begin(), camera.dist.end(), model.distortion.begin());
  return model;
}

mrpt::img::TCamera to_mrpt(const CameraModel& model) {
  mrpt::img::TCamera camera;
  camera.ncols = static_cast<std::uint32_t>(model.width);
  camera.nrows = static_cast<std::uint32_t>(model.height);
  camera.setIntrinsicParamsFromValues(model.fx, model.fy, model.cx, model.cy);
  camera.distortion = static_cast<mrpt::img::DistortionModel>(model.distortion_model);
  std::copy(model.distortion.begin(), model.distortion.end(), camera.dist.begin());
  return camera;
}

CameraModel scaled(const CameraModel& model, int width, int height) {
  CameraModel out = model;
  if (model.width > 0 && model.height > 0) {
    const double sx = static_cast<double>(width) / model.width;
    const double sy = static_cast<double>(height) / model.height;
    // Pixel centres lie at whole numbers, so it is the outer border, at -0.5, that scales.
    out.fx *= sx;
    out.fy *= sy;
    if (width != model.width) out.cx = (model.cx + 0.5) * sx - 0.5;
    if (height != model.height) out.cy = (model.cy + 0.5) * sy - 0.5;
  }
  out.width = width;
  out.height = height;
  return out;
}

bool is_calibrated(const CameraModel& model) {
  return model.fx > 0 && model.fy > 0 && model.cx > 0 && model.cy > 0 && model.cx < model.width &&
         model.cy < model.height;
}

Camera camera_of(const mrpt::obs::CObservationImage& observation) {
  return {observation.sensorLabel, from_mrpt(observation.cameraParams),
          from_mrpt(observation.cameraPose)};
}

CameraImage image_from_observation(const mrpt::obs::CObservationImage& observation) {
  CameraImage image{observation.timestamp, camera_of(observation), {}, {}};
  const cv::Mat pixels = load_pixels(observation);
  image.camera.model = scaled(image.camera.model, pixels.cols, pixels.rows);
  if (pixels.channels() == 1) {
    image.gray = pixels;
    return image;
  }
  if (pixels.channels() == 4) {
    cv::cvtColor(pixels, image.bgr, cv::COLOR_BGRA2BGR);
  } else {
    image.bgr = pixels;
  }
  cv::cvtColor(image.bgr, image.gray, cv::COLOR_BGR2GRAY);
  return image;
}

mrpt::obs::CObservationImage::Ptr observation_from_image(const CameraImage& image) {
  auto observation = mrpt::obs::CObservationImage::Create();
  observation->timestamp = image.stamp;
  observation->sensorLabel = image.camera.label;
  observation->cameraParams = to_mrpt(image.camera.model);
  observation->cameraPose = to_mrpt(image.camera.T_vehicle_camera);
  observation->image = CImage(image.bgr.empty() ? image.gray : image.bgr, mrpt::img::DEEP_COPY);
  return observation;
}

}  // namespace lidar_upsampling
