// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "lidar_upsampling/objects/detector.h"
#include "lidar_upsampling/objects/network_output.h"

namespace lidar_upsampling {
namespace {

namespace fs = std::filesystem;

// Three classes, the second unwanted.
const std::vector<bool> kWanted{true, false, true};

void expect_box(const NetworkBox& found, int class_id, double score) {
  EXPECT_EQ(found.class_id, class_id);
  EXPECT_NEAR(found.score, score, 1e-6);
  EXPECT_NEAR(found.box.left, 0.4, 1e-6);
  EXPECT_NEAR(found.box.right, 0.6, 1e-6);
  EXPECT_NEAR(found.box.top, 0.2, 1e-6);
  EXPECT_NEAR(found.box.bottom, 0.3, 1e-6);
}

TEST(NetworkOutput, region_rows_hold_scores_that_are_final) {
  const cv::Mat output = (cv::Mat_<float>(3, 8) << 0.5, 0.25, 0.2, 0.1, 0.9, 0.1, 0, 0.8,  //
                          0.5, 0.25, 0.2, 0.1, 0.9, 0, 0.9, 0,                             //
                          0.5, 0.25, 0.2, 0.1, 0.9, 0.2, 0, 0);
  ASSERT_EQ(guess_layout(output, 3), NetworkLayout::region);
  const auto boxes = decode_output(output, NetworkLayout::region, {320, 200}, kWanted, 0.3);
  ASSERT_EQ(boxes.size(), 1U);
  expect_box(boxes[0], 2, 0.8);
}

TEST(NetworkOutput, rows_hold_pixels_and_scores_to_multiply) {
  const int size[] = {1, 2, 8};
  cv::Mat output(3, size, CV_32F, cv::Scalar(0));
  const float candidate[] = {160, 50, 64, 20, 0.5F, 0.9F, 1, 0};
  std::copy(std::begin(candidate), std::end(candidate), output.ptr<float>() + 8);
  ASSERT_EQ(guess_layout(output, 3), NetworkLayout::rows);
  const auto boxes = decode_output(output, NetworkLayout::rows, {320, 200}, kWanted, 0.3);
  ASSERT_EQ(boxes.size(), 1U);
  expect_box(boxes[0], 0, 0.45);
}

TEST(NetworkOutput, columns_hold_pixels_without_objectness) {
  const int size[] = {1, 7, 4};
  cv::Mat output(3, size, CV_32F, cv::Scalar(0));
  const float candidate[] = {160, 50, 64, 20, 0.7F, 1, 0};
  for (int i = 0; i < 7; ++i) output.ptr<float>()[4 * i + 2] = candidate[i];
  ASSERT_EQ(guess_layout(output, 3), NetworkLayout::columns);
  const auto boxes = decode_output(output, NetworkLayout::columns, {320, 200}, kWanted, 0.3);
  ASSERT_EQ(boxes.size(), 1U);
  expect_box(boxes[0], 0, 0.7);
}

TEST(NetworkOutput, anchor_free_cells_hold_offsets_and_sizes_to_squash) {
  const int size[] = {1, 8, 2, 4};
  cv::Mat output(4, size, CV_32F, cv::Scalar(0));
  const auto set = [&](int channel, double value) {
    output.ptr<float>()[channel * 8 + 1 * 4 + 2] = static_cast<float>(value);
  };
  set(0, 0.6);
  set(1, 0);                 // centre at the cell's corner, 2 of 4
  set(2, std::atanh(-0.5));  // 1 - 0.5 of 2
  set(3, std::log(0.2 / 0.8));
  set(4, std::log(0.1 / 0.9));
  set(7, 0.9);
  ASSERT_EQ(guess_layout(output, 3), NetworkLayout::anchor_free);
  const auto boxes = decode_output(output, NetworkLayout::anchor_free, {352, 352}, kWanted, 0.3);
  ASSERT_EQ(boxes.size(), 1U);
  expect_box(boxes[0], 2, std::pow(0.6, 0.6) * std::pow(0.9, 0.4));
}

TEST(NetworkOutput, a_shape_of_another_number_of_classes_fits_no_layout) {
  EXPECT_FALSE(guess_layout(cv::Mat::zeros(3, 9, CV_32F), 3));
}

TEST(NetworkDetector, a_missing_model_is_named) {
  DetectorOptions options;
  options.type = DetectorOptions::Type::network;
  options.network.model = "/nowhere/model.onnx";
  try {
    static_cast<void>(make_detector(options));
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("/nowhere/model.onnx"), std::string::npos);
  }
}

/// Where the real data lies, or an empty path.
fs::path data_folder() {
  const char* set = std::getenv("LIDAR_UPSAMPLING_DATA");
  const fs::path folder =
      set != nullptr ? fs::path(set) : fs::path(LIDAR_UPSAMPLING_SOURCE_DIR) / "../shared/data";
  return fs::exists(folder / "detectors") ? folder : fs::path();
}

CameraImage lead_car_image(const fs::path& data) {
  const fs::path folder = data / "kitti_raw/2011_09_26/2011_09_26_drive_0052_sync/image_02/data";
  CameraImage image;
  image.bgr = cv::imread((folder / "0000000000.png").string());
  if (image.bgr.empty()) image.bgr = cv::imread((folder / "0000000000.jpg").string());
  return image;
}

/// The lead car of the first image of drive 0052, measured by hand.
void expect_lead_car(const NetworkDetectorOptions& options, const fs::path& data) {
  const CameraImage image = lead_car_image(data);
  if (image.bgr.empty()) GTEST_SKIP() << "no image of drive 0052 in " << data;
  const auto detector = make_network_detector(options);
  double best = 0;
  for (const Detection& detection : detector->detect(image)) {
    EXPECT_NE(detection.class_name, "traffic light");
    if (detection.class_name != "car") continue;
    best = std::max(best, intersection_over_union(detection.box, {551, 184, 706, 325}));
  }
  EXPECT_GT(best, 0.6);
}

TEST(NetworkDetector, darknet_model_finds_the_lead_car) {
  const fs::path data = data_folder();
  if (data.empty()) GTEST_SKIP() << "no detectors in LIDAR_UPSAMPLING_DATA";
  NetworkDetectorOptions options;
  const fs::path folder = data / "detectors/yolo-fastest";
  options.model = (folder / "yolo-fastest-1.1-xl.weights").string();
  options.config = (folder / "yolo-fastest-1.1-xl.cfg").string();
  options.classes = (folder / "coco.names").string();
  options.input_width = 1248;
  options.input_height = 384;
  expect_lead_car(options, data);
}

TEST(NetworkDetector, onnx_model_finds_the_lead_car) {
  const fs::path data = data_folder();
  if (data.empty()) GTEST_SKIP() << "no detectors in LIDAR_UPSAMPLING_DATA";
  NetworkDetectorOptions options;
  const fs::path folder = data / "detectors/fastestdet";
  options.model = (folder / "FastestDet.onnx").string();
  options.classes = (folder / "coco.names").string();
  options.input_width = options.input_height = 352;
  expect_lead_car(options, data);
}

TEST(NetworkDetector, a_wanted_class_that_the_network_does_not_know_is_named) {
  const fs::path data = data_folder();
  if (data.empty()) GTEST_SKIP() << "no detectors in LIDAR_UPSAMPLING_DATA";
  NetworkDetectorOptions options;
  const fs::path folder = data / "detectors/yolo-fastest";
  options.model = (folder / "yolo-fastest-1.1.weights").string();
  options.config = (folder / "yolo-fastest-1.1.cfg").string();
  options.classes = (folder / "coco.names").string();
  options.wanted = {"car", "dragon"};
  try {
    static_cast<void>(make_network_detector(options));
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("dragon"), std::string::npos);
  }
}

}  // namespace
}  // namespace lidar_upsampling
