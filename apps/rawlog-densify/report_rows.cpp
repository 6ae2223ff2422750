// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "report_rows.h"

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <type_traits>

namespace lidar_upsampling {
namespace {

using Length = std::uint32_t;
constexpr std::size_t kBlock = 1U << 18U;

/// Appends values as memory has them: the process that writes them reads them.
class Writing {
 public:
  explicit Writing(std::string& bytes) : bytes_(bytes) {}

  template <typename Value>
  void operator()(const Value& value) {
    static_assert(std::is_trivially_copyable_v<Value>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  template <int kRows, int kColumns>
  void operator()(const Eigen::Matrix<double, kRows, kColumns>& matrix) {
    bytes_.append(reinterpret_cast<const char*>(matrix.data()), sizeof(double) * kRows * kColumns);
  }
  void operator()(const Pose& pose) { (*this)(pose.matrix()); }
  void operator()(const std::string& text) {
    (*this)(text.size());
    bytes_ += text;
  }

 private:
  std::string& bytes_;
};

/// The way back.
class Reading {
 public:
  explicit Reading(const char* at) : at_(at) {}

  template <typename Value>
  void operator()(Value& value) {
    static_assert(std::is_trivially_copyable_v<Value>);
    take(&value, sizeof value);
  }
  template <int kRows, int kColumns>
  void operator()(Eigen::Matrix<double, kRows, kColumns>& matrix) {
    take(matrix.data(), sizeof(double) * kRows * kColumns);
  }
  void operator()(Pose& pose) { (*this)(pose.matrix()); }
  void operator()(std::string& text) {
    std::size_t size = 0;
    (*this)(size);
    text.assign(at_, size);
    at_ += size;
  }

 private:
  void take(void* to, std::size_t size) {
    std::memcpy(to, at_, size);
    at_ += size;
  }

  const char* at_;
};

template <typename Transfer, typename Motion>
void transfer_object(Transfer& transfer, Motion& object) {
  transfer(object.track_id);
  transfer(object.class_name);
  transfer(object.camera_label);
  transfer(object.status);
  transfer(object.T_lidar_t_lidar_k);
  transfer(object.T_mov);
  transfer(object.centroid_lidar_k);
  transfer(object.velocity_lidar_k);
  transfer(object.yaw_rate);
  transfer(object.box);
  transfer(object.num_tracked);
  transfer(object.num_inliers);
  transfer(object.rmse_px);
  transfer(object.position_covariance);
  transfer(object.unproven_step);
}

template <typename Transfer, typename Box>
void transfer_box(Transfer& transfer, Box& box) {
  transfer(box.track_id);
  transfer(box.class_name);
  transfer(box.moving);
  transfer(box.T_lidar_box);
  transfer(box.size);
  transfer(box.velocity);
}

ReportRow row_in(Reading& reading) {
  ReportRow row;
  reading(row.stamp);
  reading(row.num_points);
  transfer_object(reading, row.object);
  reading(row.T_rest_lidar);
  bool has_box = false;
  reading(has_box);
  if (has_box) transfer_box(reading, row.box.emplace());
  return row;
}

OtherCluster cluster_in(Reading& reading) {
  OtherCluster cluster;
  reading(cluster.centroid_lidar_k);
  reading(cluster.size);
  reading(cluster.num_points);
  reading(cluster.why);
  return cluster;
}

}  // namespace

ReportRows::ReportRows(const std::string& beside) : file_(OutputFile::scratch(beside)) {}

void ReportRows::begin(Kind kind) {
  begin_ = waiting_.size();
  Writing writing(waiting_);
  writing(Length(0));
  writing(kind);
}

void ReportRows::end() {
  const auto length = static_cast<Length>(waiting_.size() - begin_ - sizeof(Length));
  std::memcpy(waiting_.data() + begin_, &length, sizeof length);
  if (waiting_.size() >= kBlock) write_out();
}

void ReportRows::write_out() {
  file_.write(waiting_);
  waiting_.clear();
}

void ReportRows::add(const ReportRow& row) {
  begin(Kind::row);
  Writing writing(waiting_);
  writing(row.stamp);
  writing(row.num_points);
  transfer_object(writing, row.object);
  writing(row.T_rest_lidar);
  writing(row.box.has_value());
  if (row.box) transfer_box(writing, *row.box);
  end();
}

void ReportRows::add(Stamp key_stamp, const OtherCluster& cluster) {
  begin(Kind::cluster);
  Writing writing(waiting_);
  writing(key_stamp);
  writing(cluster.centroid_lidar_k);
  writing(cluster.size);
  writing(cluster.num_points);
  writing(cluster.why);  // a literal of this process
  end();
}

void ReportRows::for_each(const UseRow& use_row, const UseCluster& use_cluster) {
  write_out();
  std::string block;
  std::size_t room = kBlock;
  for (std::uint64_t at = 0; at < file_.size();) {
    block.resize(room);
    block.resize(file_.read(at, block.data(), block.size()));
    const std::size_t used = use_records(block, use_row, use_cluster);
    if (used == 0 && block.size() < room)
      throw std::runtime_error(file_.path() + ": the report's rows are lost");
    if (used == 0) room *= 2;  // a record longer than that
    at += used;
  }
}

// Of the block, as far as records are whole. @return how many bytes these are.
std::size_t ReportRows::use_records(const std::string& block, const UseRow& use_row,
                                    const UseCluster& use_cluster) {
  std::size_t used = 0;
  while (block.size() - used >= sizeof(Length)) {
    Length length = 0;
    std::memcpy(&length, block.data() + used, sizeof length);
    if (block.size() - used - sizeof length < length) break;
    Reading reading(block.data() + used + sizeof length);
    used += sizeof length + length;
    Kind kind{};
    reading(kind);
    if (kind == Kind::row && use_row) {
      ReportRow row = row_in(reading);
      use_row(row);
    } else if (kind == Kind::cluster && use_cluster) {
      Stamp key_stamp;
      reading(key_stamp);
      use_cluster(key_stamp, cluster_in(reading));
    }
  }
  return used;
}

}  // namespace lidar_upsampling
