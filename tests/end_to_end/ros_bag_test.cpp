// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationImage.h>

#include <opencv2/core.hpp>

#include "lidar_upsampling/io/carriers.h"
#include "lidar_upsampling/io/images.h"
#include "ros_bag.h"
#include "stock_maps.h"

namespace lidar_upsampling {
namespace {

using mrpt::obs::CObservation3DRangeScan;
using mrpt::obs::CObservationImage;

void add_scan(RosBag& bag, const LidarScan& scan) {
  bag.add("/velodyne_points", kRosPointCloud2, scan.stamp, ros_point_cloud(scan, "velodyne"));
}

void add_depth(RosBag& bag, const LidarScan& scan, const CObservation3DRangeScan& observation) {
  const CameraModel model = from_mrpt(observation.cameraParams);
  bag.add("/tf", kRosTf, scan.stamp, ros_tf(Pose::Identity(), scan.stamp, "map", "depth"));
  bag.add("/depth/camera_info", kRosCameraInfo, scan.stamp,
          ros_camera_info(model, scan.stamp, "depth"));
  bag.add("/depth/image_raw", kRosImage, scan.stamp,
          ros_depth_image(scan, model.width, model.height, "depth"));
}

// The street's log as a ROS robot would have recorded it, each sensor in a frame of its own.
void write_bag(const std::vector<Logged>& log, const std::string& path) {
  RosBag bag;
  for (const Logged& logged : log) {
    if (auto* const picture = dynamic_cast<CObservationImage*>(logged.observation.get())) {
      const CameraImage image = image_from_observation(*picture);
      bag.add("/camera/image_raw", kRosImage, image.stamp, ros_image(image, "camera"));
      bag.add("/camera/camera_info", kRosCameraInfo, image.stamp,
              ros_camera_info(image.camera.model, image.stamp, "camera"));
    } else if (const auto scan = scan_from_observation(*logged.observation)) {
      const auto* const depth =
          dynamic_cast<const CObservation3DRangeScan*>(logged.observation.get());
      if (depth != nullptr && depth->hasRangeImage)
        add_depth(bag, *scan, *depth);
      else
        add_scan(bag, *scan);
    }
  }
  bag.write(path);
}

std::string pose_text(const Pose& T) {
  const mrpt::poses::CPose3D p = to_mrpt(T);
  std::ostringstream text;
  text << p.x() << ' ' << p.y() << ' ' << p.z() << ' ' << mrpt::RAD2DEG(p.yaw()) << ' '
       << mrpt::RAD2DEG(p.pitch()) << ' ' << mrpt::RAD2DEG(p.roll());
  return text.str();
}

// What the converter loses, for rawlog-densify.
void write_rig(const std::vector<Logged>& log, const std::string& lidar, const std::string& path) {
  const auto camera =
      camera_of(dynamic_cast<const CObservationImage&>(*with_label(log, "CAM0")[0].observation));
  const auto scan = scan_from_observation(*with_label(log, lidar)[0].observation).value();
  std::ofstream(path) << "[camera.CAM0]\nfx_px = " << camera.model.fx
                      << "\nfy_px = " << camera.model.fy << "\ncx_px = " << camera.model.cx
                      << "\ncy_px = " << camera.model.cy
                      << "\npose = " << pose_text(camera.T_vehicle_camera) << "\n[lidar." << lidar
                      << "]\npose = " << pose_text(scan.T_vehicle_lidar) << "\n";
}

class RosBagToRawlog : public testing::Test {
 protected:
  void SetUp() override {
    if (!is_installed("rosbag2rawlog")) GTEST_SKIP() << "rosbag2rawlog is not installed";
  }

  /// That of MRPT 2.14, which keeps intensities.
  static bool is_newer() { return contains(run("rosbag2rawlog --help").text, "--base-link"); }

