// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservation3DRangeScan.h>

#include <utility>

#include "end_to_end/stock_maps.h"
#include "plugin/recording.h"

namespace lidar_upsampling {
namespace {

using mrpt::obs::CActionCollection;
using mrpt::obs::CObservation3DRangeScan;
using mrpt::obs::CSensoryFrame;

constexpr std::size_t kRealScans = 5;

// Of the images that no scan was taken with.
std::vector<Stamp> stamps_between_scans(const std::vector<Logged>& all, const std::string& lidar) {
  const std::vector<Stamp> scans = stamps_of(with_label(all, lidar));
  std::vector<Stamp> stamps = stamps_of(with_label(all, "CAM0"));
  stamps.erase(std::remove_if(stamps.begin(), stamps.end(),
                              [&](Stamp stamp) {
                                return std::binary_search(scans.begin(), scans.end(), stamp);
                              }),
               stamps.end());
  return stamps;
}

struct Rig {
  std::string name, lidar, label, carrier, virtual_class;
};

void PrintTo(const Rig& rig, std::ostream* out) { *out << rig.name; }

/// What rawlog-grabber records is used by the other stock programs.
class Recording : public RawlogGrabber, public testing::WithParamInterface<Rig> {};

TEST_P(Recording, has_a_virtual_scan_for_every_image_between_scans_that_stock_programs_use) {
  const Rig& rig = GetParam();
  if (!is_installed("icp-slam")) GTEST_SKIP() << "icp-slam is not installed";
  simulate(folder_, "[ego]\nspeed_mps = 4\n", rig.lidar);
  const std::string words =
      grab("-e 's/^speed = .*/speed = 0/' -e 's/^carrier = .*/carrier = " + rig.carrier + "/'");
  ASSERT_NE(recording(), "") << words;
  const std::string virtual_label = rig.label + "_VIRTUAL";
  const auto real = observations_of(folder_ / "in.rawlog");
  const auto all = observations_of(recording());
  expect_same(without_label(all, virtual_label), real);
  expect_in_time_order(all);
  const auto made = with_label(all, virtual_label);
  EXPECT_EQ(stamps_of(made), stamps_between_scans(real, rig.label)) << words;
  for (const Logged& scan : made)
    EXPECT_EQ(scan.observation->GetRuntimeClass()->className, rig.virtual_class);

  const ToolResult info = run("rawlog-edit --info -i " + recording());
  EXPECT_TRUE(contains(info.text, virtual_label + " /      8 /")) << info.text;
  expect_done("cd " + folder_.path().string() + " && icp-slam " CONFIG_FOLDER "/icp-slam.ini " +
              recording());
  const auto mapped = scans_in_simplemap(file_ending_in(folder_.path(), ".simplemap"));
  EXPECT_EQ(with_label(mapped, rig.label).size(), kRealScans);
  EXPECT_EQ(with_label(mapped, virtual_label).size(), kVirtualScans);
  EXPECT_GT(placed(with_label(mapped, virtual_label), Placing::by_pose).size(),
            1000 * kVirtualScans);
}

constexpr const char* kRangeScan = "mrpt::obs::CObservation3DRangeScan";
constexpr const char* kPointCloud = "mrpt::obs::CObservationPointCloud";

INSTANTIATE_TEST_SUITE_P(
    Rigs, Recording,
    testing::Values(Rig{"range_scans", kSmallLidar, "LIDAR", "3drangescan", kRangeScan},
                    Rig{"point_clouds", kSmallLidar, "LIDAR", "pointcloud", kPointCloud},
                    Rig{"depth_images", kDepthCamera, "DEPTH", "auto", kRangeScan}),
    [](const auto& test) { return test.param.name; });

TEST_F(RawlogGrabber, virtual_depth_images_are_recorded_as_the_depth_cameras_own) {
  simulate(folder_, "[scenario]\nduration_s = 0.2\n[ego]\nspeed_mps = 1\n", kDepthCamera);
  const std::string words = grab("'s/^speed = .*/speed = 0/'");
  const auto all = observations_of(recording());
  const auto depth_image = [](const Logged& logged) -> const CObservation3DRangeScan& {
    return dynamic_cast<const CObservation3DRangeScan&>(*logged.observation);
  };
  const auto made = with_label(all, "DEPTH_VIRTUAL");
  EXPECT_EQ(made.size(), 4U) << words;
  const CObservation3DRangeScan& real = depth_image(with_label(all, "DEPTH").at(0));
  for (const Logged& logged : made) {
    const CObservation3DRangeScan& image = depth_image(logged);
    EXPECT_EQ(image.cameraParams.intrinsicParams, real.cameraParams.intrinsicParams);
    EXPECT_EQ(image.rangeUnits, real.rangeUnits);
    ASSERT_TRUE(image.hasRangeImage);
    EXPECT_GT((image.rangeImage.array() > 0).count(), 0.8 * (real.rangeImage.array() > 0).count());
  }
}

// The increments of the actions that stand right before a frame, as MRPT's programs ask for.
double way_by_actions(const std::string& path) {
  double way_m = 0, pending_m = 0;
  for (const RawlogEntry& entry : read_log(path)) {
    if (const auto* actions = dynamic_cast<CActionCollection*>(entry.object.get()))
      pending_m += actions->getBestMovementEstimation()->poseChange->getMeanVal().x();
    else if (dynamic_cast<CSensoryFrame*>(entry.object.get()) != nullptr)
      way_m += std::exchange(pending_m, 0.);
  }
  return way_m;
}

TEST_F(RawlogGrabber, the_actions_of_a_played_log_are_those_of_its_frames_and_rbpf_slam_follows) {
  if (!is_installed("rbpf-slam")) GTEST_SKIP() << "rbpf-slam is not installed";
  simulate(folder_,
           std::string(kFewBeams) + "[log]\nformat = sensory_frames\n[ego_poses]\nkind = none\n");
  const std::string words =
      grab("-e 's/^speed = .*/speed = 0/' -e 's/^use_sensoryframes = .*/use_sensoryframes = 1/'");
  EXPECT_NEAR(way_by_actions(recording()), 3.2, 0.05) << words;  // 0.4 s at 8 m/s
  expect_done("cd " + folder_.path().string() + " && rbpf-slam " CONFIG_FOLDER "/rbpf-slam.ini " +
              recording());
  const auto mapped = scans_in_simplemap(file_ending_in(folder_.path(), ".simplemap"));
  EXPECT_EQ(with_label(mapped, "LIDAR").size(), kRealScans);
  EXPECT_EQ(with_label(mapped, "LIDAR_VIRTUAL").size(), kVirtualScans);
  ASSERT_FALSE(mapped.empty());
  EXPECT_NEAR(mapped.back().T_map_vehicle.translation().x(), 3.2, 0.3);
}

}  // namespace
}  // namespace lidar_upsampling
