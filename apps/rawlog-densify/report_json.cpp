// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <mrpt/core/Clock.h>
#include <stdlib.h>  // getloadavg is BSD's, not in <cstdlib>

#include <functional>
#include <nlohmann/json.hpp>
#include <ostream>
#include <thread>
#include <utility>

#include "common/indented_json.h"
#include "report.h"

namespace lidar_upsampling {
namespace {

// Programs that wanted a core, on average over the last minute; 0: not known.
double load_of_machine() {
  double load = 0;
  return getloadavg(&load, 1) == 1 ? load : 0;
}

nlohmann::json vector_json(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

nlohmann::json pose_json(const Pose& T) {
  const Eigen::Quaterniond q(T.linear());
  const Eigen::Vector3d& t = T.translation();
  return {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()};
}

nlohmann::json box_json(const ObjectBox& box) {
  return {{"pose", pose_json(box.T_lidar_box)},
          {"size_m", vector_json(box.size)},
          {"velocity_m_s", vector_json(box.velocity)}};
}

// xx xy xz yy yz zz.
nlohmann::json covariance_json(const Eigen::Matrix3d& c) {
  return {c(0, 0), c(0, 1), c(0, 2), c(1, 1), c(1, 2), c(2, 2)};
}

/// Of the middle of what is seen of it: of a car that turns, the points' centroid goes another way.
/// Over ground, lidar frame at the image.
Eigen::Vector3d velocity_of(const ReportRow& row) {
  if (row.box) return row.box->velocity;
  const ObjectMotion& object = row.object;
  const Pose T_ego = object.T_lidar_t_lidar_k * object.T_mov.inverse();
  return T_ego.linear() * object.velocity_lidar_k;
}

nlohmann::json row_json(const ReportRow& row) {
  const ObjectMotion& object = row.object;
  nlohmann::json json{
      {"stamp", row.stamp.time_since_epoch().count()},
      {"unix_time", mrpt::Clock::toDouble(row.stamp)},
      {"camera", object.camera_label},
      {"track", object.track_id},
      {"class", object.class_name},
      {"status", to_string(object.status)},
      {"points", row.num_points},
      {"tracked", object.num_tracked},
      {"inliers", object.num_inliers},
      {"rmse_px", object.rmse_px},
      {"position_sigma_m", position_sigma(object)},
      {"position_covariance_m2", covariance_json(object.position_covariance)},
      {"position_m", vector_json(object.T_lidar_t_lidar_k * object.centroid_lidar_k)},
      {"velocity_m_s", vector_json(velocity_of(row))},
      {"yaw_rate_rad_s", object.yaw_rate},
      {"box_px", {object.box.left, object.box.top, object.box.right, object.box.bottom}},
      {"moving", moves(object)},
      {"T_rest_lidar", pose_json(row.T_rest_lidar)}};
  if (row.box) json["box"] = box_json(*row.box);
  return json;
}

nlohmann::json cluster_json(Stamp key_stamp, const OtherCluster& cluster) {
  return {{"key_stamp", key_stamp.time_since_epoch().count()},
          {"position_m", vector_json(cluster.centroid_lidar_k)},
          {"size_m", vector_json(cluster.size)},
          {"points", cluster.num_points},
          {"why", cluster.why}};
}

// Without rows.
nlohmann::json head_json(const DensifyReport& report) {
  nlohmann::json json{
      {"input", report.input},
      {"output", report.output},
      {"mode", report.mode},
      {"hindsight", report.hindsight},
      {"camera_time_offset_ms", report.camera_time_offset_ms},
      {"ego_motion", report.ego_source},
      {"detector", report.detector},
      {"carrier", report.carrier},
      {"entries_in", report.num_objects_in},
      {"scans_in", report.num_scans},
      {"images_in", report.num_images},
      {"virtual_scans", report.num_virtual_scans},
      {"virtual_scans_with_extrapolated_ego_motion", report.num_extrapolated},
      {"resampling", report.resampling},
      {"tracks", report.tracks.size()},
      {"moving_tracks", report.moving_tracks.size()},
      {"object_status", report.object_status},
      {"warnings", report.told_warnings()},
      {"machine", {{"load", load_of_machine()}, {"cores", std::thread::hardware_concurrency()}}},
      {"stages", nlohmann::json::array()},
      {"frames",
       {{"position_m", "LiDAR at the image"},
        {"velocity_m_s", "LiDAR at the image, over ground, of the middle of the box"},
        {"box", "LiDAR at the image; pose of its centre: x y z qx qy qz qw"},
        {"T_rest_lidar", "LiDAR at the image in the LiDAR at the first scan: x y z qx qy qz qw"},
        {"clusters_left_static", "LiDAR at the key scan"}}},
      {"objects", nlohmann::json::array()},
      {"objects_out_of_view", nlohmann::json::array()},
      {"clusters_left_static", nlohmann::json::array()}};
  for (const std::string& stage : report.stage_order) {
    const Durations& times = report.stage_ms.at(stage);
    json["stages"].push_back({{"stage", stage},
                              {"runs", times.count()},
                              {"median_ms", times.quantile(0.5)},
                              {"p95_ms", times.quantile(0.95)},
                              {"total_ms", times.total_ms()}});
  }
  return json;
}

constexpr const char* kInView = "objects";
constexpr const char* kOutOfView = "objects_out_of_view";
constexpr const char* kClusters = "clusters_left_static";

/// The rows of one of the report's lists, one by one.
void for_each_row(const DensifyReport& report, const std::string& list,
                  const std::function<void(const nlohmann::json&)>& use) {
  if (!report.rows) return;
  if (list == kClusters) {
    report.rows->for_each(
        {}, [&](Stamp stamp, const OtherCluster& cluster) { use(cluster_json(stamp, cluster)); });
    return;
  }
  report.rows->for_each(
      [&](const ReportRow& row) {
        if (row.object.camera_label.empty() == (list == kOutOfView)) use(row_json(row));
      },
      {});
}

}  // namespace

nlohmann::json to_json(const DensifyReport& report) {
  nlohmann::json json = head_json(report);
  for (const char* const list : {kInView, kOutOfView, kClusters})
    for_each_row(report, list, [&](const nlohmann::json& row) { json[list].push_back(row); });
  return json;
}

void for_each_object(const DensifyReport& report,
                     const std::function<void(const nlohmann::json& row, bool in_view)>& use) {
  for_each_row(report, kInView, [&](const nlohmann::json& row) { use(row, true); });
  for_each_row(report, kOutOfView, [&](const nlohmann::json& row) { use(row, false); });
}

void write_json(const DensifyReport& report, std::ostream& out) {
  const nlohmann::json head = head_json(report);
  const char* before = "{\n ";
  for (const auto& [key, value] : head.items()) {
    out << std::exchange(before, ",\n ") << '"' << key << "\": ";
    if (key != kInView && key != kOutOfView && key != kClusters) {
      out << indented(value, 1);
      continue;
    }
    const char* before_row = "[\n  ";
    for_each_row(report, key, [&](const nlohmann::json& row) {
      out << std::exchange(before_row, ",\n  ") << indented(row, 2);
    });
    out << (before_row[0] == '[' ? "[]" : "\n ]");
  }
  out << "\n}\n";
}

}  // namespace lidar_upsampling
