// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "binned.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace lidar_upsampling {

namespace {

/// What errors are sorted by.
struct SortKey {
  const char* name;
  const char* unit;
  std::vector<double> edges;
  double (*of)(const ScanResult&, const ObjectResult&);
};

/// Every hundredth of a second that occurs is a bin of its own.
std::vector<double> horizon_edges(const LogResult& result) {
  std::set<double> sorted;
  result.scans.for_each([&](const ScanResult& scan) {
    const double edge = 0.01 * std::round(scan.dt / 0.01) - 0.005;
    sorted.insert(edge);
    sorted.insert(edge + 0.01);
  });
  std::vector<double> edges(sorted.begin(), sorted.end());
  edges.erase(std::unique(edges.begin(), edges.end(),
                          [](double a, double b) { return std::abs(a - b) < 0.001; }),
              edges.end());
  return edges;
}

std::vector<SortKey> sort_keys(const LogResult& result) {
  return {
      {"horizon", "s", horizon_edges(result),
       [](const ScanResult& scan, const ObjectResult&) { return scan.dt; }},
      {"range", "m", range_edges(),
       [](const ScanResult&, const ObjectResult& object) {
         return object.object.motion.centroid_k.head<2>().norm();
       }},
      {"points", "points", point_count_edges(), [](const ScanResult&, const ObjectResult& object) {
         return static_cast<double>(object.num_points);
       }}};
}

/// Of a row's objects, by each key.
std::vector<std::vector<KeyedError>> keyed_errors(const LogResult& result, bool moving, Row row,
                                                  const std::vector<SortKey>& keys) {
  std::vector<std::vector<KeyedError>> errors(keys.size());
  result.scans.for_each([&](const ScanResult& scan) {
    for (const ObjectResult& object : scan.objects) {
      if (object.object.moving != moving || !is_counted(object) || !object.errors[row]) continue;
      for (std::size_t k = 0; k < keys.size(); ++k)
        errors[k].push_back({keys[k].of(scan, object), object.errors[row]->position_m});
    }
  });
  return errors;
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

/// All bins of a key, empty ones too.
std::vector<Bin> empty_bins(const std::vector<double>& edges) {
  std::vector<Bin> bins;
  for (std::size_t i = 0; i + 1 < edges.size(); ++i)
    bins.push_back({edges[i], edges[i + 1], {}, 0});
  return bins;
}

void fill_row(const std::vector<KeyedError>& errors, Row row, const std::vector<double>& edges,
              std::vector<Bin>& bins) {
  if (bins.empty()) return;  // no scan was compared
  const std::vector<ErrorBin> filled = bin_errors(errors, edges);
  for (std::size_t i = 0; i < bins.size(); ++i) {
    bins[i].rows[row] = filled[i].errors;
    if (row == Row::ours) bins[i].mean_key = mean_key(errors, bins[i].from, bins[i].to);
  }
}

}  // namespace

std::vector<Binned> binned_errors(const LogResult& result) {
  const std::vector<SortKey> keys = sort_keys(result);
  std::vector<Binned> all;
  for (const bool moving : {true, false}) {
    std::vector<std::vector<Bin>> bins;
    for (const SortKey& key : keys) bins.push_back(empty_bins(key.edges));
    for (const Row row : kRows) {
      const auto errors = keyed_errors(result, moving, row, keys);
      for (std::size_t k = 0; k < keys.size(); ++k)
        fill_row(errors[k], row, keys[k].edges, bins[k]);
    }
    for (std::size_t k = 0; k < keys.size(); ++k) {
      Binned binned{keys[k].name, keys[k].unit, moving, {}};
      for (Bin& bin : bins[k])
        if (bin.rows[Row::ours].count > 0) binned.bins.push_back(std::move(bin));
      all.push_back(std::move(binned));
    }
  }
  return all;
}

}  // namespace lidar_upsampling
