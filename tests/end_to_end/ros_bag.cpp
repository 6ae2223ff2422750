// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "ros_bag.h"

#include <algorithm>
#include <fstream>
#include <utility>

namespace lidar_upsampling {
namespace {

// Of MRPT's ticks: from 1601 to 1970.
constexpr std::int64_t kUnixEpoch = 116444736000000000, kTicksPerSecond = 10000000;

enum Op : std::uint8_t {
  message_data = 0x02,
  bag_header = 0x03,
  index_data = 0x04,
  chunk = 0x05,
  chunk_info_op = 0x06,
  connection_op = 0x07
};

std::string as_bytes(std::uint32_t value) { return RosBytes().add(value).bytes(); }
std::string as_bytes(std::uint64_t value) { return RosBytes().add(value).bytes(); }
std::string as_bytes(Stamp stamp) { return RosBytes().time(stamp).bytes(); }

using Fields = std::vector<std::pair<std::string, std::string>>;

std::string joined(const Fields& fields) {
  RosBytes text;
  for (const auto& [name, value] : fields) {
    std::string field = name;
    field += '=';
    text.text(field += value);
  }
  return text.bytes();
}

std::string record(Op op, Fields fields, const std::string& data) {
  fields.emplace_back("op", std::string(1, static_cast<char>(op)));
  return RosBytes().text(joined(fields)).text(data).bytes();
}

// Takes 4096 bytes whatever it says, so that it can be put in place last.
std::string bag_header_record(std::uint64_t index_at, std::uint32_t num_connections) {
  const Fields fields{{"index_pos", as_bytes(index_at)},
                      {"conn_count", as_bytes(num_connections)},
                      {"chunk_count", as_bytes(std::uint32_t{1})}};
  const std::size_t bare = record(bag_header, fields, "").size();
  return record(bag_header, fields, std::string(4096 - bare, ' '));
}

void add_field(RosBytes& message, const std::string& name, std::uint32_t offset) {
  constexpr std::uint8_t kFloat32 = 7;
  message.text(name).add(offset).add(kFloat32).add(std::uint32_t{1});
}

std::string image_message(Stamp stamp, const std::string& frame_id, const std::string& encoding,
                          const cv::Mat& picture) {
  const auto step = static_cast<std::uint32_t>(picture.cols * picture.elemSize());
  std::string pixels;
  for (int row = 0; row < picture.rows; ++row)
    pixels.append(reinterpret_cast<const char*>(picture.ptr(row)), step);
  return RosBytes()
      .header(stamp, frame_id)
      .add(static_cast<std::uint32_t>(picture.rows))
      .add(static_cast<std::uint32_t>(picture.cols))
      .text(encoding)
      .add(std::uint8_t{0})
      .add(step)
      .text(pixels)
      .bytes();
}

}  // namespace

const RosMessageType kRosPointCloud2{"sensor_msgs/PointCloud2", "1158d486dd51d683ce2f1be655c3c181"};
const RosMessageType kRosImage{"sensor_msgs/Image", "060021388200f6f0f447d0fcd9c64743"};
const RosMessageType kRosCameraInfo{"sensor_msgs/CameraInfo", "c9a58c1b0b154e0e6da7578cb991d214"};
const RosMessageType kRosTf{"tf2_msgs/TFMessage", "94810edda583a504dfda3829e70d7eec"};

RosBytes& RosBytes::time(Stamp stamp) {
  const std::int64_t ticks = stamp.time_since_epoch().count() - kUnixEpoch;
  return add(static_cast<std::uint32_t>(ticks / kTicksPerSecond))
      .add(static_cast<std::uint32_t>(ticks % kTicksPerSecond * 100));
}

RosBytes& RosBytes::header(Stamp stamp, const std::string& frame_id) {
  return add(std::uint32_t{0}).time(stamp).text(frame_id);
}

std::string ros_point_cloud(const LidarScan& scan, const std::string& frame_id) {
  constexpr std::uint32_t kStep = 16;
  const auto num_points = static_cast<std::uint32_t>(scan.size());
  RosBytes message, data;
  message.header(scan.stamp, frame_id).add(std::uint32_t{1}).add(num_points);
  message.add(std::uint32_t{4});
  add_field(message, "x", 0);
  add_field(message, "y", 4);
  add_field(message, "z", 8);
  add_field(message, "intensity", 12);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    for (int k = 0; k < 3; ++k) data.add(scan.points[i][k]);
    data.add(scan.intensity.empty() ? 0.F : 255.F * scan.intensity[i]);
  }
  return message.add(std::uint8_t{0})
      .add(kStep)
      .add(kStep * num_points)
      .text(data.bytes())
      .add(std::uint8_t{1})
      .bytes();
}

std::string ros_image(const CameraImage& image, const std::string& frame_id) {
  return image.bgr.empty() ? image_message(image.stamp, frame_id, "mono8", image.gray)
                           : image_message(image.stamp, frame_id, "bgr8", image.bgr);
}

