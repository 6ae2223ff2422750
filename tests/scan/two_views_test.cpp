// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
// Virtual scans drawn from the key scan and the next one.
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "spinning_scene.h"

namespace lidar_upsampling {
namespace {

using namespace testing;

constexpr int kVan = 0;
const Block kHouse{{25, -30, -2}, {26, 30, 6}};

// A van drives off: here in the key scan, and farther on by `shift` metres later.
Block van(double shift) { return {{8 + shift, -1, -1.7}, {12 + shift, 1, 0.5}}; }

struct TwoScans {
  explicit TwoScans(const Spinner& spinner = {}, double noise_m = 0) : noisy(spinner) {
    noisy.noise_m = noise_m;
    key = scan_of({van(0), kHouse}, noisy);
    next = scan_of({van(2), kHouse}, noisy, driven(1, 0, 0));
    truth = scan_of({van(1), kHouse}, spinner, T_world_t);
  }

  [[nodiscard]] VirtualScan moved_key() const {
    return moved_scan(key, T_world_t, kVan, {1, 0, 0});
  }
  // As seen from where the next scan was taken, half of its way back.
  [[nodiscard]] VirtualScan moved_next() const {
    return moved_scan(next, driven(-0.5, 0, 0), kVan, {-1, 0, 0});
  }
  [[nodiscard]] VirtualScan of_key() const { return BeamResampler(key.scan).resample(moved_key()); }
  [[nodiscard]] VirtualScan of_both() const {
    const BeamResampler other(next.scan);
    const VirtualScan moved = moved_next();
    const BeamResampler::OtherView view{other, moved};
    return BeamResampler(key.scan).resample(moved_key(), &view);
  }

  Pose T_world_t = driven(0.5, 0, 0);
  Spinner noisy;
  LabelledScan key, next, truth;
};

// True points on the ground that the van has left, of which the virtual scan has none like it.
int missing_where_the_van_was(const TwoScans& scene, const VirtualScan& scan) {
  const auto found = by_beam(scan.scan);
  int missing = 0;
  for (std::size_t i = 0; i < scene.truth.scan.size(); ++i) {
    const Eigen::Vector3f& truth = scene.truth.scan.points[i];
    const Eigen::Vector3d at = scene.T_world_t * truth.cast<double>();
    if (at.x() < 8 || at.x() > 8.9 || std::abs(at.y()) > 1 || at.z() > -1.65) continue;
    const auto point = found.find({scene.truth.scan.ring[i], scene.truth.scan.column[i]});
    if (point == found.end() || (scan.scan.points[point->second] - truth).norm() > 0.05) ++missing;
  }
  return missing;
}

TEST(TwoViews, ground_that_a_mover_leaves_is_drawn_from_the_scan_that_saw_it) {
  const TwoScans scene;
  const int without = missing_where_the_van_was(scene, scene.of_key());
  EXPECT_GT(without, 100);
  EXPECT_LT(missing_where_the_van_was(scene, scene.of_both()), 0.1 * without);
}

TEST(TwoViews, points_that_the_key_scan_does_not_show_have_no_source_in_it) {
  const TwoScans scene;
  const VirtualScan scan = scene.of_both();
  ASSERT_EQ(scan.source_index.size(), scan.scan.size());
  EXPECT_GT(std::count(scan.source_index.begin(), scan.source_index.end(), -1), 100);
  for (std::size_t i = 0; i < scan.scan.size(); ++i) {
    const int source = scan.source_index[i];
    if (source < 0) continue;
    ASSERT_EQ(scan.scan.intensity[i], scene.key.scan.intensity[source]);
  }
}

TEST(TwoViews, each_beam_ends_once_on_what_comes_first) {
  const TwoScans scene;
  const VirtualScan scan = scene.of_both();
  EXPECT_EQ(by_beam(scan.scan).size(), scan.scan.size());
  const auto true_point = by_beam(scene.truth.scan);
  int on_van = 0, right = 0;
  for (std::size_t i = 0; i < scan.scan.size(); ++i) {
    const auto truth = true_point.find({scan.scan.ring[i], scan.scan.column[i]});
    if (truth == true_point.end() || scene.truth.surface[truth->second] != kVan) continue;
    ++on_van;
    right += (scan.scan.points[i] - scene.truth.scan.points[truth->second]).norm() < 0.03 ? 1 : 0;
  }
  EXPECT_GT(on_van, 500);
  EXPECT_GT(right, 0.97 * on_van);
}

TEST(TwoViews, both_together_are_less_noisy_than_one) {
  const TwoScans scene({}, 0.03);
  const auto noise_of = [&](const VirtualScan& scan) {
    double sum = 0;
    int count = 0;
    for (const Eigen::Vector3f& point : scan.scan.points) {
      const Eigen::Vector3d at = scene.T_world_t * point.cast<double>();
      if (at.x() < 24.5 || std::abs(at.y()) > 20 || at.z() < -1) continue;
      sum += std::pow(at.x() - kHouse.low.x(), 2);
      ++count;
    }
    return std::sqrt(sum / count);
  };
  EXPECT_LT(noise_of(scene.of_both()), 0.9 * noise_of(scene.of_key()));
}

TEST(TwoViews, a_scan_without_rings_adds_nothing) {
  const TwoScans scene;
  LidarScan plain = scene.next.scan;
  plain.ring.clear();
  const BeamResampler other(plain);
  const VirtualScan moved = scene.moved_next();
  const BeamResampler::OtherView view{other, moved};
  const VirtualScan scan = BeamResampler(scene.key.scan).resample(scene.moved_key(), &view);
  EXPECT_EQ(scan.scan.points, scene.of_key().scan.points);
}

TEST(TwoViews, a_virtual_scan_of_another_one_is_rejected) {
  const TwoScans scene;
  const BeamResampler other(scene.next.scan);
  VirtualScan moved = scene.moved_next();
  moved.source_index.back() = static_cast<int>(scene.next.scan.size());
  const BeamResampler::OtherView view{other, moved};
  EXPECT_THROW((void)BeamResampler(scene.key.scan).resample(scene.moved_key(), &view),
               std::invalid_argument);
}

}  // namespace
}  // namespace lidar_upsampling
