// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/io/images.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "lidar_upsampling/io/rawlog_stream.h"
#include "test_folder.h"

namespace fs = std::filesystem;

namespace lidar_upsampling {
namespace {

Camera wide_camera() {
  Camera camera;
  camera.label = "CAM";
  camera.model.width = 64;
  camera.model.height = 48;
  camera.model.fx = 50;
  camera.model.fy = 51;
  camera.model.cx = 31;
  camera.model.cy = 24;
  camera.model.distortion_model = DistortionModel::plumb_bob;
  camera.model.distortion = {-0.3, 0.1, 0.001, 0.002, -0.02, 0, 0, 0};
  camera.T_vehicle_camera.translate(Eigen::Vector3d(1, 2, 3));
  camera.T_vehicle_camera.rotate(Eigen::AngleAxisd(1.1, Eigen::Vector3d::UnitY()));
  return camera;
}

CameraImage random_image(int type) {
  CameraImage image;
  image.stamp = Stamp(mrpt::Clock::duration(132000000000000009LL));
  image.camera = wide_camera();
  cv::Mat pixels(48, 64, type);
  cv::RNG random(5);
  random.fill(pixels, cv::RNG::UNIFORM, 0, 256);
  (type == CV_8UC1 ? image.gray : image.bgr) = pixels;
  return image;
}

double largest_difference(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() ? cv::norm(a, b, cv::NORM_INF) : 1e9;
}

TEST(Images, camera_and_pixels_go_through_an_observation) {
  for (const int type : {CV_8UC1, CV_8UC3}) {
    const CameraImage image = random_image(type);
    const CameraImage read = image_from_observation(*observation_from_image(image));
    EXPECT_EQ(read.stamp, image.stamp);
    EXPECT_EQ(read.camera.label, "CAM");
    EXPECT_EQ(read.camera.model.fy, 51);
    EXPECT_EQ(read.camera.model.cx, 31);
    EXPECT_EQ(read.camera.model.distortion_model, DistortionModel::plumb_bob);
    EXPECT_EQ(read.camera.model.distortion, image.camera.model.distortion);
    EXPECT_TRUE(read.camera.T_vehicle_camera.isApprox(image.camera.T_vehicle_camera, 1e-12));
    EXPECT_EQ(read.gray.type(), CV_8UC1);
    EXPECT_EQ(read.bgr.empty(), type == CV_8UC1);
    const bool gray = type == CV_8UC1;
    EXPECT_EQ(largest_difference(gray ? read.gray : read.bgr, gray ? image.gray : image.bgr), 0);
  }
}

TEST(Images, calibration_follows_the_size_of_the_picture) {
  const auto observation = observation_from_image(random_image(CV_8UC1));
  observation->cameraParams.ncols = 128;  // calibrated at twice the size
  observation->cameraParams.nrows = 96;
  const CameraModel model = image_from_observation(*observation).camera.model;
  EXPECT_EQ(model.width, 64);
  EXPECT_EQ(model.height, 48);
  EXPECT_DOUBLE_EQ(model.fx, 25);
  // The border between the pixels 63 and 64 is the one between 31 and 32 of the smaller picture.
  EXPECT_DOUBLE_EQ(model.cx, (31 + 0.5) / 2 - 0.5);
}

TEST(Images, mrpts_defaults_are_no_calibration) {
  EXPECT_FALSE(is_calibrated(from_mrpt(mrpt::img::TCamera())));
  CameraModel model = wide_camera().model;
  EXPECT_TRUE(is_calibrated(model));
  model.cx = 70;
  EXPECT_FALSE(is_calibrated(model));
}

TEST(Images, external_pictures_are_found_beside_the_log) {
  const TestFolder folder;
  const CameraImage image = random_image(CV_8UC3);
  fs::create_directory(folder / "log_Images");
  cv::imwrite(folder / "log_Images/0.png", image.bgr);
  const auto observation = observation_from_image(image);
  observation->image.setExternalStorage("0.png");
  {
    RawlogWriter writer(folder / "log.rawlog", false);
    writer.write(*observation);
    writer.commit();
  }
  RawlogReader reader(folder / "log.rawlog");
  const RawlogEntry entry = reader.next().value();
  auto& read = dynamic_cast<mrpt::obs::CObservationImage&>(*entry.object);
  EXPECT_EQ(camera_of(read).label, "CAM");
  EXPECT_EQ(largest_difference(image_from_observation(read).bgr, image.bgr), 0);
  EXPECT_EQ(entry_of(entry.object).bytes, entry.bytes);  // unloaded again

  ASSERT_TRUE(share_external_storage(folder / "log.rawlog", folder / "other.rawlog"));
  EXPECT_TRUE(fs::exists(folder / "other_Images/0.png"));
  EXPECT_TRUE(share_external_storage(folder / "log.rawlog", folder / "other.rawlog"));
  fs::create_directory(folder / "third_Images");
  EXPECT_FALSE(share_external_storage(folder / "log.rawlog", folder / "third.rawlog"));
}

TEST(Images, two_open_logs_find_each_their_own_pictures) {
  const TestFolder folder;
  for (const char* const name : {"a", "b"}) {
    fs::create_directory(folder / (std::string(name) + "_Images"));
    cv::imwrite(folder / (std::string(name) + "_Images/0.png"),
                cv::Mat(48, 64, CV_8UC1, cv::Scalar(name[0])));
    const auto observation = observation_from_image(random_image(CV_8UC1));
    observation->image.setExternalStorage("0.png");
    RawlogWriter writer(folder / (std::string(name) + ".rawlog"), false);
    writer.write(*observation);
    writer.commit();
  }
  RawlogReader a(folder / "a.rawlog");
  RawlogReader b(folder / "b.rawlog");
  const auto first_pixel = [](RawlogReader& reader) {
    const RawlogEntry entry = reader.next().value();
    return image_from_observation(dynamic_cast<mrpt::obs::CObservationImage&>(*entry.object))
        .gray.at<std::uint8_t>(0, 0);
  };
  EXPECT_EQ(first_pixel(a), 'a');
  EXPECT_EQ(first_pixel(b), 'b');
}

std::string error_of(mrpt::obs::CObservationImage& observation) {
  try {
    static_cast<void>(image_from_observation(observation));
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(Images, missing_and_broken_pictures_are_named) {
  const TestFolder folder;
  std::ofstream(folder / "broken.png") << "no picture";
  const auto observation = observation_from_image(random_image(CV_8UC1));
  for (const char* const file : {"none.png", "broken.png"}) {
    observation->image.setExternalStorage(folder / file);
    const std::string text = error_of(*observation);
    EXPECT_NE(text.find(file), std::string::npos) << text;
    EXPECT_NE(text.find("CAM"), std::string::npos) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  }
  mrpt::obs::CObservationImage empty;
  EXPECT_NE(error_of(empty), "");
}

}  // namespace
}  // namespace lidar_upsampling
