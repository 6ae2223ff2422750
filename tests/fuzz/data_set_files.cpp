// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "fuzz/data_set_files.h"

#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "fuzz/fuzz_folder.h"
#include "fuzz/yard.h"
#include "importers/npz_layout.h"

namespace lidar_upsampling::fuzz {
namespace {

constexpr int kFrames = 2;

std::string picture_bytes(int frame, const char* extension) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(extension, picture_at(3 * frame).bgr, bytes);
  return {bytes.begin(), bytes.end()};
}

template <typename Number>
void append(std::string& bytes, Number value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string velodyne_bytes(int frame) {
  const LidarScan scan = scan_at(3 * frame);
  std::string bytes;
  for (std::size_t i = 0; i < scan.size(); i += 7) {
    for (int k = 0; k < 3; ++k) append(bytes, scan.points[i][k]);
    append(bytes, scan.intensity[i]);
  }
  return bytes;
}

std::string ply_bytes(int frame, bool binary) {
  const LidarScan scan = scan_at(3 * frame);
  std::string text = std::string("ply\nformat ") + (binary ? "binary_little_endian" : "ascii") +
                     " 1.0\nelement vertex 40\nproperty float x\nproperty float y\n"
                     "property float z\nproperty uchar intensity\n"
                     "property ushort laser_number\nend_header\n";
  for (std::size_t i = 0; i < 40; ++i) {
    const Eigen::Vector3f& p = scan.points[i * 17];
    if (binary) {
      for (int k = 0; k < 3; ++k) append(text, p[k]);
      append(text, static_cast<std::uint8_t>(100));
      append(text, static_cast<std::uint16_t>(i % 32));
      continue;
    }
    for (int k = 0; k < 3; ++k) text += std::to_string(p[k]) + ' ';
    text += "100 " + std::to_string(i % 32) + '\n';
  }
  return text;
}

std::string npz_bytes(int frame, bool packed) {
  const std::string path = in_work_folder("sweep.npz");
  write_npz(path, scan_at(3 * frame), packed);
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string tracklet_pose(double x) {
  return "<item><tx>" + std::to_string(x) +
         "</tx><ty>2</ty><tz>-1.6</tz><rx>0</rx><ry>0</ry><rz>0.1</rz><state>2</state>"
         "<occlusion>0</occlusion></item>\n";
}

std::string tracklets() {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\" standalone=\"yes\" ?>\n"
         "<boost_serialization>\n<tracklets>\n<count>1</count>\n<item>\n<objectType>Car"
         "</objectType><h>1.5</h><w>1.8</w><l>4</l>\n<first_frame>0</first_frame>\n<poses><count>2"
         "</count>\n" +
         tracklet_pose(9) + tracklet_pose(10) +
         "</poses></item>\n</tracklets>\n</boost_serialization>\n";
}

std::string day_stamps() {
  return "2026-01-01 00:00:00.500000000\n2026-01-01 00:00:00.600000000\n";
}

}  // namespace

Files drive_files() {
  Files files{{"calib_imu_to_velo.txt",
               "calib_time: 01-Jan-2026 00:00:00\nR: 1 0 0 0 1 0 0 0 1\n"
               "T: -0.8 0.3 -0.8\n"},
              {"calib_velo_to_cam.txt", "R: 0 -1 0 0 0 -1 1 0 0\nT: 0.01 -0.07 -0.27\n"},
              {"calib_cam_to_cam.txt",
               "R_rect_00: 1 0 0 0 1 0 0 0 1\nS_rect_02: 96 48\n"
               "P_rect_02: 60 0 48 3.6 0 60 24 0 0 0 1 0\n"},
              {"drive/tracklet_labels.xml", tracklets()},
              {"label_02.txt",
               "0 7 Car 0 0 -1.5 1 2 3 4 1.5 1.8 4 1 1.6 9 0.1\n"
               "1 7 Car 0 0 -1.5 1 2 3 4 1.5 1.8 4 1.2 1.6 9.5 0.1\n"
               "0 -1 DontCare -1 -1 -10 10.5 20 30 40.25 -1000 -1000 -1000 -10 -1 -1 -1\n"}};
  for (const char* const sensor : {"velodyne_points", "image_02", "oxts"})
    files[std::string("drive/") + sensor + "/timestamps.txt"] = day_stamps();
  for (int i = 0; i < kFrames; ++i) {
    const std::string number = "000000000" + std::to_string(i);
    files["drive/velodyne_points/data/" + number + ".bin"] = velodyne_bytes(i);
    files["drive/image_02/data/" + number + ".png"] = picture_bytes(i, ".png");
    files["drive/oxts/data/" + number + ".txt"] = "49.01 8.43 116 0.01 0.02 0.3 0 0 0\n";
  }
  return files;
}

Files sequence_files() {
  Files files{{"sequences/04/times.txt", "0.000000e+00\n1.000000e-01\n"},
              {"poses/04.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0.1 0 1 0 0 0 0 1 0.9\n"}};
  std::string& calibration = files["sequences/04/calib.txt"];
  for (int i = 0; i < 4; ++i)
    calibration += "P" + std::to_string(i) + ": 60 0 48 3.6 0 60 24 0 0 0 1 0\n";
  calibration += "Tr: 0 -1 0 0.01 0 0 -1 -0.07 1 0 0 -0.27\n";
  for (int i = 0; i < kFrames; ++i) {
    const std::string number = "00000" + std::to_string(i);
    files["sequences/04/velodyne/" + number + ".bin"] = velodyne_bytes(i);
    files["sequences/04/image_2/" + number + ".png"] = picture_bytes(i, ".png");
  }
  return files;
}

Files argoverse_files() {
  const std::string pose = R"({"rotation":[1,0,0,0],"translation":[10,20,0.5]})";
  const std::string sensor = R"({"rotation":{"coefficients":[1,0,0,0]},"translation":[1.3,0,1.6]})";
  Files files{{"vehicle_calibration_info.json",
               R"({"camera_data_":[{"key":"image_raw_ring_front_center","value":{)"
               R"("focal_length_x_px_":60,"focal_length_y_px_":60,"focal_center_x_px_":48,)"
               R"("focal_center_y_px_":24,"skew_":0,"distortion_coefficients_":[-0.1,0.1,0],)"
               R"("vehicle_SE3_camera_":)" +
                   sensor + R"(}}],"vehicle_SE3_up_lidar_":)" + sensor +
                   R"(,"vehicle_SE3_down_lidar_":)" + sensor + "}"}};
  for (int i = 0; i < kFrames; ++i) {
    const std::string stamp = "15720000" + std::to_string(i) + "0000000000";
    const std::string label =
        R"([{"center":{"x":9,"y":2,"z":0.8},"rotation":{"x":0,"y":0,"z":0,"w":1},"length":4,)"
        R"("width":1.8,"height":1.5,"track_label_uuid":"0000-1","label_class":"VEHICLE",)"
        R"("timestamp":)" +
        stamp + "}]";
    files["lidar/PC_" + stamp + ".ply"] = ply_bytes(i, i == 0);
    files["poses/city_SE3_egovehicle_" + stamp + ".json"] = pose;
    files["per_sweep_annotations_amodal/tracked_object_labels_" + stamp + ".json"] = label;
    files["ring_front_center/ring_front_center_" + stamp + ".jpg"] = picture_bytes(i, ".jpg");
  }
  return files;
}

Files dgp_files() {
  const std::string pose =
      R"({"rotation":{"qw":1,"qx":0,"qy":0,"qz":0},"translation":{"x":0.3,"y":0,"z":1.6}})";
  const std::string none = R"({"fx":0,"fy":0,"cx":0,"cy":0,"skew":0})";
  Files files{{"calibration/c0.json", R"({"names":["LIDAR","CAMERA_01"],"extrinsics":[)" + pose +
                                          "," + pose + R"(],"intrinsics":[)" + none +
                                          R"(,{"fx":60,"fy":60,"cx":48,"cy":24,"skew":0}]})"},
              {"ontology/o1.json", R"({"items":[{"id":2,"name":"Car"}]})"}};
  std::string data, samples;
  for (int i = 0; i < kFrames; ++i) {
    const std::string n = std::to_string(i), stamp = "157200000" + n + "000000";
    const auto datum = [&](const std::string& key, const std::string& name,
                           const std::string& rest) {
      return R"({"key":")" + key + n + R"(","id":{"name":")" + name +
             R"(","timestamp":"2019-05-03T21:39:53.820375Z"},"datum":{)" + rest + R"(,"pose":)" +
             pose + "}}}";
    };
    const std::string cloud = "point_cloud/LIDAR/" + stamp + ".npz";
    const std::string picture = "rgb/CAMERA_01/" + stamp + ".png";
    const std::string boxes = "bounding_box_3d/LIDAR/" + stamp + ".json";
    files[cloud] = npz_bytes(i, i == 0);
    files[picture] = picture_bytes(i, ".png");
    files[boxes] = R"({"annotations":[{"class_id":2,"instance_id":3000000001,"box":{"length":4,)"
                   R"("width":1.8,"height":1.5,"pose":)" +
                   pose + "}}]}";
    data += (i > 0 ? "," : "") +
            datum("l", "LIDAR",
                  R"("point_cloud":{"filename":")" + cloud + R"(","annotations":{"1":")" + boxes +
                      R"("})") +
            "," + datum("c", "CAMERA_01", R"("image":{"filename":")" + picture + '"');
    samples += (i > 0 ? "," : "") +
               (R"({"calibration_key":"c0","datum_keys":["l)" + n + R"(","c)") + n + R"("]})";
  }
  files["scene_0a.json"] =
      R"({"data":[)" + data + R"(],"samples":[)" + samples + R"(],"ontologies":{"1":"o1"}})";
  return files;
}

}  // namespace lidar_upsampling::fuzz
