// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <nlohmann/json.hpp>
#include <utility>

#include "common/indented_json.h"
#include "report.h"

namespace lidar_upsampling {

namespace {

using Json = nlohmann::ordered_json;

Json json_of(const ErrorSummary& summary) {
  return {{"count", summary.count}, {"mean", summary.mean}, {"median", summary.median},
          {"p95", summary.p95},     {"q1", summary.q1},     {"q3", summary.q3}};
}

Json json_of(const SeededFigure& figure) {
  return {{"scans", figure.num_scans}, {"mean", figure.mean}, {"spread", figure.spread}};
}

Json json_of(const SampledFigures& figures) {
  return {{"chamfer_m2", json_of(figures.chamfer_m2)},
          {"chamfer_m", json_of(figures.chamfer_m)},
          {"emd_m2", json_of(figures.emd_m2)},
          {"emd_m", json_of(figures.emd_m)},
          {"exact_emd_m2", json_of(figures.exact_emd_m2)},
          {"exact_emd_m", json_of(figures.exact_emd_m)}};
}

Json json_of(const RowFigures& f) {
  Json json{{"moving_objects_m", json_of(f.moving.position_m)},
            {"moving_objects_depth_percent", json_of(f.moving.depth_percent)},
            {"moving_objects_velocity_m_s", json_of(f.moving.velocity_mps)},
            {"moving_objects_yaw_deg", json_of(f.moving.yaw_deg)},
            {"static_objects_m", json_of(f.standing.position_m)},
            {"static_objects_yaw_deg", json_of(f.standing.yaw_deg)},
            {"moving_points_m", json_of(f.moving_points_m)},
            {"static_scene_m", json_of(f.static_scene_m)},
            {"epe_dynamic_m", json_of(f.epe_dynamic_m)},
            {"epe_static_m", json_of(f.epe_static_m)},
            {"epe_background_m", json_of(f.epe_background_m)},
            {"epe_three_way_m", json_of(f.epe_three_way_m)},
            {"chamfer_m", json_of(f.chamfer_m)},
            {"chamfer_m2", json_of(f.chamfer_m2)},
            {"chamfer_in_view_m", json_of(f.view_chamfer_m)},
            {"chamfer_in_view_m2", json_of(f.view_chamfer_m2)}};
  if (f.sampled.chamfer_m2.num_scans > 0) json["sampled"] = json_of(f.sampled);
  if (f.sampled_inliers.chamfer_m2.num_scans > 0)
    json["sampled_without_outliers"] = json_of(f.sampled_inliers);
  return json;
}

Json json_of(const Chamfer& chamfer) {
  return {{"mean_m", chamfer.mean_m()},
          {"forward_m", chamfer.forward_m},
          {"backward_m", chamfer.backward_m},
          {"sum_sq_m2", chamfer.sum_sq_m2()},
          {"forward_sq_m2", chamfer.forward_sq_m2},
          {"backward_sq_m2", chamfer.backward_sq_m2}};
}

Json json_of(const ObjectError& error) {
  return {{"position_m", error.position_m},
          {"velocity_m_s", error.velocity_mps},
          {"yaw_rad", error.yaw_rad},
          {"depth_share", error.depth_share ? Json(*error.depth_share) : Json()}};
}

Json json_of(const ObjectResult& result) {
  const ObjectReference& object = result.object;
  const Eigen::Vector3d& centroid = object.motion.centroid_k;
  Json json{{"id", object.id},
            {"class", object.class_name},
            {"points", result.num_points},
            {"centroid_m", {centroid.x(), centroid.y(), centroid.z()}},
            {"range_m", centroid.head<2>().norm()},
            {"moving", object.moving},
            {"speed_mps", object.speed},
            {"reference_sigma_m", object.motion.sigma_m},
            {"excluded", object.excluded}};
  for (const Row row : kRows) {
    if (row == Row::floor || row == Row::oracle) continue;
    const auto& error = result.errors[row];
    json["error_m"][name_of(row)] = error ? Json(error->position_m) : Json();
    if (error) json["errors"][name_of(row)] = json_of(*error);
  }
  return json;
}

Json json_of(const ScanResult& scan) {
  Json json{{"stamp", scan.stamp.time_since_epoch().count()},
            {"key_stamp", scan.key_stamp.time_since_epoch().count()},
            {"dt_s", scan.dt},
            {"reference_interpolated", scan.interpolated},
            {"points_told", scan.points_told}};
  for (const Row row : kRows) {
    const char* name = name_of(row);
    if (scan.clouds[row]) {
      json["chamfer"][name]["full"] = json_of(scan.clouds[row]->full);
      if (scan.clouds[row]->in_view)
        json["chamfer"][name]["in_view"] = json_of(*scan.clouds[row]->in_view);
    }
    if (scan.moving_points_m[row]) json["moving_points_m"][name] = *scan.moving_points_m[row];
    if (scan.static_error_m[row]) json["static_error_m"][name] = *scan.static_error_m[row];
  }
  json["objects"] = Json::array();
  for (const ObjectResult& object : scan.objects) json["objects"].push_back(json_of(object));
  return json;
}

Json json_of(const Binned& binned) {
  Json json{{"by", binned.key}, {"unit", binned.unit}, {"moving", binned.moving}};
  for (const Bin& bin : binned.bins) {
    Json entry{{"from", bin.from}, {"to", bin.to}};
    for (const Row row : kRows)
      if (bin.rows[row].count > 0) entry["rows"][name_of(row)] = json_of(bin.rows[row]);
    json["bins"].push_back(entry);
  }
  return json;
}

Json json_of(const LabelScores& scores, int num_unlabelled) {
  Json json{{"virtual_scans_not_labelled", num_unlabelled}};
  for (const Row row : kRows) {
    if (!scores[row]) continue;
    for (const auto& [name, value] : named_figures(label_figures(*scores[row])))
      json["rows"][name_of(row)][name] = value;
  }
  for (const auto& [key, groups] : label_groups(scores))
    for (const LabelGroup& group : groups) {
      Json entry{{"of", group.name}, {"count", group.count}};
      for (const Row row : kRows)
        if (group.mean_m[row]) entry["mean_m"][name_of(row)] = *group.mean_m[row];
      json["movers_by_" + key].push_back(entry);
    }
  return json;
}

// Without the scans.
Json head_json(const LogResult& result, const Figures& figures) {
  Json json{{"label", result.label},
            {"virtual_label", result.virtual_label},
            {"num_virtual", result.num_virtual},
            {"num_compared", result.scans.size()},
            {"num_unmatched", result.num_unmatched},
            {"protocol", result.protocol},
            {"notes", result.notes}};
  if (result.labels[Row::ego]) json["labels"] = json_of(result.labels, result.num_unlabelled);
  for (const Row row : kRows) json["summary"][name_of(row)] = json_of(figures.rows[row]);
  json["baseline_beats_ours"] = figures.beaten;
  json["position_error_m"] = Json::array();
  for (const Binned& binned : figures.binned) json["position_error_m"].push_back(json_of(binned));
  for (const auto& [id, rows] : figures.depth_by_object)
    for (const Row row : kRows)
      if (rows[row].count > 0) json["depth_error_percent"][id][name_of(row)] = json_of(rows[row]);
  json["objects_left_out"] = figures.left_out;
  return json;
}

}  // namespace

void write_json(const LogResult& result, const Figures& figures,
                const std::function<void(const std::string& text)>& write) {
  std::string head = indented(head_json(result, figures), 0);
  head.resize(head.size() - 2);  // its end
  write(head + ",\n \"scans\": ");
  const char* before = "[\n  ";
  result.scans.for_each([&](const ScanResult& scan) {
    write(std::exchange(before, ",\n  ") + indented(json_of(scan), 2));
  });
  write(std::string(result.scans.empty() ? "[]" : "\n ]") + "\n}\n");
}

}  // namespace lidar_upsampling
