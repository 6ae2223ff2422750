// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <mrpt/obs/CObservationRobotPose.h>

#include "end_to_end/ddad_scene.h"
#include "lidar_upsampling/io/carriers.h"
#include "lidar_upsampling/io/images.h"
#include "lidar_upsampling/metrics/chamfer.h"
#include "pipeline.h"

namespace fs = std::filesystem;

namespace lidar_upsampling {
namespace {

void write_pose(RawlogWriter& writer, const DgpSample& sample) {
  mrpt::obs::CObservationRobotPose pose;
  pose.sensorLabel = "POSE";
  pose.timestamp = sample.scan.stamp;
  pose.pose.mean = to_mrpt(sample.T_world_vehicle);
  writer.write(pose);
}

// As somebody else's converter would; the scan of sample `withheld` is left out.
void write_scene(const std::string& path, const std::vector<DgpSample>& samples,
                 std::size_t withheld, Carrier carrier) {
  RawlogWriter writer(path, false);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    write_pose(writer, samples[i]);
    if (i != withheld) writer.write(*observation_from_scan(samples[i].scan, carrier));
    for (const CameraImage& image : samples[i].images) writer.write(*observation_from_image(image));
  }
  writer.commit();
}

class DdadScene : public testing::TestWithParam<std::string> {};

// The vehicle stands, as most of the scene does. The cameras' pictures are 21 ms after the scans.
TEST_P(DdadScene, three_cameras_make_one_virtual_scan_of_each_instant) {
  const fs::path data = data_folder() / "ddad_scene_01";
  if (!fs::exists(data)) GTEST_SKIP() << "no " << data;
  const auto samples = load_dgp_scene(data);
  ASSERT_EQ(samples.size(), 3U);
  ASSERT_EQ(samples[1].images.size(), 3U);
  const TestFolder folder;
  write_scene(folder / "in.rawlog", samples, 1, carrier_from_string(GetParam()));
  densify(folder);

  const auto scans = with_label(observations_of(folder / "out.rawlog"), "LIDAR_VIRTUAL");
  const Stamp middle = samples[1].images[0].stamp;
  const auto found = std::find_if(scans.begin(), scans.end(),
                                  [&](const Logged& scan) { return scan.stamp() == middle; });
  ASSERT_NE(found, scans.end());
  // The first instant is no scan's own, and has no picture before it to follow anything from.
  EXPECT_EQ(scans.size(), 2U);
  const LidarScan virtual_scan = scan_from_observation(*found->observation).value();
  EXPECT_EQ(virtual_scan.size(), samples[0].scan.size());

  int num_moved = 0;
  for (std::size_t i = 0; i < virtual_scan.size(); ++i)
    if ((virtual_scan.points[i] - samples[0].scan.points[i]).norm() > 0.03) ++num_moved;
  EXPECT_LT(num_moved, 0.1 * static_cast<double>(virtual_scan.size()));

  // As near to the withheld scan as two real scans of the standing scene are to each other.
  const Chamfer ours = compute_chamfer(virtual_scan.points, samples[1].scan.points);
  const Chamfer real = compute_chamfer(samples[0].scan.points, samples[1].scan.points);
  EXPECT_LT(ours.mean_m(), real.mean_m() + 0.01);
}

INSTANTIATE_TEST_SUITE_P(Classes, DdadScene, testing::Values("pointcloud", "3drangescan"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace lidar_upsampling
