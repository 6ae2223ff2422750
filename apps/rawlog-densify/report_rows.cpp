// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "report_rows.h"

namespace lidar_upsampling {
namespace {

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

ReportRow row_in(RecordReader& reading) {
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

OtherCluster cluster_in(RecordReader& reading) {
  OtherCluster cluster;
  reading(cluster.centroid_lidar_k);
  reading(cluster.size);
  reading(cluster.num_points);
  reading(cluster.why);
  return cluster;
}

}  // namespace

void ReportRows::add(const ReportRow& row) {
  file_.add([&](RecordWriter& writing) {
    writing(Kind::row);
    writing(row.stamp);
    writing(row.num_points);
    transfer_object(writing, row.object);
    writing(row.T_rest_lidar);
    writing(row.box.has_value());
    if (row.box) transfer_box(writing, *row.box);
  });
}

void ReportRows::add(Stamp key_stamp, const OtherCluster& cluster) {
  file_.add([&](RecordWriter& writing) {
    writing(Kind::cluster);
    writing(key_stamp);
    writing(cluster.centroid_lidar_k);
    writing(cluster.size);
    writing(cluster.num_points);
    writing(cluster.why);  // a literal of this process
  });
}

void ReportRows::for_each(const UseRow& use_row, const UseCluster& use_cluster) const {
  file_.for_each([&](RecordReader& reading) {
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
  });
}

}  // namespace lidar_upsampling
