// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationPointCloud.h>

#include "lidar_upsampling/io/carriers.h"
#include "pipeline.h"

namespace lidar_upsampling {
namespace {

/// A log that differs from ours in one respect, and what the default settings make of it.
struct ForeignRig {
  std::string name;
  std::string changes;  ///< of the street
  std::string label = "LIDAR";
  double max_static_m = 0.02;
  std::string figure = "static_scene_m";  ///< of rawlog-evaluate
};

void PrintTo(const ForeignRig& rig, std::ostream* out) { *out << rig.name; }

class ForeignRigs : public testing::TestWithParam<ForeignRig> {};

TEST_P(ForeignRigs, are_densified_with_the_default_settings) {
  const ForeignRig& rig = GetParam();
  const TestFolder folder;
  simulate(folder, rig.changes);
  densify(folder);
  const auto scans = with_label(observations_of(folder / "out.rawlog"), rig.label + "_VIRTUAL");
  EXPECT_GE(scans.size(), 3U);
  for (const Logged& scan : scans)
    EXPECT_GT(scan_from_observation(*scan.observation).value().size(), 2000U);
  const auto errors = errors_to_truth(folder)[rig.figure];
  EXPECT_GE(errors["count"], scans.size());
  EXPECT_LT(errors["mean"], rig.max_static_m);
}

INSTANTIATE_TEST_SUITE_P(
    Rigs, ForeignRigs,
    testing::Values(
        ForeignRig{"no_poses", "[ego_poses]\nkind = none\n", "LIDAR", 0.05},
        ForeignRig{"odometry", "[ego_poses]\nkind = odometry\n"},
        ForeignRig{"gnss", "[ego_poses]\nkind = gnss\n"},
        ForeignRig{"slow_poses", "[ego_poses]\nrate_hz = 10\n"},
        ForeignRig{"rings_16", "[lidar]\nrings = 16\n"},
        ForeignRig{"rings_128", "[lidar]\nrings = 128\n"},
        ForeignRig{"distorted",
                   "[camera.CAM0]\ndistortion_model = plumb_bob\n"
                   "distortion = -0.2 0.05 0.001 -0.001 0 0 0 0\n"},
        ForeignRig{"camera_15_hz", "[camera.CAM0]\nrate_hz = 15\nphase_s = 0.0371\n"},
        ForeignRig{"other_labels", "[lidar]\nlabel = TOP_LIDAR\n[camera.CAM0]\nlabel = front\n",
                   "TOP_LIDAR"},
        ForeignRig{"point_clouds", "[log]\ncarrier = pointcloud\n", "LIDAR", 0.02,
                   // Without rings and columns, points of the scene cannot be told apart.
                   "static_objects_m"},
        ForeignRig{"lidar_turned", "[lidar]\norientation_deg = 90 0 0\nposition_m = 0.5 0.1 1.9\n"},
        ForeignRig{"two_cameras",
                   "[camera.BACK]\nwidth = 414\nheight = 125\n"
                   "orientation_deg = 180 0 0\nposition_m = -1 0 1.6\n"}),
    [](const auto& test) { return test.param.name; });

struct CarrierCase {
  std::string input, setting, output_class;
};

void PrintTo(const CarrierCase& carrier, std::ostream* out) {
  *out << carrier.input << " to " << carrier.setting;
}

class Carriers : public testing::TestWithParam<CarrierCase> {};

TEST_P(Carriers, virtual_scans_travel_as_they_are_told_to) {
  const CarrierCase& carrier = GetParam();
  const TestFolder folder;
  simulate(folder, "[scenario]\nduration_s = 0.12\n[log]\ncarrier = " + carrier.input + "\n");
  densify(folder, "--set carrier=" + carrier.setting);
  const auto out = observations_of(folder / "out.rawlog");
  const auto scans = with_label(out, "LIDAR_VIRTUAL");
  ASSERT_EQ(scans.size(), 2U);
  const auto key = scan_from_observation(*with_label(out, "LIDAR").front().observation).value();
  for (const Logged& scan : scans) {
    EXPECT_EQ(scan.observation->GetRuntimeClass()->className, carrier.output_class);
    const LidarScan points = scan_from_observation(*scan.observation).value();
    EXPECT_EQ(points.size(), key.size());
    EXPECT_EQ(points.intensity.size(), key.size());
    EXPECT_TRUE(points.T_vehicle_lidar.isApprox(key.T_vehicle_lidar, 1e-9));
  }
}

const std::string kRangeScan = "mrpt::obs::CObservation3DRangeScan";
const std::string kPointCloud = "mrpt::obs::CObservationPointCloud";

INSTANTIATE_TEST_SUITE_P(Carriers, Carriers,
                         testing::Values(CarrierCase{"pointcloud", "pointcloud", kPointCloud},
                                         CarrierCase{"pointcloud", "same", kPointCloud},
                                         CarrierCase{"pointcloud", "3drangescan", kRangeScan},
                                         CarrierCase{"3drangescan", "same", kRangeScan},
                                         CarrierCase{"3drangescan", "pointcloud", kPointCloud}),
                         [](const auto& test) {
                           return test.param.input + "_" + test.param.setting;
                         });

TEST(Carriers, the_automatic_one_is_the_same_for_any_input) {
  std::vector<std::string> classes;
  for (const char* const input : {"pointcloud", "3drangescan"}) {
    const TestFolder folder;
    simulate(folder,
             std::string("[scenario]\nduration_s = 0.04\n[log]\ncarrier = ") + input + "\n");
    densify(folder, "--set carrier=auto");
    const auto scans = with_label(observations_of(folder / "out.rawlog"), "LIDAR_VIRTUAL");
    ASSERT_EQ(scans.size(), 1U);
    classes.emplace_back(scans[0].observation->GetRuntimeClass()->className);
  }
  EXPECT_EQ(classes[0], classes[1]);
}

}  // namespace
}  // namespace lidar_upsampling
