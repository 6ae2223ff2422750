// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationPointCloud.h>

#include "lidar_upsampling/io/carriers.h"
#include "lidar_upsampling/io/images.h"
#include "stock_maps.h"

namespace lidar_upsampling {
namespace {

/// The key scan's own points, moved, as figures and carriers are checked point by point.
constexpr const char* kOwnPoints = "--set resample=none ";

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
  densify(folder, kOwnPoints);
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
  densify(folder, kOwnPoints + std::string("--set carrier=") + carrier.setting);
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

using mrpt::obs::CObservation3DRangeScan;

const CObservation3DRangeScan& depth_image(const Logged& logged) {
  return dynamic_cast<const CObservation3DRangeScan&>(*logged.observation);
}

/// Pixels of a virtual depth image against the one that the camera would have taken.
struct DepthAgreement {
  int num_true = 0;  ///< returns
  int num_both = 0, num_close = 0;
};

DepthAgreement agreement(const CObservation3DRangeScan& made,
                         const CObservation3DRangeScan& truth) {
  DepthAgreement result;
  for (int row = 0; row < truth.rangeImage.rows(); ++row) {
    for (int column = 0; column < truth.rangeImage.cols(); ++column) {
      const int expected = truth.rangeImage(row, column), depth = made.rangeImage(row, column);
      result.num_true += expected != 0;
      if (expected == 0 || depth == 0) continue;
      ++result.num_both;
      result.num_close += std::abs(depth - expected) < 0.02 * expected;
    }
  }
  return result;
}

class DepthCameras : public testing::TestWithParam<std::string> {};

TEST_P(DepthCameras, get_the_depth_images_they_would_have_taken) {
  const TestFolder folder;
  simulate(folder, "[ego]\nspeed_mps = 4\n[vehicle.lead]\nx_m = 9\nspeed_mps = 1\n", kDepthCamera);
  densify(folder, kOwnPoints + std::string("--set carrier=") + GetParam());
  const auto out = observations_of(folder / "out.rawlog");
  const auto reals = with_label(out, "DEPTH");
  const CObservation3DRangeScan& real = depth_image(reals.front());
  const auto truths = with_label(observations_of(folder / "truth.rawlog"), "DEPTH");
  const auto scans = with_label(out, "DEPTH_VIRTUAL");
  ASSERT_EQ(scans.size(), 8U);
  for (const Logged& scan : scans) {
    const CObservation3DRangeScan& made = depth_image(scan);
    EXPECT_EQ(made.cameraParams.intrinsicParams, real.cameraParams.intrinsicParams);
    EXPECT_EQ(made.rangeUnits, real.rangeUnits);
    EXPECT_TRUE(from_mrpt(made.sensorPose).isApprox(from_mrpt(real.sensorPose), 1e-9));
    EXPECT_EQ(made.hasPoints3D, GetParam() == "auto");  // for maps
    ASSERT_TRUE(made.hasRangeImage);
    ASSERT_EQ(made.rangeImage.rows(), real.rangeImage.rows());
    ASSERT_EQ(made.rangeImage.cols(), real.rangeImage.cols());
    const auto truth = std::find_if(truths.begin(), truths.end(), [&](const Logged& logged) {
      return logged.stamp() == scan.stamp();
    });
    ASSERT_NE(truth, truths.end());
    const DepthAgreement found = agreement(made, depth_image(*truth));
    EXPECT_GT(found.num_true, 5000);
    EXPECT_GT(found.num_both, 0.9 * found.num_true);
    EXPECT_GT(found.num_close, 0.92 * found.num_both);  // a copy: 0.66 to 0.91
  }
}

INSTANTIATE_TEST_SUITE_P(Carriers, DepthCameras, testing::Values("auto", "same"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace lidar_upsampling
