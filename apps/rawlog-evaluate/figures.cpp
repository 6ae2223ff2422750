// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "figures.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "beaten.h"
#include "lidar_upsampling/units.h"

namespace lidar_upsampling {

namespace {

/// An object counts where ours is known, so that the rows compare the same objects.
template <typename Visit>
void visit_objects(const LogResult& result, const Visit& visit) {
  for (const ScanResult& scan : result.scans)
    for (const ObjectResult& object : scan.objects)
      if (object.object.excluded.empty() && object.errors[Row::ours]) visit(scan, object);
}

ObjectFigures object_figures(const LogResult& result, bool moving, Row row) {
  std::vector<double> position, depth, velocity, yaw;
  visit_objects(result, [&](const ScanResult&, const ObjectResult& object) {
    const auto& error = object.errors[row];
    if (object.object.moving != moving || !error) return;
    position.push_back(error->position_m);
    velocity.push_back(error->velocity_mps);
    yaw.push_back(error->yaw_rad / kDegree);
    if (error->depth_share) depth.push_back(*error->depth_share * 100);
  });
  return {summarize(std::move(position)), summarize(std::move(depth)),
          summarize(std::move(velocity)), summarize(std::move(yaw))};
}

/// A figure of each scan that has it, over the log.
template <typename Get>
ErrorSummary over_scans(const LogResult& result, const Get& get) {
  std::vector<double> values;
  for (const ScanResult& scan : result.scans)
    if (const std::optional<double> value = get(scan)) values.push_back(*value);
  return summarize(std::move(values));
}

void add_chamfer(const LogResult& result, Row row, RowFigures& figures) {
  using Value = std::optional<double>;
  const auto full = [&](auto measure) {
    return over_scans(result, [&](const ScanResult& scan) {
      return scan.clouds[row] ? Value(measure(scan.clouds[row]->full)) : Value();
    });
  };
  const auto in_view = [&](auto measure) {
    return over_scans(result, [&](const ScanResult& scan) {
      return scan.clouds[row] && scan.clouds[row]->in_view
                 ? Value(measure(*scan.clouds[row]->in_view))
                 : Value();
    });
  };
  const auto m = [](const Chamfer& chamfer) { return chamfer.mean_m(); };
  const auto m2 = [](const Chamfer& chamfer) { return chamfer.sum_sq_m2(); };
  figures.chamfer_m = full(m);
  figures.chamfer_m2 = full(m2);
  figures.view_chamfer_m = in_view(m);
  figures.view_chamfer_m2 = in_view(m2);
}

void add_flow(const LogResult& result, Row row, RowFigures& figures) {
  const auto epe = [&](auto get) {
    return over_scans(result, [&](const ScanResult& scan) {
      return scan.flow[row] ? get(*scan.flow[row]) : std::optional<double>();
    });
  };
  figures.epe_dynamic_m = epe([](const ThreeWayEpe& flow) { return flow.foreground_dynamic; });
  figures.epe_static_m = epe([](const ThreeWayEpe& flow) { return flow.foreground_static; });
  figures.epe_background_m = epe([](const ThreeWayEpe& flow) { return flow.background_static; });
  figures.epe_three_way_m = epe([](const ThreeWayEpe& flow) { return flow.mean(); });
}

template <typename Get>
SeededFigure over_seeds(const LogResult& result, Row row,
                        std::vector<SampledDistances> SampledResult::*kind, const Get& get) {
  SeededFigure figure;
  std::vector<double> by_seed;
  for (const ScanResult& scan : result.scans) {
    const auto& samples = scan.sampled[row].*kind;
    if (samples.empty()) continue;
    ++figure.num_scans;
    by_seed.resize(std::max(by_seed.size(), samples.size()));
    for (std::size_t seed = 0; seed < samples.size(); ++seed) by_seed[seed] += get(samples[seed]);
  }
  if (figure.num_scans == 0) return figure;
  for (double& value : by_seed) value /= figure.num_scans;
  const auto count = static_cast<double>(by_seed.size());
  figure.mean = std::accumulate(by_seed.begin(), by_seed.end(), 0.) / count;
  double sum_sq = 0;
  for (const double value : by_seed) sum_sq += (value - figure.mean) * (value - figure.mean);
  figure.spread = by_seed.size() > 1 ? std::sqrt(sum_sq / (count - 1)) : 0;
  return figure;
}

SampledFigures sampled_figures(const LogResult& result, Row row,
                               std::vector<SampledDistances> SampledResult::*kind) {
  const auto over = [&](auto get) { return over_seeds(result, row, kind, get); };
  const auto exact = [](const SampledDistances& s) {
    return s.exact.value_or(EarthMoverDistance{});
  };
  return {over([](const SampledDistances& s) { return s.chamfer.sum_sq_m2(); }),
          over([](const SampledDistances& s) { return s.chamfer.mean_m(); }),
          over([](const SampledDistances& s) { return s.emd.squared_m2; }),
          over([](const SampledDistances& s) { return s.emd.plain_m; }),
          over([&](const SampledDistances& s) { return exact(s).squared_m2; }),
          over([&](const SampledDistances& s) { return exact(s).plain_m; })};
}

RowFigures row_figures(const LogResult& result, Row row) {
  RowFigures figures;
  figures.moving = object_figures(result, true, row);
  figures.standing = object_figures(result, false, row);
  figures.moving_points_m =
      over_scans(result, [row](const ScanResult& scan) { return scan.moving_points_m[row]; });
  figures.static_scene_m =
      over_scans(result, [row](const ScanResult& scan) { return scan.static_error_m[row]; });
  add_chamfer(result, row, figures);
  add_flow(result, row, figures);
  figures.sampled = sampled_figures(result, row, &SampledResult::all);
  figures.sampled_inliers = sampled_figures(result, row, &SampledResult::inliers);
  return figures;
}

/// Every hundredth of a second that occurs is a bin of its own.
std::vector<double> horizon_edges(const LogResult& result) {
  std::vector<double> edges;
  for (const ScanResult& scan : result.scans) {
    const double edge = 0.01 * std::round(scan.dt / 0.01) - 0.005;
    edges.push_back(edge);
    edges.push_back(edge + 0.01);
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end(),
                          [](double a, double b) { return std::abs(a - b) < 0.001; }),
              edges.end());
  return edges;
}

/// Of those in [from, to).
double mean_key(const std::vector<KeyedError>& errors, double from, double to) {
  double sum = 0;
  int count = 0;
  for (const KeyedError& error : errors)
    if (error.key >= from && error.key < to) {
      sum += error.key;
      ++count;
    }
  return sum / std::max(count, 1);
}

template <typename Key>
Binned binned_by(const LogResult& result, bool moving, const char* name, const char* unit,
                 const std::vector<double>& edges, const Key& key) {
  Binned binned{name, unit, moving, {}};
  if (edges.size() < 2) return binned;  // no scan was compared
  PerRow<std::vector<ErrorBin>> per_row;
  std::vector<KeyedError> ours;
  for (const Row row : kRows) {
    std::vector<KeyedError> errors;
    visit_objects(result, [&](const ScanResult& scan, const ObjectResult& object) {
      if (object.object.moving == moving && object.errors[row])
        errors.push_back({key(scan, object), object.errors[row]->position_m});
    });
    per_row[row] = bin_errors(errors, edges);
    if (row == Row::ours) ours = std::move(errors);
  }
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    Bin bin{edges[i], edges[i + 1], {}, mean_key(ours, edges[i], edges[i + 1])};
    for (const Row row : kRows) bin.rows[row] = per_row[row][i].errors;
    if (bin.rows[Row::ours].count > 0) binned.bins.push_back(bin);
  }
  return binned;
}

