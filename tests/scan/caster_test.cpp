// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/scan/caster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "lidar_upsampling/scan/compose.h"
#include "spinning_scene.h"

namespace lidar_upsampling {
namespace {

using namespace testing;

const Block kBackdrop{{14, -30, -2}, {15, 30, 6}};
const Block kCar{{6, -1, -1.7}, {9, 1, -0.2}};

TEST(Azimuth, is_that_of_the_arc_tangent_all_around) {
  for (int step = 0; step < 100000; ++step) {
    const double angle = 2 * M_PI * step / 100000;
    const auto x = static_cast<float>(7 * std::cos(angle));
    const auto y = static_cast<float>(7 * std::sin(angle));
    const double turn = azimuth_of(x, y) - angle;
    ASSERT_LT(std::abs(std::remainder(turn, 2 * M_PI)), 1.2e-5) << angle;
    ASSERT_GE(azimuth_of(x, y), 0);
    ASSERT_LT(azimuth_of(x, y), kTurn);
  }
}

TEST(Elevation, is_that_of_the_arc_tangent_above_and_below_the_horizon) {
  for (int step = -1000; step <= 1000; ++step) {
    const double angle = M_PI / 2 * step / 1000;
    const auto level = static_cast<float>(7 * std::cos(angle));
    const auto z = static_cast<float>(7 * std::sin(angle));
    ASSERT_NEAR(elevation_of(level, z), angle, 1.2e-5);
  }
}

TEST(Columns, go_on_beyond_the_turn) {
  const Columns columns(0.01F);
  EXPECT_EQ(columns.at(0.0001F), 0);
  EXPECT_EQ(columns.at(-0.0001F), -1);
  EXPECT_EQ(columns.at(kTurn - 0.0001F), columns.number - 1);
  EXPECT_EQ(columns.at(kTurn + 0.0001F), columns.number);
}

// A scan in the order of beams, its patches, and two motions: of all, and of the car.
struct Scene {
  explicit Scene(const LabelledScan& key) {
    pattern = find_beam_pattern(key.scan).value();
    scan.points = taken(key.scan.points, pattern.order);
    take_fields(key.scan, pattern.order, scan);
    for (const int i : pattern.order) motions.of_patch.push_back(key.surface[i] == 1 ? 1 : 0);
    std::iota(pattern.order.begin(), pattern.order.end(), 0);
    const Pose T_lidar_t_lidar_k = driven(0.7, 0.1, 2).inverse();
    for (const Pose& T : {T_lidar_t_lidar_k, T_lidar_t_lidar_k * Eigen::Translation3d(0, 0.8, 0)}) {
      motions.forth.emplace_back(T);
      motions.back.emplace_back(T.inverse());
    }
    const PatchMaker maker(scan.points, pattern, {});
    for (int row = 0; row < pattern.num_rows(); ++row)
      for (int i = pattern.rows[row].begin; i < pattern.rows[row].end; ++i) {
        patches.push_back(maker.make(row, i, motions.of_patch.data()));
        row_of_patch.push_back(row);
      }
  }

