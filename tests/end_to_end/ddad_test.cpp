// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "dgp2rawlog/dgp_log.h"
#include "lidar_upsampling/io/carriers.h"
#include "lidar_upsampling/metrics/chamfer.h"
#include "pipeline.h"

namespace fs = std::filesystem;

namespace lidar_upsampling {
namespace {

// The scan of instant `withheld` is left out.
void write_scene(const std::string& path, dgp::Scene scene, std::ptrdiff_t withheld,
                 Carrier carrier) {
  scene.sweeps.erase(scene.sweeps.begin() + withheld);
  RawlogWriter writer(path, false);
  importing::write_items(writer, dgp::items_of(scene, carrier), [](double) {});
  writer.commit();
}

class DdadScene : public testing::TestWithParam<std::string> {};

// The vehicle stands, as most of the scene does. The cameras' pictures are 21 ms after the scans.
TEST_P(DdadScene, three_cameras_make_one_virtual_scan_of_each_instant) {
  const fs::path data = data_folder() / "ddad_scene_01";
  if (!fs::exists(data)) GTEST_SKIP() << "no " << data;
  const dgp::Scene scene = dgp::open_scene(data.string(), {});
  ASSERT_EQ(scene.sweeps.size(), 3U);
  ASSERT_EQ(scene.pictures.size(), 9U);
  const LidarScan first = dgp::read_sweep(scene.sweeps[0]);
  const LidarScan second = dgp::read_sweep(scene.sweeps[1]);
  const TestFolder folder;
  write_scene(folder / "in.rawlog", scene, 1, carrier_from_string(GetParam()));
  densify(folder);

  const auto scans = with_label(observations_of(folder / "out.rawlog"), "LIDAR_VIRTUAL");
  const Stamp middle = scene.pictures[3].file.stamp;
  const auto found = std::find_if(scans.begin(), scans.end(),
                                  [&](const Logged& scan) { return scan.stamp() == middle; });
  ASSERT_NE(found, scans.end());
  // The first instant is no scan's own, and has no picture before it to follow anything from.
  EXPECT_EQ(scans.size(), 2U);
  const LidarScan virtual_scan = scan_from_observation(*found->observation).value();
  EXPECT_EQ(virtual_scan.size(), first.size());

  int num_moved = 0;
  for (std::size_t i = 0; i < virtual_scan.size(); ++i)
    if ((virtual_scan.points[i] - first.points[i]).norm() > 0.03) ++num_moved;
  EXPECT_LT(num_moved, 0.1 * static_cast<double>(virtual_scan.size()));

  // As near to the withheld scan as two real scans of the standing scene are to each other.
  const Chamfer ours = compute_chamfer(virtual_scan.points, second.points);
  const Chamfer real = compute_chamfer(first.points, second.points);
  EXPECT_LT(ours.mean_m(), real.mean_m() + 0.01);
}

INSTANTIATE_TEST_SUITE_P(Classes, DdadScene, testing::Values("pointcloud", "3drangescan"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace lidar_upsampling
