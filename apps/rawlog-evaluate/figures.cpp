// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "figures.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "beaten.h"
#include "binned.h"
#include "lidar_upsampling/units.h"

namespace lidar_upsampling {

namespace {

template <typename Visit>
void visit_objects(const LogResult& result, const Visit& visit) {
  result.scans.for_each([&](const ScanResult& scan) {
    for (const ObjectResult& object : scan.objects)
      if (is_counted(object)) visit(scan, object);
  });
}

using Values = std::vector<double>;

void add_to(Values& values, const std::optional<double>& value) {
  if (value) values.push_back(*value);
}

/// Errors of the objects that a row tells of.
struct ObjectValues {
  Values position, depth, velocity, yaw;

  void add(const ObjectError& error) {
    position.push_back(error.position_m);
    velocity.push_back(error.velocity_mps);
    yaw.push_back(error.yaw_rad / kDegree);
    if (error.depth_share) depth.push_back(*error.depth_share * 100);
  }
  [[nodiscard]] ObjectFigures figures() {
    return {summarize(std::move(position)), summarize(std::move(depth)),
            summarize(std::move(velocity)), summarize(std::move(yaw))};
  }
};

/// Sums over scans by seed, each a vector as long as there are seeds.
struct SampledValues {
  int num_scans = 0;
  Values chamfer_m2, chamfer_m, emd_m2, emd_m, exact_emd_m2, exact_emd_m;

  void add(const std::vector<SampledDistances>& samples) {
    if (samples.empty()) return;
    ++num_scans;
    for (std::size_t seed = 0; seed < samples.size(); ++seed) {
      const SampledDistances& sample = samples[seed];
      const EarthMoverDistance exact = sample.exact.value_or(EarthMoverDistance{});
      add(chamfer_m2, seed, sample.chamfer.sum_sq_m2());
      add(chamfer_m, seed, sample.chamfer.mean_m());
      add(emd_m2, seed, sample.emd.squared_m2);
      add(emd_m, seed, sample.emd.plain_m);
      add(exact_emd_m2, seed, exact.squared_m2);
      add(exact_emd_m, seed, exact.plain_m);
    }
  }
  [[nodiscard]] SampledFigures figures() const {
    return {figure_of(chamfer_m2), figure_of(chamfer_m),    figure_of(emd_m2),
            figure_of(emd_m),      figure_of(exact_emd_m2), figure_of(exact_emd_m)};
  }

 private:
  static void add(Values& by_seed, std::size_t seed, double value) {
    by_seed.resize(std::max(by_seed.size(), seed + 1));
    by_seed[seed] += value;
  }
  [[nodiscard]] SeededFigure figure_of(Values by_seed) const {
    SeededFigure figure;
    figure.num_scans = num_scans;
    if (num_scans == 0) return figure;
    for (double& value : by_seed) value /= num_scans;
    const auto count = static_cast<double>(by_seed.size());
    figure.mean = std::accumulate(by_seed.begin(), by_seed.end(), 0.) / count;
    double sum_sq = 0;
    for (const double value : by_seed) sum_sq += (value - figure.mean) * (value - figure.mean);
    figure.spread = by_seed.size() > 1 ? std::sqrt(sum_sq / (count - 1)) : 0;
    return figure;
  }
};

/// All that a row's figures are of, gathered in one go through the scans.
struct RowValues {
  ObjectValues moving, standing;
  Values moving_points, static_scene;
  Values chamfer_m, chamfer_m2, view_chamfer_m, view_chamfer_m2;
  Values epe_dynamic, epe_static, epe_background, epe_three_way;
  SampledValues sampled, sampled_inliers;

  void add(const ScanResult& scan, Row row) {
    for (const ObjectResult& object : scan.objects)
      if (is_counted(object) && object.errors[row])
        (object.object.moving ? moving : standing).add(*object.errors[row]);
    add_to(moving_points, scan.moving_points_m[row]);
    add_to(static_scene, scan.static_error_m[row]);
    if (scan.clouds[row]) add(*scan.clouds[row]);
    if (scan.flow[row]) add(*scan.flow[row]);
    sampled.add(scan.sampled[row].all);
    sampled_inliers.add(scan.sampled[row].inliers);
  }