std::string ros_depth_image(const LidarScan& scan, int width, int height,
                            const std::string& frame_id) {
  cv::Mat depth(height, width, CV_32FC1, cv::Scalar(0));
  for (std::size_t i = 0; i < scan.size(); ++i)
    depth.at<float>(height - 1 - scan.ring[i], scan.column[i]) = scan.points[i].x();
  return image_message(scan.stamp, frame_id, "32FC1", depth);
}

std::string ros_camera_info(const CameraModel& model, Stamp stamp, const std::string& frame_id) {
  RosBytes message;
  message.header(stamp, frame_id)
      .add(static_cast<std::uint32_t>(model.height))
      .add(static_cast<std::uint32_t>(model.width))
      .text("plumb_bob")
      .add(std::uint32_t{5});
  for (int i = 0; i < 5; ++i) message.add(model.distortion[i]);
  const std::vector<double> k{model.fx, 0, model.cx, 0, model.fy, model.cy, 0, 0, 1};
  const std::vector<double> r{1, 0, 0, 0, 1, 0, 0, 0, 1};
  const std::vector<double> p{model.fx, 0, model.cx, 0, 0, model.fy, model.cy, 0, 0, 0, 1, 0};
  for (const auto& matrix : {k, r, p})
    for (const double value : matrix) message.add(value);
  for (int i = 0; i < 6; ++i) message.add(std::uint32_t{0});  // binning and region of interest
  return message.add(std::uint8_t{0}).bytes();
}

std::string ros_tf(const Pose& T_parent_child, Stamp stamp, const std::string& parent,
                   const std::string& child) {
  const Eigen::Quaterniond q(T_parent_child.linear());
  RosBytes message;
  message.add(std::uint32_t{1}).header(stamp, parent).text(child);
  for (int i = 0; i < 3; ++i) message.add(T_parent_child.translation()[i]);
  return message.add(q.x()).add(q.y()).add(q.z()).add(q.w()).bytes();
}

std::uint32_t RosBag::connection(const std::string& topic, const RosMessageType& type) {
  const auto found = std::find_if(connections_.begin(), connections_.end(),
                                  [&](const Connection& known) { return known.topic == topic; });
  const auto number = static_cast<std::uint32_t>(found - connections_.begin());
  if (found != connections_.end()) return number;
  const Fields about{
      {"topic", topic}, {"type", type.name}, {"md5sum", type.md5}, {"message_definition", "-"}};
  const std::string made =
      record(connection_op, {{"conn", as_bytes(number)}, {"topic", topic}}, joined(about));
  connections_.push_back({topic, made, {}, 0});
  chunk_ += made;
  return number;
}

void RosBag::add(const std::string& topic, const RosMessageType& type, Stamp stamp,
                 const std::string& message) {
  const std::uint32_t number = connection(topic, type);
  if (connections_.size() == 1 && connections_[0].num_messages == 0) first_ = last_ = stamp;
  first_ = std::min(first_, stamp);
  last_ = std::max(last_, stamp);
  connections_[number].index +=
      as_bytes(stamp) + as_bytes(static_cast<std::uint32_t>(chunk_.size()));
  ++connections_[number].num_messages;
  chunk_ += record(message_data, {{"conn", as_bytes(number)}, {"time", as_bytes(stamp)}}, message);
}

std::string RosBag::index_records() const {
  std::string records;
  for (std::uint32_t i = 0; i < connections_.size(); ++i)
    records += record(index_data,
                      {{"ver", as_bytes(std::uint32_t{1})},
                       {"conn", as_bytes(i)},
                       {"count", as_bytes(connections_[i].num_messages)}},
                      connections_[i].index);
  return records;
}

std::string RosBag::chunk_info(std::uint64_t chunk_at) const {
  std::string counts;
  for (std::uint32_t i = 0; i < connections_.size(); ++i)
    counts += as_bytes(i) + as_bytes(connections_[i].num_messages);
  return record(chunk_info_op,
                {{"ver", as_bytes(std::uint32_t{1})},
                 {"chunk_pos", as_bytes(chunk_at)},
                 {"start_time", as_bytes(first_)},
                 {"end_time", as_bytes(last_)},
                 {"count", as_bytes(static_cast<std::uint32_t>(connections_.size()))}},
                counts);
}

void RosBag::write(const std::string& path) const {
  const std::string magic = "#ROSBAG V2.0\n";
  const auto num_connections = static_cast<std::uint32_t>(connections_.size());
  const std::uint64_t chunk_at = magic.size() + bag_header_record(0, 0).size();
  std::string body = record(
      chunk,
      {{"compression", "none"}, {"size", as_bytes(static_cast<std::uint32_t>(chunk_.size()))}},
      chunk_);
  body += index_records();
  const std::uint64_t index_at = chunk_at + body.size();
  for (const Connection& known : connections_) body += known.record;
  body += chunk_info(chunk_at);
  std::ofstream(path, std::ios::binary)
      << magic << bag_header_record(index_at, num_connections) << body;
}

}  // namespace lidar_upsampling