  LidarScan scan;
  BeamPattern pattern;
  PatchMotions motions;
  std::vector<Patch> patches;
  std::vector<int> row_of_patch;
};

// Where a beam first meets a patch that reaches as far; infinite if it meets none. All are tried.
double first_range(const Scene& scene, int row, const Beam& beam, double reach) {
  // The beam as patches of each motion see it, from where each row of them was measured.
  std::vector<Eigen::Vector3d> directions;
  std::vector<std::vector<Eigen::Vector3d>> origins;
  for (const Eigen::Isometry3f& back : scene.motions.back) {
    directions.emplace_back((back.linear() * beam.direction).cast<double>());
    auto& origins_of_rows = origins.emplace_back();
    for (const BeamRow& patches_row : scene.pattern.rows)
      origins_of_rows.emplace_back(
          (back * scene.pattern.rows[row].origin() - patches_row.origin()).cast<double>());
  }
  double first = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < scene.patches.size(); ++i) {
    const Patch& patch = scene.patches[i];
    const int motion = scene.motions.of_patch[i];
    const Eigen::Vector3d& origin = origins[motion][scene.row_of_patch[i]];
    const Eigen::Vector3d& direction = directions[motion];
    const Eigen::Vector3d normal = patch.frame.row(0).cast<double>();
    const double range = (1 - normal.dot(origin)) / normal.dot(direction);
    if (!(range > 0) || range >= first) continue;
    const Eigen::Vector4d at = patch.frame.cast<double>() * (origin + range * direction);
    const Eigen::Array4d edges = patch.inverse_reach.cast<double>();
    if (at[1] > 0 && std::max({at[2] * edges[0], at[2] * edges[1], at[3] * edges[2],
                               at[3] * edges[3]}) <= reach * at[1])
      first = range;
  }
  return first;
}

std::vector<FootprintsOfRow> footprints_of(const Scene& scene, const Columns& columns) {
  std::vector<FootprintsOfRow> footprints;
  footprints.reserve(scene.pattern.rows.size());
  for (const BeamRow& row : scene.pattern.rows)
    footprints.push_back(
        find_footprints(row, scene.pattern, columns, scene.patches, scene.motions, 1.5F));
  return footprints;
}

TEST(RowCaster, finds_what_a_search_through_all_patches_finds) {
  Spinner spinner;
  spinner.columns = 900;
  const Scene scene(scan_of({kBackdrop, kCar}, spinner));
  const Columns columns(scene.pattern.azimuth_pitch);
  const std::vector<FootprintsOfRow> footprints = footprints_of(scene, columns);
  const CastScene cast_scene{scene.pattern, scene.patches, scene.motions, footprints};
  const ResampleOptions options;
  RowCaster caster(cast_scene, options);
  int compared = 0, different = 0;
  for (const int row : {3, 30, 45, 60}) {
    RowBeams beams;
    beams.beams = find_beams(scene.scan, scene.pattern, row, seen_directions(scene.pattern));
    beams.first = first_of_columns(beams.beams, columns);
    std::vector<double> ranges(beams.beams.size(), std::numeric_limits<double>::infinity());
    for (const BeamHit& hit : caster.cast(row, beams)) ranges[hit.beam] = hit.range;
    // Some, and those about azimuth zero.
    for (std::size_t k = 0; k < ranges.size(); k += k < 5 || k + 5 > ranges.size() ? 1 : 11) {
      const double first = first_range(scene, row, beams.beams[k], 1 + options.overlap);
      if (!std::isfinite(first)) continue;
      ++compared;
      // The mean of what lies on one surface: a little behind its first patch.
      if (ranges[k] < first - 1e-3 || ranges[k] > 1.02 * first + 0.1) ++different;
    }
  }
  EXPECT_GT(compared, 200);
  EXPECT_LE(different, compared / 200);
}

TEST(RowCaster, leaves_out_patches_that_do_not_count) {
  Scene scene(scan_of({kBackdrop, kCar}, {}));
  std::fill(scene.motions.of_patch.begin(), scene.motions.of_patch.end(), PatchMotions::kAbsent);
  const Columns columns(scene.pattern.azimuth_pitch);
  const std::vector<FootprintsOfRow> footprints = footprints_of(scene, columns);
  const CastScene cast_scene{scene.pattern, scene.patches, scene.motions, footprints};
  RowBeams beams;
  beams.beams = find_beams(scene.scan, scene.pattern, 20, seen_directions(scene.pattern));
  beams.first = first_of_columns(beams.beams, columns);
  RowCaster caster(cast_scene, {});
  EXPECT_TRUE(caster.cast(20, beams).empty());
}

}  // namespace
}  // namespace lidar_upsampling
