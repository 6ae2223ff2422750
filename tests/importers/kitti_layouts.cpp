// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "kitti_layouts.h"

#include <mrpt/poses/CPose3D.h>

#include <GeographicLib/LocalCartesian.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "lidar_upsampling/io/images.h"

namespace fs = std::filesystem;

namespace lidar_upsampling {
namespace {

// The camera written about is number 2, 6 cm to the left of number 0.
constexpr double kOffsetOfCamera2 = 0.06;

std::string text_of(const Eigen::MatrixXd& values) {
  std::string text;
  for (Eigen::Index row = 0; row < values.rows(); ++row) {
    for (Eigen::Index column = 0; column < values.cols(); ++column) {
      char number[32];
      std::snprintf(number, sizeof number, " %.12e", values(row, column));
      text += number;
    }
  }
  return text.substr(1);
}

Pose T_camera_0_camera_2() { return Pose(Eigen::Translation3d(-kOffsetOfCamera2, 0, 0)); }

// What the day's calibration says of it: the pictures are turned a little by rectification.
Pose T_rectification() {
  return Pose(Eigen::AngleAxisd(0.02, Eigen::Vector3d(0.3, 0.8, -0.5).normalized()));
}

Eigen::Matrix<double, 3, 4> projection_of(const CameraModel& model, double offset) {
  Eigen::Matrix<double, 3, 4> P;
  P << model.fx, 0, model.cx, model.fx * offset, 0, model.fy, model.cy, 0, 0, 0, 1, 0;
  return P;
}

void write_points(const fs::path& file, const KittiPoints& points) {
  std::vector<float> values;
  for (std::size_t i = 0; i < points.points.size(); ++i) {
    values.insert(values.end(), points.points[i].data(), points.points[i].data() + 3);
    values.push_back(points.intensity[i]);
  }
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(values.data()),
             static_cast<std::streamsize>(values.size() * sizeof(float)));
}

void write_rigid_motion(const fs::path& file, const Pose& T) {
  std::ofstream(file) << "calib_time: 01-Jan-2026 00:00:00\nR: " << text_of(T.linear())
                      << "\nT: " << text_of(T.translation().transpose()) << "\n";
}

void write_day_calibration(const fs::path& day, const SmallStreet& street) {
  write_rigid_motion(day / "calib_imu_to_velo.txt", street.lidar.T_vehicle_lidar.inverse());
  write_rigid_motion(day / "calib_velo_to_cam.txt",
                     T_rectification().inverse() * T_camera_0_lidar(street));
  const CameraModel& model = street.camera.camera.model;
  std::ofstream(day / "calib_cam_to_cam.txt")
      << "R_rect_00: " << text_of(T_rectification().linear()) << "\nS_rect_02: " << model.width
      << " " << model.height << "\nP_rect_02: " << text_of(projection_of(model, kOffsetOfCamera2))
      << "\n";
}

void write_stamps(const fs::path& folder, Stamp (*stamp_of)(int)) {
  fs::create_directories(folder / "data");
  std::ofstream out(folder / "timestamps.txt");
  for (int i = 0; i < kNumFrames; ++i) {
    out << "2026-01-01 00:00:" << seconds_text(stamp_of(i), sim::start_stamp()) << "\n";
  }
}

// The world's origin goes to where the first record is taken, as the reader puts it there.
std::string oxts_record(const SmallStreet& street, Stamp stamp) {
  const Pose T = street.T_world_vehicle(stamp);
  const Eigen::Vector3d p =
      T.translation() - street.T_world_vehicle(drive_oxts_stamp(0)).translation();
  double latitude = 0, longitude = 0, height = 0;
  GeographicLib::LocalCartesian(49.01, 8.43, 116)
      .Reverse(p.x(), p.y(), p.z(), latitude, longitude, height);
  const mrpt::poses::CPose3D pose = to_mrpt(T);
  char record[256];
  std::snprintf(record, sizeof record, "%.13f %.13f %.9f %.9f %.9f %.9f 0 0 0\n", latitude,
                longitude, height, pose.roll(), pose.pitch(), pose.yaw());
  return record;
}

std::string tracklet_pose(const SmallStreet& street, int id, int frame, bool occluded) {
  const Stamp stamp = frame_stamp(frame);
  const Pose T_world_lidar = street.T_world_vehicle(stamp) * street.lidar.T_vehicle_lidar;
  const Pose bottom = T_world_lidar.inverse() * street.T_world_object(id, stamp) *
                      Eigen::Translation3d(0, 0, -0.5 * street.size_of(id).z());
  const mrpt::poses::CPose3D pose = to_mrpt(bottom);
  char item[640];
  std::snprintf(item, sizeof item,
                "<item><tx>%.9f</tx><ty>%.9f</ty><tz>%.9f</tz><rx>%.9f</rx><ry>%.9f</ry>"
                "<rz>%.9f</rz><state>2</state><occlusion>%d</occlusion>"
                "<occlusion_kf>0</occlusion_kf><truncation>0</truncation></item>\n",
                pose.x(), pose.y(), pose.z(), pose.roll(), pose.pitch(), pose.yaw(),
                occluded ? 2 : 0);
  return item;
}

void write_tracklets(const fs::path& file, const SmallStreet& street) {
  const std::vector<int> ids = street.ids();
  std::ofstream out(file);
  out << "<?xml version=\"1.0\" encoding=\"UTF-8\" standalone=\"yes\" ?>\n"
      << "<!DOCTYPE boost_serialization>\n"
      << "<boost_serialization signature=\"serialization::archive\" version=\"9\">\n"
      << "<tracklets class_id=\"0\" tracking_level=\"0\" version=\"0\">\n"
      << "<count>" << ids.size() << "</count><item_version>1</item_version>\n";
  for (std::size_t n = 0; n < ids.size(); ++n) {
    const int first = first_labelled_frame(static_cast<int>(n));
    std::string type = street.world.objects[static_cast<std::size_t>(ids[n])].class_name;
    type[0] = static_cast<char>(std::toupper(type[0]));
    const Eigen::Vector3d size = street.size_of(ids[n]);
    out << "<item class_id=\"1\" tracking_level=\"0\" version=\"1\">\n<objectType>" << type
        << "</objectType><h>" << size.z() << "</h><w>" << size.y() << "</w><l>" << size.x()
        << "</l>\n<first_frame>" << first << "</first_frame>\n<poses class_id=\"2\"><count>"
        << kNumFrames - first << "</count><item_version>2</item_version>\n";
    for (int i = first; i < kNumFrames; ++i) {
      out << tracklet_pose(street, ids[n], i, n == 0 && i == kOccludedFrame);
    }
    out << "</poses><finished>1</finished></item>\n";
  }
  out << "</tracklets>\n</boost_serialization>\n";
}

}  // namespace

