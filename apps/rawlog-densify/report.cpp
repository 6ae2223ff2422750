// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "report.h"

#include <mrpt/core/Clock.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <sstream>

namespace lidar_upsampling {
namespace {

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto position =
      static_cast<std::size_t>(std::lround(share * static_cast<double>(values.size() - 1)));
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(position),
                   values.end());
  return values[position];
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

nlohmann::json row_json(const DensifyReport::Row& row) {
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
      {"position_covariance_m2", covariance_json(position_uncertainty(object))},
      {"position_m", vector_json(object.T_lidar_t_lidar_k * object.centroid_lidar_k)},
      {"velocity_m_s", vector_json(object.velocity_lidar_k)},
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

std::optional<ObjectBox> box_of(int track, const std::vector<ObjectBox>& boxes) {
  for (const ObjectBox& box : boxes)
    if (box.track_id == track) return box;
  return {};
}

std::string fixed(double value, int width, int digits) {
  std::ostringstream text;
  text.setf(std::ios::fixed);
  text.precision(digits);
  text.width(width);
  text << value;
  return text.str();
}

// Why points lie on the sensor's beams, or not.
std::string resampling_line(const std::map<std::string, std::size_t>& resampling) {
  const std::map<std::string, const char*> meanings{
      {"done", "on the sensor's beams"},
      {"little_motion", "as moved, which was little"},
      {"no_beams", "as moved, as the scan tells no beams (rings of a spinning LiDAR)"},
      {"none", "as moved"}};
  std::ostringstream text;
  for (const auto& [status, count] : resampling)
    text << (text.tellp() > 0 ? ", " : "points            ") << count << "x "
         << meanings.at(status);
  if (text.tellp() > 0) text << '\n';
  return text.str();
}

}  // namespace

void DensifyReport::add(const VirtualScan& scan, bool keep_rows) {
  ++num_virtual_scans;
  if (scan.ego_extrapolated) ++num_extrapolated;
  last_stamp = scan.scan.stamp;
  T_rest_lidar_last = scan.T_rest_lidar_t;
  ++resampling[to_string(scan.resampling)];
  const std::vector<ObjectBox> boxes = keep_rows ? object_boxes(scan) : std::vector<ObjectBox>{};
  for (const ObjectMotion& object : scan.objects) {
    ++object_status[to_string(object.status)];
    tracks.insert(object.track_id);
    if (moves(object)) moving_tracks.insert(object.track_id);
    if (!keep_rows) continue;
    rows.push_back({scan.scan.stamp, object.points.size(), object, box_of(object.track_id, boxes),
                    scan.T_rest_lidar_t});
    rows.back().object.points = {};
  }
  if (keep_rows)
    for (const OtherCluster& cluster : scan.other_clusters)
      other_clusters.emplace_back(scan.key_stamp, cluster);
  add(scan.timing);
}

void DensifyReport::add(const std::vector<StageTime>& times) {
  for (const StageTime& time : times) {
    if (stage_ms.find(time.stage) == stage_ms.end()) stage_order.emplace_back(time.stage);
    stage_ms[time.stage].push_back(time.ms);
  }
}

void DensifyReport::warn(const std::string& text) { ++warnings[text]; }

DensifyReport DensifyReport::begun_anew() const {
  DensifyReport report;
  report.input = input;
  report.output = output;
  report.mode = mode;
  report.ego_source = ego_source;
  report.detector = detector;
  report.carrier = carrier;
  report.camera_time_offset_ms = camera_time_offset_ms;
  report.hindsight = hindsight;
  return report;
}

nlohmann::json to_json(const DensifyReport& report) {
  nlohmann::json json{{"input", report.input},
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
                      {"warnings", report.warnings},
                      {"stages", nlohmann::json::array()},
                      {"frames",
                       {{"position_m", "LiDAR at the image"},
                        {"velocity_m_s", "LiDAR at the key scan, over ground"},
                        {"clusters_left_static", "LiDAR at the key scan"}}},
                      {"objects", nlohmann::json::array()},
                      {"objects_out_of_view", nlohmann::json::array()},
                      {"clusters_left_static", nlohmann::json::array()}};
  for (const std::string& stage : report.stage_order) {
    const std::vector<double>& times = report.stage_ms.at(stage);
    json["stages"].push_back({{"stage", stage},
                              {"runs", times.size()},
                              {"median_ms", quantile(times, 0.5)},
                              {"p95_ms", quantile(times, 0.95)},
                              {"total_ms", std::accumulate(times.begin(), times.end(), 0.)}});
  }
  for (const DensifyReport::Row& row : report.rows)
    json[row.object.camera_label.empty() ? "objects_out_of_view" : "objects"].push_back(
        row_json(row));
  for (const auto& [key_stamp, cluster] : report.other_clusters)
    json["clusters_left_static"].push_back(cluster_json(key_stamp, cluster));
  return json;
}

std::string summary(const DensifyReport& report) {
  std::ostringstream text;
  text << "mode              " << report.mode << (report.hindsight ? ", with scans to come" : "")
       << '\n'
       << "ego-motion        " << report.ego_source << '\n'
       << "object candidates " << report.detector << '\n'
       << "real scans        " << report.num_scans << '\n'
       << "images            " << report.num_images << '\n'
       << "virtual scans     " << report.num_virtual_scans << " (as " << report.carrier << ")\n"
       << "objects tracked   " << report.tracks.size() << ", of them moving "
       << report.moving_tracks.size() << '\n';
  for (const auto& [status, count] : report.object_status)
    text << "  " << status << std::string(16 - std::min<std::size_t>(15, status.size()), ' ')
         << count << '\n';
  text << resampling_line(report.resampling);
  if (report.num_extrapolated > 0)
    text << "ego-motion was extrapolated for " << report.num_extrapolated << " virtual scans\n";
  if (!report.stage_order.empty()) text << "stage                   runs  median ms  p95 ms\n";
  for (const std::string& stage : report.stage_order) {
    const std::vector<double>& times = report.stage_ms.at(stage);
    text << "  " << stage << std::string(20 - std::min<std::size_t>(19, stage.size()), ' ')
         << fixed(static_cast<double>(times.size()), 6, 0) << fixed(quantile(times, 0.5), 11, 1)
         << fixed(quantile(times, 0.95), 8, 1) << '\n';
  }
  for (const auto& [warning, count] : report.warnings)
    text << "warning (" << count << "x): " << warning << '\n';
  return text.str();
}

}  // namespace lidar_upsampling
