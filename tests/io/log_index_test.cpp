// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/io/log_index.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <filesystem>

#include "lidar_upsampling/io/carriers.h"
#include "lidar_upsampling/io/images.h"
#include "lidar_upsampling/io/rawlog_stream.h"
#include "test_folder.h"

namespace fs = std::filesystem;

namespace lidar_upsampling {
namespace {

using mrpt::poses::CPose3D;

Stamp at(double seconds) {
  return shifted(Stamp(mrpt::Clock::duration(132000000000000000LL)), seconds);
}

template <typename T>
std::shared_ptr<T> observation(const std::string& label, double seconds) {
  auto made = T::Create();
  made->sensorLabel = label;
  made->timestamp = at(seconds);
  return made;
}

mrpt::obs::CObservation::Ptr scan(double seconds) {
  LidarScan points;
  points.label = "LIDAR";
  points.stamp = at(seconds);
  points.points.emplace_back(1.F, 2.F, 3.F);
  return observation_from_scan(points, Carrier::automatic);
}

mrpt::obs::CObservation::Ptr external_image(const std::string& label, double seconds, double fx) {
  const auto image = observation<mrpt::obs::CObservationImage>(label, seconds);
  image->image.setExternalStorage("not_there.png");
  image->cameraParams.ncols = 640;
  image->cameraParams.nrows = 480;
  image->cameraParams.setIntrinsicParamsFromValues(fx, fx, 320, 240);
  return image;
}

mrpt::obs::CObservation::Ptr fix(double seconds, int quality, double clock_error = 0) {
  const auto gps = observation<mrpt::obs::CObservationGPS>("GPS", seconds + clock_error);
  gps->originalReceivedTimestamp = at(seconds + 0.05);
  gps->has_satellite_timestamp = true;
  gps->sensorPose = CPose3D(0.5, 0, 2, 0, 0, 0);
  mrpt::obs::gnss::Message_NMEA_GGA message;
  message.fields.latitude_degrees = 49;
  message.fields.longitude_degrees = 8;
  message.fields.altitude_meters = 110;
  message.fields.geoidal_distance = 47.5;
  message.fields.fix_quality = static_cast<std::uint8_t>(quality);
  gps->setMsg(message);
  return gps;
}

using Objects = std::vector<mrpt::serialization::CSerializable::Ptr>;

LogIndex index_of(const Objects& objects, const TestFolder& folder) {
  RawlogWriter writer(folder / "log.rawlog", true);
  for (const auto& object : objects) writer.write(*object);
  writer.commit();
  return index_log(folder / "log.rawlog");
}

TEST(LogIndex, tells_the_streams_apart) {
  const TestFolder folder;
  Objects objects;
  for (int i = 0; i < 5; ++i) {
    objects.push_back(scan(0.1 * i));
    objects.push_back(external_image("CAM2", 0.1 * i + 0.01, 700));
  }
  objects.push_back(external_image("BLIND", 0.6, 0));
  objects.push_back(observation<mrpt::obs::CObservationIMU>("IMU", 0.7));
  const LogIndex index = index_of(objects, folder);
  ASSERT_EQ(index.streams.size(), 4U);
  EXPECT_EQ(index.num_objects, 12U);
  EXPECT_FALSE(index.has_frames);
  EXPECT_FALSE(index.corruption);

  const StreamInfo* const lidar = index.find("LIDAR", StreamKind::lidar);
  ASSERT_NE(lidar, nullptr);
  EXPECT_EQ(lidar->count, 5U);
  EXPECT_EQ(lidar->stamps.back(), at(0.4));
  EXPECT_NEAR(lidar->median_period_s, 0.1, 1e-6);
  EXPECT_EQ(index.find("CAM2", StreamKind::lidar), nullptr);

  const StreamInfo* const camera = index.find("CAM2", StreamKind::camera);
  ASSERT_NE(camera, nullptr);
  EXPECT_TRUE(camera->calibrated());
  EXPECT_EQ(camera->class_name, "CObservationImage");
  EXPECT_EQ(camera->camera->model.width, 640);
  EXPECT_FALSE(index.find("BLIND", StreamKind::camera)->calibrated());
  EXPECT_EQ(index.of_kind(StreamKind::camera).size(), 2U);

  EXPECT_EQ(labels_of(index), "LIDAR (lidar), CAM2 (camera), BLIND (camera), IMU (other)");
  EXPECT_NE(describe(index).find("not calibrated"), std::string::npos) << describe(index);
}

TEST(LogIndex, robot_poses_become_vehicle_poses) {
  const TestFolder folder;
  const CPose3D vehicle(10, 20, 1, 0.5, 0.1, -0.2);
  const CPose3D sensor(1, 0, 0.5, 0.3, 0, 0);
  const auto pose = observation<mrpt::obs::CObservationRobotPose>("OXTS", 0);
  pose->sensorPose = sensor;
  pose->pose.mean = vehicle + sensor;
  const LogIndex index = index_of({pose}, folder);
  ASSERT_EQ(index.poses.size(), 1U);
  EXPECT_EQ(index.poses[0].stamp, at(0));
  EXPECT_TRUE(index.poses[0].T_world_vehicle.isApprox(from_mrpt(vehicle), 1e-9));
}

TEST(LogIndex, of_the_streams_alone_holds_no_motion) {
  const TestFolder folder;
  const LogIndex whole =
      index_of({observation<mrpt::obs::CObservationRobotPose>("POSE", 0), fix(0, 4)}, folder);
  const LogIndex streams = index_streams(folder / "log.rawlog");
  EXPECT_EQ(whole.poses.size() + whole.gnss.size(), 2U);
  EXPECT_EQ(streams.poses.size() + streams.gnss.size(), 0U);
  EXPECT_EQ(labels_of(streams), labels_of(whole));
}

TEST(LogIndex, of_others_than_scans_and_images_keeps_the_stamps_that_tell_the_rate) {
  const TestFolder folder;
  constexpr std::size_t kPoses = 10010;
  Objects objects;
  for (std::size_t i = 0; i < kPoses; ++i)
    objects.push_back(observation<mrpt::obs::CObservationRobotPose>("POSE", 0.01 * i));
  const LogIndex index = index_of(objects, folder);
  ASSERT_EQ(index.streams.size(), 1U);
  EXPECT_EQ(index.streams[0].count, kPoses);
  EXPECT_LT(index.streams[0].stamps.size(), kPoses);
  EXPECT_NEAR(index.streams[0].median_period_s, 0.01, 1e-6);
  EXPECT_EQ(index.poses.size(), kPoses);
}

TEST(LogIndex, of_two_pose_streams_the_longer_one_counts) {
  const TestFolder folder;
  Objects objects;
  for (int i = 0; i < 6; ++i) {
    const auto pose =
        observation<mrpt::obs::CObservationRobotPose>(i % 3 == 0 ? "A" : "B", 0.1 * i);
    pose->pose.mean = CPose3D(i % 3 == 0 ? 100 : 1, 0, 0, 0, 0, 0);
    objects.push_back(pose);
  }
  const LogIndex index = index_of(objects, folder);
  ASSERT_EQ(index.poses.size(), 4U);
  for (const PoseSample& sample : index.poses) {
    EXPECT_EQ(sample.T_world_vehicle.translation().x(), 1);
  }
}

TEST(LogIndex, wheel_odometry_is_read) {
  const TestFolder folder;
  const auto wheels = observation<mrpt::obs::CObservationOdometry>("ODO", 0.2);
  wheels->odometry = mrpt::poses::CPose2D(1, 2, 0.3);
  const LogIndex index = index_of({wheels}, folder);
  ASSERT_EQ(index.odometry.size(), 1U);
  EXPECT_TRUE(
      index.odometry[0].T_world_vehicle.isApprox(from_mrpt(CPose3D(1, 2, 0, 0.3, 0, 0)), 1e-12));
}

TEST(LogIndex, increments_of_actions_are_summed_up) {
  const TestFolder folder;
  Objects objects;
  for (int i = 0; i < 3; ++i) {
    mrpt::obs::CActionRobotMovement2D movement;
    movement.computeFromOdometry(mrpt::poses::CPose2D(1, 0, M_PI / 2), {});
    const auto actions = mrpt::obs::CActionCollection::Create();
    actions->insert(movement);
    const auto frame = mrpt::obs::CSensoryFrame::Create();
    frame->insert(scan(0.1 * i));
    objects.push_back(actions);
    objects.push_back(frame);
  }
  const LogIndex index = index_of(objects, folder);
  EXPECT_TRUE(index.has_frames);
  EXPECT_EQ(index.find("LIDAR", StreamKind::lidar)->count, 3U);
  ASSERT_EQ(index.odometry.size(), 3U);
  EXPECT_EQ(index.odometry[1].stamp, at(0.1));
  // One metre ahead, a quarter turn left, three times.
  EXPECT_TRUE(index.odometry[2].T_world_vehicle.isApprox(
      from_mrpt(CPose3D(0, 1, 0, 3 * M_PI / 2, 0, 0)), 1e-9));
}

TEST(LogIndex, gnss_needs_a_fix_and_gives_the_ellipsoidal_height) {
  const TestFolder folder;
  const LogIndex index = index_of({fix(0, 0), fix(1, 4)}, folder);
  ASSERT_EQ(index.gnss.size(), 1U);
  EXPECT_EQ(index.gnss[0].stamp, at(1));
  EXPECT_EQ(index.gnss[0].latitude_deg, 49);
  EXPECT_EQ(index.gnss[0].longitude_deg, 8);
  EXPECT_EQ(index.gnss[0].height_m, 157.5);
  EXPECT_EQ(index.gnss[0].antenna_in_vehicle, Eigen::Vector3d(0.5, 0, 2));
}

TEST(LogIndex, gnss_is_put_on_the_computers_clock_where_the_two_disagree) {
  const TestFolder folder;
  const LogIndex index = index_of({fix(1, 4, 3600)}, folder);
  ASSERT_EQ(index.gnss.size(), 1U);
  EXPECT_EQ(index.gnss[0].stamp, at(1.05));
}

TEST(LogIndex, a_cut_log_is_indexed_as_far_as_it_is_good_if_that_is_accepted) {
  const TestFolder folder;
  Objects objects;
  for (int i = 0; i < 50; ++i) objects.push_back(scan(0.1 * i));
  static_cast<void>(index_of(objects, folder));
  fs::resize_file(folder / "log.rawlog", fs::file_size(folder / "log.rawlog") - 12);
  EXPECT_THROW(static_cast<void>(index_log(folder / "log.rawlog")), CorruptRawlog);
  const LogIndex index = index_log({folder / "log.rawlog", true});
  ASSERT_TRUE(index.corruption);
  EXPECT_NE(index.corruption->find("cut off"), std::string::npos) << *index.corruption;
  EXPECT_GT(index.num_objects, 20U);
  fs::resize_file(folder / "log.rawlog", 5);
  EXPECT_THROW(static_cast<void>(index_log({folder / "log.rawlog", true})), CorruptRawlog);
}

TEST(LogIndex, progress_reaches_the_end) {
  const TestFolder folder;
  static_cast<void>(index_of({scan(0), scan(1)}, folder));
  double last = -1;
  static_cast<void>(index_log(folder / "log.rawlog", [&](double share) {
    EXPECT_GE(share, last);
    last = share;
  }));
  EXPECT_EQ(last, 1);
}

}  // namespace
}  // namespace lidar_upsampling
