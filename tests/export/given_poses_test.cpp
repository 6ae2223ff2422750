// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <iomanip>

#include "end_to_end/pipeline.h"
#include "lidar_upsampling/ego/pose_file.h"
#include "lidar_upsampling/io/carriers.h"
#include "lidar_upsampling/io/images.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling {
namespace {

// The simulator's own table of true poses is the source of all files here.
class GivenPoses : public ::testing::Test {
 protected:
  void SetUp() override { simulate(folder_); }
  [[nodiscard]] std::string path(const std::string& name) const { return folder_ / name; }

  [[nodiscard]] std::vector<PoseSample> truth() const {
    PoseFileOptions options;
    options.path = path("in_ego.csv");
    return read_pose_file(options, {}, Pose::Identity());
  }
  [[nodiscard]] std::vector<LidarScan> densified(const std::string& options) const {
    expect_done(densify_command(path("in.rawlog"), path("out.rawlog"),
                                "--overwrite --set resample=none " + options));
    std::vector<LidarScan> scans;
    for (const Logged& logged : with_label(observations_of(path("out.rawlog")), "LIDAR_VIRTUAL"))
      scans.push_back(*scan_from_observation(*logged.observation));
    return scans;
  }
  [[nodiscard]] std::string error(const std::string& options) const {
    const ToolResult result = run(densify_command(path("in.rawlog"), path("out.rawlog"),
                                                  "--overwrite --set resample=none " + options));
    EXPECT_EQ(result.status, 1) << result.text;
    return result.text;
  }
  [[nodiscard]] Pose T_vehicle_camera() const {
    mrpt::poses::CPose3D pose;
    with_label(observations_of(path("in.rawlog")), "CAM0").at(0).observation->getSensorPose(pose);
    return from_mrpt(pose);
  }

 private:
  TestFolder folder_;
};

void expect_same(const std::vector<LidarScan>& a, const std::vector<LidarScan>& b) {
  ASSERT_EQ(a.size(), b.size());
  ASSERT_FALSE(a.empty());
  for (std::size_t k = 0; k < a.size(); ++k) {
    ASSERT_EQ(a[k].size(), b[k].size());
    std::size_t num_far = 0;
    for (std::size_t i = 0; i < a[k].size(); ++i)
      if ((a[k].points[i] - b[k].points[i]).norm() > 1e-3F) ++num_far;
    EXPECT_LT(static_cast<double>(num_far), 0.01 * static_cast<double>(a[k].size())) << k;
  }
}

TEST_F(GivenPoses, of_a_table_densify_as_those_of_the_log) {
  expect_same(densified("--poses " + path("in_ego.csv")), densified(""));
}

TEST_F(GivenPoses, of_tum_densify_as_those_of_the_log) {
  std::ofstream file(path("poses.tum"));
  file << std::setprecision(12);
  for (const PoseSample& sample : truth()) {
    const Eigen::Quaterniond q(sample.T_world_vehicle.linear());
    const Eigen::Vector3d& t = sample.T_world_vehicle.translation();
    file << to_text(sample.stamp) << ' ' << t.x() << ' ' << t.y() << ' ' << t.z() << ' ' << q.x()
         << ' ' << q.y() << ' ' << q.z() << ' ' << q.w() << '\n';
  }
  file.close();
  expect_same(densified("--poses " + path("poses.tum")), densified(""));
}

TEST_F(GivenPoses, of_kitti_are_those_of_the_camera_at_the_given_times) {
  std::ofstream file(path("poses.txt")), times(path("times.txt"));
  file << std::setprecision(12);
  const auto samples = truth();
  for (const PoseSample& sample : samples) {
    const Pose T = sample.T_world_vehicle * T_vehicle_camera();
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 4; ++column) file << T(row, column) << ' ';
    file << '\n';
    times << seconds_between(samples.front().stamp, sample.stamp) << '\n';
  }
  file.close();
  times.close();
  expect_same(densified("--poses " + path("poses.txt") +
                        " --set ego_motion.poses_times=" + path("times.txt")),
              densified(""));
}

// They are wrong, so that they must be taken at their word.
TEST_F(GivenPoses, take_the_place_of_the_logs_own) {
  std::ofstream(path("standing.tum")) << "1767225599 0 0 0 0 0 0 1\n1767225602 0 0 0 0 0 0 1\n";
  const auto standing =
      densified("--poses " + path("standing.tum") + " --set ego_motion.max_interpolation_gap_s=5" +
                " --set ego_motion.fuse=false");
  const auto real = *scan_from_observation(
      *with_label(observations_of(path("in.rawlog")), "LIDAR").at(0).observation);
  std::size_t num_unmoved = 0;
  for (std::size_t i = 0; i < std::min(real.size(), standing.at(0).size()); ++i)
    if ((real.points[i] - standing[0].points[i]).norm() < 1e-3F) ++num_unmoved;
  EXPECT_GT(static_cast<double>(num_unmoved), 0.8 * static_cast<double>(real.size()));
}

TEST_F(GivenPoses, that_do_not_fit_are_refused_with_what_is_wrong) {
  std::ofstream(path("old.tum")) << "5 0 0 0 0 0 0 1\n6 0 0 0 0 0 0 1\n";
  EXPECT_TRUE(contains(error("--poses " + path("old.tum")), "poses are of another time"));
  EXPECT_TRUE(contains(error("--poses " + path("none.tum")), "cannot read this file of poses"));
  EXPECT_TRUE(contains(error("--poses " + path("in_ego.csv") + " --set ego_motion.poses_of=TOP"),
                       "nothing is labelled 'TOP'"));
  EXPECT_TRUE(contains(error("--poses " + path("in_ego.csv") + " --set ego_motion.source=gnss"),
                       "needs source = poses or auto"));
}

}  // namespace
}  // namespace lidar_upsampling
