// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "run_report.h"

#include <array>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

namespace lidar_upsampling {

namespace {

using Json = nlohmann::json;

struct TrackRows {
  TrackFigures figures;
  std::set<std::int64_t> stamps;  // several cameras may see it at one
  double sum_speed = 0;
};

double norm_of(const Json& vector) {
  return std::hypot(vector.at(0).get<double>(), vector.at(1).get<double>(),
                    vector.at(2).get<double>());
}

void add_row(const Json& row, double first_time, TrackRows& track) {
  const bool first_here = track.stamps.insert(row.at("stamp").get<std::int64_t>()).second;
  if (!first_here) return;
  TrackFigures& figures = track.figures;
  ++figures.num_images;
  figures.class_name = row.at("class").get<std::string>();
  const auto status = row.at("status").get<std::string>();
  const double time = row.at("unix_time").get<double>() - first_time;
  if (status == "stationary") figures.speeds.push_back({time, 0});
  if (status != "moving" && status != "predicted") return;
  const double speed = norm_of(row.at("velocity_m_s"));
  figures.speeds.push_back({time, speed});
  ++figures.num_moving;
  figures.last_speed = speed;
  track.sum_speed += speed;
  figures.mean_speed = track.sum_speed / figures.num_moving;
}

std::vector<TrackFigures> tracks_of(const Json& rows) {
  std::map<int, TrackRows> tracks;
  const double first_time = rows.empty() ? 0 : rows.front().at("unix_time").get<double>();
  for (const Json& row : rows) {
    const int id = row.at("track").get<int>();
    tracks[id].figures.id = id;
    add_row(row, first_time, tracks[id]);
  }
  std::vector<TrackFigures> figures;
  figures.reserve(tracks.size());
  for (auto& [id, track] : tracks) figures.push_back(std::move(track.figures));
  return figures;
}

}  // namespace

ReportedObject reported_object(const Json& row, bool in_view) {
  ReportedObject object;
  object.in_view = in_view;
  object.stamp = row.at("stamp").get<std::int64_t>();
  object.status = row.at("status").get<std::string>();
  object.track = row.at("track").get<int>();
  object.points = row.at("points").get<int>();
  object.moving = row.at("moving").get<bool>();
  object.yaw_rate = row.at("yaw_rate_rad_s").get<double>();
  object.sigma = row.at("position_sigma_m").get<double>();
  for (int i = 0; i < 3; ++i) {
    object.position[i] = row.at("position_m").at(i).get<double>();
    object.velocity[i] = row.at("velocity_m_s").at(i).get<double>();
  }
  object.middle = object.position;
  if (const auto box = row.find("box"); box != row.end())
    for (int i = 0; i < 3; ++i) object.middle[i] = box->at("pose").at(i).get<double>();
  const auto c = row.at("position_covariance_m2").get<std::array<double, 6>>();
  object.covariance << c[0], c[1], c[2], c[1], c[3], c[4], c[2], c[4], c[5];
  return object;
}

namespace {

RunReport report_of(const Json& json) {
  RunReport report;
  report.ego_motion = json.at("ego_motion").get<std::string>();
  report.camera_time_offset_ms = json.at("camera_time_offset_ms").get<double>();
  report.detector = json.at("detector").get<std::string>();
  report.carrier = json.at("carrier").get<std::string>();
  report.num_scans = json.at("scans_in").get<int>();
  report.num_images = json.at("images_in").get<int>();
  report.num_virtual = json.at("virtual_scans").get<int>();
  report.num_extrapolated = json.at("virtual_scans_with_extrapolated_ego_motion").get<int>();
  report.object_status = json.at("object_status").get<std::map<std::string, int>>();
  report.warnings = json.at("warnings").get<std::map<std::string, int>>();
  if (const auto machine = json.find("machine"); machine != json.end()) {
    report.load = machine->at("load").get<double>();
    report.cores = machine->at("cores").get<int>();
  }
  for (const Json& stage : json.at("stages"))
    report.stages.push_back({stage.at("stage").get<std::string>(), stage.at("runs").get<int>(),
                             stage.at("median_ms").get<double>(), stage.at("p95_ms").get<double>(),
                             stage.at("total_ms").get<double>()});
  report.tracks = tracks_of(json.at("objects"));
  for (const Json& row : json.at("objects")) report.objects.push_back(reported_object(row));
  for (const Json& row : json.at("objects_out_of_view"))
    report.out_of_view.push_back(reported_object(row, false));
  return report;
}

}  // namespace

RunReport load_run_report(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path + ": cannot read this report (option --report)");
  try {
    RunReport report = report_of(Json::parse(file));
    report.path = path;
    return report;
  } catch (const Json::exception& error) {
    throw std::runtime_error(
        path + ": no report of this version's rawlog-densify --report: " + error.what());
  }
}

}  // namespace lidar_upsampling
