// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "report.h"

#include <cstdarg>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>

namespace lidar_upsampling {

namespace {

using Json = nlohmann::ordered_json;

/// Errors of one row over the moving, or the static, objects.
ErrorSummary object_errors(const LogResult& result, bool moving, std::size_t row) {
  std::vector<double> errors;
  for (const ScanResult& scan : result.scans)
    for (const ObjectResult& object : scan.objects)
      // An object counts where every row knows it, so that the rows compare the same objects.
      if (object.object.excluded.empty() && object.object.moving == moving && object.error_m[0] &&
          object.error_m[row])
        errors.push_back(*object.error_m[row]);
  return summarize(std::move(errors));
}

using PerRow = std::array<std::optional<double>, kRows.size()>;

/// A figure of each scan, over the log.
ErrorSummary scan_figures(const LogResult& result, PerRow ScanResult::*figure, std::size_t row) {
  std::vector<double> values;
  for (const ScanResult& scan : result.scans)
    if ((scan.*figure)[row]) values.push_back(*(scan.*figure)[row]);
  return summarize(std::move(values));
}

struct ChamferMeans {
  ErrorSummary full_m, full_m2, view_m, view_m2;
};

ChamferMeans chamfer_means(const LogResult& result, std::size_t row) {
  std::vector<double> full_m, full_m2, view_m, view_m2;
  for (const ScanResult& scan : result.scans) {
    if (!scan.clouds[row]) continue;
    full_m.push_back(scan.clouds[row]->full.mean_m());
    full_m2.push_back(scan.clouds[row]->full.sum_sq_m2());
    if (!scan.clouds[row]->in_view) continue;
    view_m.push_back(scan.clouds[row]->in_view->mean_m());
    view_m2.push_back(scan.clouds[row]->in_view->sum_sq_m2());
  }
  return {summarize(full_m), summarize(full_m2), summarize(view_m), summarize(view_m2)};
}

std::map<std::string, int> count_excluded(const LogResult& result) {
  std::map<std::string, int> counts;
  for (const ScanResult& scan : result.scans)
    for (const ObjectResult& object : scan.objects) {
      if (!object.object.excluded.empty())
        ++counts[object.object.excluded];
      else if (!object.error_m[0])
        ++counts["not_recovered"];
    }
  return counts;
}

__attribute__((format(printf, 1, 2))) std::string formatted(const char* format, ...) {
  std::array<char, 256> line{};
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(line.data(), line.size(), format, arguments);
  va_end(arguments);
  return line.data();
}

std::string error_block(const char* title, const std::array<ErrorSummary, kRows.size()>& rows) {
  std::string block = formatted("%-34s %8s %8s %8s %8s\n", title, "count", "mean", "median", "p95");
  for (std::size_t row = 0; row < kRows.size(); ++row)
    block += formatted("  %-32s %8d %8.3f %8.3f %8.3f\n", kRows[row], rows[row].count,
                       rows[row].mean, rows[row].median, rows[row].p95);
  return block;
}

template <typename Errors>
std::array<ErrorSummary, kRows.size()> all_rows(const Errors& errors) {
  std::array<ErrorSummary, kRows.size()> rows;
  for (std::size_t row = 0; row < kRows.size(); ++row) rows[row] = errors(row);
  return rows;
}

std::string chamfer_block(const LogResult& result) {
  std::string block = formatted("%-34s %10s %10s %10s %10s\n", "Chamfer, full resolution, mean",
                                "all m", "all m2", "view m", "view m2");
  for (std::size_t row = 0; row < kRows.size(); ++row) {
    const ChamferMeans means = chamfer_means(result, row);
    block += formatted("  %-32s %10.4f %10.4f", kRows[row], means.full_m.mean, means.full_m2.mean);
    block += means.view_m.count > 0
                 ? formatted(" %10.4f %10.4f\n", means.view_m.mean, means.view_m2.mean)
                 : formatted(" %10s %10s\n", "-", "-");
  }
  return block;
}

Json json_of(const ErrorSummary& summary) {
  return {{"count", summary.count},
          {"mean", summary.mean},
          {"median", summary.median},
          {"p95", summary.p95}};
}

Json json_of(const Chamfer& chamfer) {
  return {{"mean_m", chamfer.mean_m()},
          {"forward_m", chamfer.forward_m},
          {"backward_m", chamfer.backward_m},
          {"sum_sq_m2", chamfer.sum_sq_m2()},
          {"forward_sq_m2", chamfer.forward_sq_m2},
          {"backward_sq_m2", chamfer.backward_sq_m2}};
}

Json json_of(const ObjectResult& result) {
  const ObjectReference& object = result.object;
  const Eigen::Vector3d& centroid = object.motion.centroid_k;
  Json json{{"id", object.id},
            {"class", object.class_name},
            {"points", object.points.size()},
            {"centroid_m", {centroid.x(), centroid.y(), centroid.z()}},
            {"range_m", centroid.head<2>().norm()},
            {"moving", object.moving},
            {"speed_mps", object.speed},
            {"reference_sigma_m", object.motion.sigma_m},
            {"excluded", object.excluded}};
  for (std::size_t row = 0; row < kRows.size(); ++row)
    json["error_m"][kRows[row]] = result.error_m[row] ? Json(*result.error_m[row]) : Json();
  return json;
}

Json json_of(const ScanResult& scan) {
  Json json{{"stamp", scan.stamp.time_since_epoch().count()},
            {"key_stamp", scan.key_stamp.time_since_epoch().count()},
            {"dt_s", scan.dt},
            {"ego_found", scan.ego_found},
            {"by_beam", scan.by_beam}};
  for (std::size_t row = 0; row < kRows.size(); ++row) {
    if (scan.clouds[row]) {
      json["chamfer"][kRows[row]]["full"] = json_of(scan.clouds[row]->full);
      if (scan.clouds[row]->in_view)
        json["chamfer"][kRows[row]]["in_view"] = json_of(*scan.clouds[row]->in_view);
    }
    if (scan.moving_points_m[row]) json["moving_points_m"][kRows[row]] = *scan.moving_points_m[row];
    if (scan.static_error_m[row]) json["static_error_m"][kRows[row]] = *scan.static_error_m[row];
  }
  json["objects"] = Json::array();
  for (const ObjectResult& object : scan.objects) json["objects"].push_back(json_of(object));
  return json;
}

}  // namespace

std::string to_table(const LogResult& result) {
  std::string table = formatted("%s: %d virtual scans, %zu compared, %d without a reference\n",
                                result.virtual_label.c_str(), result.num_virtual,
                                result.scans.size(), result.num_unmatched);
  table += "position error, m\n";
  table += error_block("moving objects",
                       all_rows([&](std::size_t row) { return object_errors(result, true, row); }));
  table +=
      error_block("static objects",
                  all_rows([&](std::size_t row) { return object_errors(result, false, row); }));
  const auto add_scan_block = [&](const char* title, PerRow ScanResult::*figure) {
    if (scan_figures(result, figure, 0).count > 0)
      table += error_block(
          title, all_rows([&](std::size_t row) { return scan_figures(result, figure, row); }));
  };
  add_scan_block("points of moving objects, per scan", &ScanResult::moving_points_m);
  add_scan_block("static scene, per scan", &ScanResult::static_error_m);
  table += chamfer_block(result);
  for (const auto& [reason, count] : count_excluded(result))
    table += formatted("objects left out, %s: %d\n", reason.c_str(), count);
  return table;
}

Json to_json(const LogResult& result) {
  Json json{{"label", result.label},
            {"virtual_label", result.virtual_label},
            {"num_virtual", result.num_virtual},
            {"num_compared", result.scans.size()},
            {"num_unmatched", result.num_unmatched}};
  for (std::size_t row = 0; row < kRows.size(); ++row) {
    Json& summary = json["summary"][kRows[row]];
    const ChamferMeans means = chamfer_means(result, row);
    summary["moving_objects_m"] = json_of(object_errors(result, true, row));
    summary["static_objects_m"] = json_of(object_errors(result, false, row));
    summary["moving_points_m"] = json_of(scan_figures(result, &ScanResult::moving_points_m, row));
    summary["static_scene_m"] = json_of(scan_figures(result, &ScanResult::static_error_m, row));
    summary["chamfer_m"] = json_of(means.full_m);
    summary["chamfer_m2"] = json_of(means.full_m2);
    summary["chamfer_in_view_m"] = json_of(means.view_m);
    summary["chamfer_in_view_m2"] = json_of(means.view_m2);
  }
  json["objects_left_out"] = count_excluded(result);
  json["scans"] = Json::array();
  for (const ScanResult& scan : result.scans) json["scans"].push_back(json_of(scan));
  return json;
}

}  // namespace lidar_upsampling
