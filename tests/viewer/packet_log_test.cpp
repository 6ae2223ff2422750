// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationRotatingScan.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

#include "end_to_end/hand_made_log.h"
#include "end_to_end/pipeline.h"
#include "io/velodyne_packets.h"
#include "lidar_upsampling/compat/mrpt.h"

namespace lidar_upsampling {
namespace {

using mrpt::obs::CObservationRotatingScan;
using mrpt::obs::CObservationVelodyneScan;

/// A vehicle at rest in a round hall, with a VLP-16 on its roof.
CObservationVelodyneScan hall(int image) {
  auto packets = velodyne_packets(hand_made_stamp(image), [](double sine) {
    const double to_wall = 8 / std::sqrt(1 - sine * sine);
    return sine < 0 ? std::min(to_wall, 1.7 / -sine) : to_wall;
  });
  packets.sensorPose = mrpt::poses::CPose3D(0, 0, 1.7, 0, 0, 0);
  return packets;
}

CObservationRotatingScan rotating(const CObservationVelodyneScan& packets) {
  CObservationRotatingScan scan;
  scan.fromVelodyne(packets);
  scan.sensorLabel = packets.sensorLabel;
  scan.timestamp = packets.timestamp;
  scan.sensorPose = packets.sensorPose;
  return scan;
}

struct Spinning {
  std::string name;
  bool as_packets;
  std::string carrier, output_class;
};

void PrintTo(const Spinning& spinning, std::ostream* out) { *out << spinning.name; }

class SpinningLogs : public testing::TestWithParam<Spinning> {
 protected:
  void SetUp() override {
    RawlogWriter writer(folder_ / "in.rawlog", false);
    for (int i = 0; i < 10; ++i) {
      mrpt::obs::CObservationRobotPose pose;
      pose.sensorLabel = "POSE";
      pose.timestamp = hand_made_stamp(i);
      writer.write(pose);
      if (i % 3 == 0 && GetParam().as_packets) writer.write(hall(i));
      if (i % 3 == 0 && !GetParam().as_packets) writer.write(rotating(hall(i)));
      writer.write(*observation_from_image(still_picture({}, i)));
    }
    writer.commit();
    densify(folder_, "--set resample=none --set carrier=" + GetParam().carrier);
  }

  TestFolder folder_;
};

TEST_P(SpinningLogs, are_densified_with_the_points_they_show) {
  const auto out = observations_of(folder_ / "out.rawlog");
  const auto scans = with_label(out, "VLP_VIRTUAL");
  ASSERT_EQ(scans.size(), 6U);
  const LidarScan key = scan_from_observation(*with_label(out, "VLP").front().observation).value();
  ASSERT_GT(key.size(), 7000U);
  for (const Logged& logged : scans) {
    EXPECT_EQ(logged.observation->GetRuntimeClass()->className, GetParam().output_class);
    const LidarScan scan = scan_from_observation(*logged.observation).value();
    ASSERT_EQ(scan.size(), key.size());
    for (std::size_t i = 0; i < key.size(); ++i) {
      ASSERT_LT((scan.points[i] - key.points[i]).norm(), 0.002F) << i;  // it stands
    }
    EXPECT_EQ(scan.ring, key.ring);
    EXPECT_TRUE(scan.T_vehicle_lidar.isApprox(key.T_vehicle_lidar, 1e-9));
  }
}

const std::string kAutomatic = "mrpt::obs::CObservation3DRangeScan";
const std::string kOfPackets =
    compat::kVelodyneLosesPoints ? kAutomatic : "mrpt::obs::CObservationVelodyneScan";

INSTANTIATE_TEST_SUITE_P(
    Carriers, SpinningLogs,
    testing::Values(Spinning{"packets_to_auto", true, "auto", kAutomatic},
                    Spinning{"packets_to_same", true, "same", kOfPackets},
                    Spinning{"range_picture_to_auto", false, "auto", kAutomatic},
                    Spinning{"range_picture_to_same", false, "same", kAutomatic}),
    [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace lidar_upsampling