Pose T_camera_0_lidar(const SmallStreet& street) {
  return T_camera_0_camera_2() * street.camera.camera.T_vehicle_camera.inverse() *
         street.lidar.T_vehicle_lidar;
}

KittiPoints kitti_points(const SmallStreet& street, Stamp stamp) {
  const LidarScan scan = street.scan(stamp);
  const auto azimuth = [&](std::size_t i) {
    const double angle = std::atan2(static_cast<double>(scan.points[i].y()),
                                    static_cast<double>(scan.points[i].x()));
    return angle < 0 ? angle + 2 * M_PI : angle;
  };
  std::vector<std::size_t> order(scan.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    if (scan.ring[a] != scan.ring[b]) return scan.ring[a] > scan.ring[b];
    return azimuth(a) < azimuth(b);
  });
  KittiPoints points;
  for (const std::size_t i : order) {
    points.points.push_back(scan.points[i]);
    points.intensity.push_back(scan.intensity[i]);
  }
  return points;
}

Stamp drive_picture_stamp(int frame) { return shifted(frame_stamp(frame), 0.01); }
// A packet's stamp tells when it arrived; here it does so at once.
Stamp drive_oxts_stamp(int frame) { return frame_stamp(frame); }

Pose T_drive_world(const SmallStreet& street) {
  return Pose(Eigen::Translation3d(-street.T_world_vehicle(drive_oxts_stamp(0)).translation()));
}

fs::path write_drive(const fs::path& day, const SmallStreet& street) {
  fs::path drive = day / "drive";
  write_stamps(drive / "velodyne_points", frame_stamp);
  write_stamps(drive / "image_02", drive_picture_stamp);
  write_stamps(drive / "oxts", drive_oxts_stamp);
  write_day_calibration(day, street);
  write_tracklets(drive / "tracklet_labels.xml", street);
  for (int i = 0; i < kNumFrames; ++i) {
    const std::string name = padded(i, 10);
    write_points(drive / "velodyne_points/data" / (name + ".bin"),
                 kitti_points(street, frame_stamp(i)));
    cv::imwrite((drive / "image_02/data" / (name + ".png")).string(),
                street.picture(drive_picture_stamp(i)).image.bgr);
    std::ofstream(drive / "oxts/data" / (name + ".txt"))
        << oxts_record(street, drive_oxts_stamp(i));
  }
  return drive;
}

fs::path write_sequence(const fs::path& root, const SmallStreet& street) {
  fs::path sequence = root / "sequences/04";
  for (const char* const name : {"velodyne", "image_2"}) fs::create_directories(sequence / name);
  fs::create_directories(root / "poses");
  const CameraModel& model = street.camera.camera.model;
  std::ofstream calibration(sequence / "calib.txt");
  for (int i = 0; i < 4; ++i) {
    calibration << "P" << i << ": "
                << text_of(projection_of(model, i == 2 ? kOffsetOfCamera2 : -0.5 * i)) << "\n";
  }
  const Pose Tr = T_camera_0_lidar(street);
  calibration << "Tr: " << text_of(Tr.matrix().topRows<3>()) << "\n";
  std::ofstream times(sequence / "times.txt"), poses(root / "poses/04.txt");
  const Pose T_vehicle_camera_0 = street.lidar.T_vehicle_lidar * Tr.inverse();
  for (int i = 0; i < kNumFrames; ++i) {
    const Stamp stamp = frame_stamp(i);
    char time[32];
    std::snprintf(time, sizeof time, "%e\n", seconds_between(frame_stamp(0), stamp));
    times << time;
    const Pose T_first_camera =
        (street.T_world_vehicle(frame_stamp(0)) * T_vehicle_camera_0).inverse() *
        street.T_world_vehicle(stamp) * T_vehicle_camera_0;
    poses << text_of(T_first_camera.matrix().topRows<3>()) << "\n";
    write_points(sequence / "velodyne" / (padded(i, 6) + ".bin"), kitti_points(street, stamp));
    cv::imwrite((sequence / "image_2" / (padded(i, 6) + ".png")).string(),
                street.picture(stamp).image.bgr);
  }
  return sequence;
}

}  // namespace lidar_upsampling