void add_binned(const LogResult& result, Figures& figures) {
  for (const bool moving : {true, false}) {
    figures.binned.push_back(
        binned_by(result, moving, "horizon", "s", horizon_edges(result),
                  [](const ScanResult& scan, const ObjectResult&) { return scan.dt; }));
    figures.binned.push_back(binned_by(result, moving, "range", "m", range_edges(),
                                       [](const ScanResult&, const ObjectResult& object) {
                                         return object.object.motion.centroid_k.head<2>().norm();
                                       }));
    figures.binned.push_back(binned_by(result, moving, "points", "points", point_count_edges(),
                                       [](const ScanResult&, const ObjectResult& object) {
                                         return static_cast<double>(object.object.points.size());
                                       }));
  }
}

void add_depth_by_object(const LogResult& result, Figures& figures) {
  std::map<std::string, PerRow<std::vector<double>>> errors;
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

void count_left_out(const LogResult& result, Figures& figures) {
  for (const ScanResult& scan : result.scans)
    for (const ObjectResult& object : scan.objects) {
      if (!object.object.excluded.empty())
        ++figures.left_out[object.object.excluded];
      else if (!object.errors[Row::ours])
        ++figures.left_out["not_recovered"];
    }
}

void add_reference(const LogResult& result, Figures& figures) {
  std::vector<double> moving, standing;
  visit_objects(result, [&](const ScanResult&, const ObjectResult& object) {
    (object.object.moving ? moving : standing).push_back(object.object.motion.sigma_m);
  });
  figures.reference_moving_m = summarize(std::move(moving));
  figures.reference_standing_m = summarize(std::move(standing));
  for (const ScanResult& scan : result.scans) figures.num_interpolated += scan.interpolated ? 1 : 0;
}

}  // namespace

Figures compute_figures(const LogResult& result) {
  Figures figures;
  for (const Row row : kRows) figures.rows[row] = row_figures(result, row);
  add_binned(result, figures);
  add_depth_by_object(result, figures);
  count_left_out(result, figures);
  add_reference(result, figures);
  figures.beaten = beaten_figures(result, figures.rows);
  return figures;
}

}  // namespace lidar_upsampling
