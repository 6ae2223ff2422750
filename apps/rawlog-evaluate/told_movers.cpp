// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "told_movers.h"

#include <algorithm>
#include <map>

namespace lidar_upsampling {
namespace {

constexpr double kNear_m = 6;  // the half of a bus, where the report knows one end of it

bool moves_near(const ScanResult& scan, const Eigen::Vector3d& place) {
  return std::any_of(scan.objects.begin(), scan.objects.end(), [&](const ObjectResult& result) {
    const ReferenceMotion& motion = result.object.motion;
    const Eigen::Vector3d there = motion.T_lidar_t_lidar_k * motion.centroid_k;
    return result.object.moving && (there - place).head<2>().norm() < kNear_m;
  });
}

}  // namespace

ToldMovers told_movers(const LogResult& log, const RunReport& report, double max_range_m) {
  std::map<std::int64_t, const ScanResult*> scans;
  for (const ScanResult& scan : log.scans) scans[scan.stamp.time_since_epoch().count()] = &scan;
  ToldMovers movers;
  for (const ReportedObject& object : report.objects) {
    if (object.status != "moving" && object.status != "predicted") continue;
    const auto scan = scans.find(object.stamp);
    if (scan == scans.end() || object.position.head<2>().norm() > max_range_m) continue;
    ++(moves_near(*scan->second, object.position) ? movers.near : movers.elsewhere);
  }
  return movers;
}

std::string to_text(const ToldMovers& movers, bool has_truth) {
  if (!has_truth) return {};
  return "\ntold to move, objects times images: " + std::to_string(movers.near) +
         " near one that does, " + std::to_string(movers.elsewhere) + " elsewhere\n";
}

}  // namespace lidar_upsampling