  /// Makes in.rawlog, street.bag, and of it bag.rawlog.
  void convert(const std::string& lidar) {
    simulate(folder_, "", lidar);
    log_ = observations_of(folder_ / "in.rawlog");
    write_bag(log_, folder_ / "street.bag");
    expect_done(
        "MALLOC_MMAP_THRESHOLD_=30000000 MALLOC_TRIM_THRESHOLD_=2000000000 rosbag2rawlog "
        "-c " CONFIG_FOLDER "/rosbag2rawlog.yml " +
        std::string(is_newer() ? "-b" : "-f") + " map -o " + folder_ / "bag.rawlog" + " " +
        folder_ / "street.bag");
    converted_ = observations_of(folder_ / "bag.rawlog");
  }

  void expect_each(const std::string& label) {
    const auto before = with_label(log_, label), after = with_label(converted_, label);
    ASSERT_EQ(after.size(), before.size()) << label;
    for (std::size_t i = 0; i < before.size(); ++i)
      EXPECT_NEAR(seconds_between(before[i].stamp(), after[i].stamp()), 0, 1e-6) << label;
  }

  std::size_t num_virtual_scans(const std::string& lidar) {
    write_rig(log_, lidar, folder_ / "rig.ini");
    expect_done(std::string(RAWLOG_DENSIFY) + " --config " + folder_ / "rig.ini" + " --input " +
                folder_ / "bag.rawlog" + " --output " + folder_ / "out.rawlog" + " --poses " +
                folder_ / "in_ego.csv");
    return with_label(observations_of(folder_ / "out.rawlog"), lidar + "_VIRTUAL").size();
  }

  TestFolder folder_;
  std::vector<Logged> log_, converted_;
};

TEST_F(RosBagToRawlog, of_point_clouds_and_pictures_is_densified_as_any_other) {
  convert(kSmallLidar);
  expect_each("LIDAR");
  expect_each("CAM0");
  EXPECT_EQ(converted_.size(), 18U);
  EXPECT_EQ(num_virtual_scans("LIDAR"), 8U);
  EXPECT_LT(errors_to_truth(folder_)["static_objects_m"]["mean"], 0.03);
}

TEST_F(RosBagToRawlog, of_a_depth_camera_too_before_2_14_which_leaves_depth_out) {
  convert(kDepthCamera);
  expect_each("CAM0");
  if (is_newer()) {
    EXPECT_TRUE(with_label(converted_, "DEPTH").empty());
    return;
  }
  expect_each("DEPTH");
  EXPECT_EQ(num_virtual_scans("DEPTH"), 8U);
}

TEST_F(RosBagToRawlog, loses_sensor_poses_calibration_and_before_2_14_intensity) {
  convert(kSmallLidar);
  expect_each("LIDAR");
  const auto before = with_label(log_, "LIDAR"), after = with_label(converted_, "LIDAR");
  for (std::size_t i = 0; i < after.size(); ++i) {
    const LidarScan was = scan_from_observation(*before[i].observation).value();
    const LidarScan is = scan_from_observation(*after[i].observation).value();
    EXPECT_EQ(is.points, was.points);
    EXPECT_EQ(is.intensity.empty(), !is_newer());
    EXPECT_TRUE(is.T_vehicle_lidar.isApprox(Pose::Identity()));
  }
  for (const Logged& picture : with_label(converted_, "CAM0"))
    EXPECT_FALSE(is_calibrated(
        camera_of(dynamic_cast<const CObservationImage&>(*picture.observation)).model));
}

TEST_F(RosBagToRawlog, keeps_the_pictures_but_perhaps_the_first) {
  convert(kSmallLidar);
  expect_each("CAM0");
  const auto before = with_label(log_, "CAM0"), after = with_label(converted_, "CAM0");
  for (std::size_t i = 1; i < after.size(); ++i) {
    const CameraImage was =
        image_from_observation(dynamic_cast<CObservationImage&>(*before[i].observation));
    const CameraImage is =
        image_from_observation(dynamic_cast<CObservationImage&>(*after[i].observation));
    ASSERT_EQ(is.gray.size(), was.gray.size());
    // Colour pictures have become JPEG.
    EXPECT_LT(cv::norm(is.gray, was.gray, cv::NORM_L1) / static_cast<double>(was.gray.total()), 4.)
        << i;
  }
}

}  // namespace
}  // namespace lidar_upsampling
