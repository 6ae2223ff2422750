// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// The bytes of a ROS 1 message or bag record: little-endian, strings and arrays with their length.
class RosBytes {
 public:
  template <typename Number>
  RosBytes& add(Number value) {
    const auto at = bytes_.size();
    bytes_.resize(at + sizeof value);
    std::memcpy(bytes_.data() + at, &value, sizeof value);
    return *this;
  }
  RosBytes& text(const std::string& value) {
    add(static_cast<std::uint32_t>(value.size()));
    bytes_ += value;
    return *this;
  }
  RosBytes& raw(const std::string& value) {
    bytes_ += value;
    return *this;
  }
  /// A ROS time: whole seconds of UNIX time, nanoseconds.
  RosBytes& time(Stamp stamp);
  /// std_msgs/Header.
  RosBytes& header(Stamp stamp, const std::string& frame_id);

  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

struct RosMessageType {
  std::string name, md5;
};

/// Types, and messages of them.
extern const RosMessageType kRosPointCloud2, kRosImage, kRosCameraInfo, kRosTf;

/// x, y, z and intensity (0 to 255, as Velodyne's driver has it), all FLOAT32.
[[nodiscard]] std::string ros_point_cloud(const LidarScan& scan, const std::string& frame_id);
/// mono8 or bgr8.
[[nodiscard]] std::string ros_image(const CameraImage& image, const std::string& frame_id);
/// 32FC1, metres along +Z; of a depth picture's points, whose rings and columns are its pixels.
[[nodiscard]] std::string ros_depth_image(const LidarScan& scan, int width, int height,
                                          const std::string& frame_id);
[[nodiscard]] std::string ros_camera_info(const CameraModel& model, Stamp stamp,
                                          const std::string& frame_id);
[[nodiscard]] std::string ros_tf(const Pose& T_parent_child, Stamp stamp, const std::string& parent,
                                 const std::string& child);

/// A bag, format 2.0, with one chunk that is not compressed.
class RosBag {
 public:
  /// The message's receive time is its stamp.
  void add(const std::string& topic, const RosMessageType& type, Stamp stamp,
           const std::string& message);
  void write(const std::string& path) const;

 private:
  struct Connection {
    std::string topic;
    std::string record;
    std::string index;  // time and place in the chunk of each message
    std::uint32_t num_messages = 0;
  };
  std::uint32_t connection(const std::string& topic, const RosMessageType& type);
  [[nodiscard]] std::string index_records() const;
  [[nodiscard]] std::string chunk_info(std::uint64_t chunk_at) const;

  std::vector<Connection> connections_;
  std::string chunk_;
  Stamp first_, last_;
};

}  // namespace lidar_upsampling