 private:
  void add(const CloudResult& clouds) {
    chamfer_m.push_back(clouds.full.mean_m());
    chamfer_m2.push_back(clouds.full.sum_sq_m2());
    if (!clouds.in_view) return;
    view_chamfer_m.push_back(clouds.in_view->mean_m());
    view_chamfer_m2.push_back(clouds.in_view->sum_sq_m2());
  }
  void add(const ThreeWayEpe& flow) {
    add_to(epe_dynamic, flow.foreground_dynamic);
    add_to(epe_static, flow.foreground_static);
    add_to(epe_background, flow.background_static);
    add_to(epe_three_way, flow.mean());
  }
};

RowFigures row_figures(const LogResult& result, Row row) {
  RowValues values;
  result.scans.for_each([&](const ScanResult& scan) { values.add(scan, row); });
  const auto over_scans = [](Values& of_scans) { return summarize(std::move(of_scans)); };
  RowFigures figures;
  figures.moving = values.moving.figures();
  figures.standing = values.standing.figures();
  figures.moving_points_m = over_scans(values.moving_points);
  figures.static_scene_m = over_scans(values.static_scene);
  figures.chamfer_m = over_scans(values.chamfer_m);
  figures.chamfer_m2 = over_scans(values.chamfer_m2);
  figures.view_chamfer_m = over_scans(values.view_chamfer_m);
  figures.view_chamfer_m2 = over_scans(values.view_chamfer_m2);
  figures.epe_dynamic_m = over_scans(values.epe_dynamic);
  figures.epe_static_m = over_scans(values.epe_static);
  figures.epe_background_m = over_scans(values.epe_background);
  figures.epe_three_way_m = over_scans(values.epe_three_way);
  figures.sampled = values.sampled.figures();
  figures.sampled_inliers = values.sampled_inliers.figures();
  return figures;
}

void add_depth_by_object(const LogResult& result, Figures& figures) {
  std::map<std::string, PerRow<Values>> errors;
  visit_objects(result, [&](const ScanResult&, const ObjectResult& object) {
    if (!object.object.moving) return;
    for (const Row row : kRows)
      if (object.errors[row] && object.errors[row]->depth_share)
        errors[object.object.id][row].push_back(*object.errors[row]->depth_share * 100);
  });
  for (auto& [id, per_row] : errors)
    for (const Row row : kRows)
      figures.depth_by_object[id][row] = summarize(std::move(per_row[row]));
}

void count(const ScanResult& scan, Figures& figures) {
  for (const ObjectResult& object : scan.objects) {
    if (!object.object.excluded.empty())
      ++figures.left_out[object.object.excluded];
    else if (!object.errors[Row::ours])
      ++figures.left_out["not_recovered"];
  }
  figures.num_interpolated += scan.interpolated ? 1 : 0;
}

void add_reference(const LogResult& result, Figures& figures) {
  Values moving, standing;
  visit_objects(result, [&](const ScanResult&, const ObjectResult& object) {
    (object.object.moving ? moving : standing).push_back(object.object.motion.sigma_m);
  });
  figures.reference_moving_m = summarize(std::move(moving));
  figures.reference_standing_m = summarize(std::move(standing));
}

}  // namespace

Figures compute_figures(const LogResult& result) {
  Figures figures;
  for (const Row row : kRows) figures.rows[row] = row_figures(result, row);
  figures.binned = binned_errors(result);
  add_depth_by_object(result, figures);
  result.scans.for_each([&](const ScanResult& scan) { count(scan, figures); });
  add_reference(result, figures);
  figures.beaten = beaten_figures(result, figures.rows);
  return figures;
}

}  // namespace lidar_upsampling
