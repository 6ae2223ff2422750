// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement3D.h>
#include <mrpt/obs/CObservationOdometry.h>

#include <cmath>

#include "end_to_end/bad_observations.h"
#include "plugin/live_run.h"
#include "plugin/observed.h"

namespace lidar_upsampling {
namespace {

using mrpt::obs::CObservationOdometry;

// Settings in which the sensor's defaults differ from rawlog-densify's.
constexpr const char* kAsLive = "--set resample=none --set points.max_points_per_object=80 ";

/// A log played through the sensor against the same log densified by rawlog-densify.
class PlayedLog : public testing::Test {
 protected:
  void play(const std::string& lines = {}, const std::string& sections = {}) {
    LiveRun live(playing(folder_, "0") + "\n" + lines, sections);
    const std::string reason = live.run_to_end();
    EXPECT_TRUE(contains(reason, "played to its end")) << reason;
    for (const auto& observation : live.all)
      if (observation->sensorLabel != kFiller)
        all_.push_back({observation, entry_of(observation).bytes});
  }

  void expect_as_densified(const std::string& options = {}) {
    expect_done(std::string(RAWLOG_DENSIFY) + " --input " + folder_ / "in.rawlog" + " --output " +
                folder_ / "out.rawlog" + " --report " + folder_ / "report.json" + " " + kAsLive +
                options);
    const auto expected = observations_of(folder_ / "out.rawlog");
    const auto found = without_label(all_, "ACTIONS");
    ASSERT_EQ(found.size(), expected.size());
    EXPECT_GE(with_label(found, "LIDAR_VIRTUAL").size(), 4U);
    for (std::size_t i = 0; i < found.size(); ++i)
      EXPECT_TRUE(found[i].bytes == expected[i].bytes) << i << ": " << expected[i].label();
  }

  [[nodiscard]] std::string ego_source() const {
    std::ifstream file(folder_ / "report.json");
    return nlohmann::json::parse(file)["ego_motion"];
  }

  TestFolder folder_;
  std::vector<Logged> all_;
};

constexpr const char* kShort = "[scenario]\nduration_s = 0.2\n";
const std::string kActionsOnly = "[log]\nformat = sensory_frames\n[ego_poses]\nkind = none\n";

// Of a log with nothing but actions: their sum, before each frame.
void expect_odometry(const std::vector<Logged>& all) {
  const auto odometry = with_label(all, "ACTIONS");
  ASSERT_EQ(odometry.size(), 13U);  // frames: an image in each
  for (std::size_t i = 0; i + 1 < all.size(); ++i)
    if (all[i].label() == "ACTIONS") {
      EXPECT_EQ(all[i].stamp(), all[i + 1].stamp());
      EXPECT_NE(all[i + 1].label(), "LIDAR_VIRTUAL");
    }
  const auto& last = dynamic_cast<CObservationOdometry&>(*odometry.back().observation);
  EXPECT_NEAR(last.odometry.x(), 3.2, 0.05);  // 0.4 s at 8 m/s
  EXPECT_NEAR(last.odometry.y(), 0, 0.05);
}

TEST_F(PlayedLog, with_actions_is_densified_by_them_and_comes_out_with_odometry_in_their_place) {
  simulate(folder_, kActionsOnly);
  play();
  expect_as_densified();
  EXPECT_EQ(ego_source(), "odometry");
  expect_odometry(all_);
}

TEST_F(PlayedLog, with_odometry_in_its_frames_gets_none_of_the_actions_beside_it) {
  simulate(folder_,
           "[log]\nformat = sensory_frames\n[ego_poses]\nkind = odometry\n" + std::string(kShort));
  play();
  EXPECT_TRUE(with_label(all_, "ACTIONS").empty());
  EXPECT_EQ(without_label(all_, "LIDAR_VIRTUAL").size(),
            observations_of(folder_ / "in.rawlog").size());
}

TEST_F(PlayedLog, with_an_action_that_is_no_movement_still_comes_out_whole) {
  mrpt::obs::CActionRobotMovement3D broken;
  broken.poseChange.mean.x(std::nan(""));
  mrpt::obs::CActionCollection actions;
  actions.insert(broken);
  RawlogWriter writer(folder_ / "in.rawlog", false);
  for (const double ms : {0., 33.}) {
    mrpt::obs::CSensoryFrame frame;
    frame.insert(observed("OTHER", ms));
    writer.write(actions);
    writer.write(frame);
  }
  writer.commit();
  play();
  ASSERT_EQ(all_.size(), 4U);
  for (const std::size_t i : {0, 2}) {
    EXPECT_EQ(all_[i].label(), "ACTIONS");
    EXPECT_NE(all_[i + 1].label(), "ACTIONS");
  }
}

TEST_F(PlayedLog, of_raw_velodyne_packets_is_densified_too) {
  simulate(folder_, kActionsOnly + kShort + "[log]\ncarrier = velodyne\n");
  play();
  expect_as_densified();
}

TEST_F(PlayedLog, is_densified_by_the_poses_of_a_file_in_place_of_its_own) {
  simulate(folder_, kShort);
  // Half as fast as it is true.
  std::ofstream(folder_ / "slow.tum") << "1767225599 0 0 0 0 0 0 1\n1767225602 12 0 0 0 0 0 1\n";
  const std::string path = folder_ / "slow.tum";
  play({},
       "[ego_motion]\nrawlog-grabber-ignore = true\nmax_interpolation_gap_s = 5\n"
       "poses_file = " +
           path + "\n");
  expect_as_densified("--poses " + path + " --set ego_motion.max_interpolation_gap_s=5");
}

TEST_F(PlayedLog, is_annotated_as_by_rawlog_densify) {
  simulate(folder_, kActionsOnly + kShort);
  play("annotate = 1");
  expect_as_densified("--set annotate=1");
  EXPECT_EQ(with_label(all_, "LIDAR_OBJECTS").size(), with_label(all_, "LIDAR_VIRTUAL").size());
}

TEST_F(PlayedLog, with_a_pose_file_that_does_not_fit_does_not_start) {
  simulate(folder_, kShort);
  std::ofstream(folder_ / "old.tum") << "5 0 0 0 0 0 0 1\n6 0 0 0 0 0 0 1\n";
  try {
    play({}, "[ego_motion]\nposes_file = " + folder_ / "old.tum" + "\n");
    FAIL() << "it started";
  } catch (const std::exception& error) {
    EXPECT_TRUE(contains(error.what(), "poses are of another time")) << error.what();
  }
}

TEST_F(PlayedLog, with_bad_observations_of_all_kinds_is_passed_on_whole_and_densified) {
  write_hand_made(folder_ / "good.rawlog");
  std::vector<RawlogEntry> all = read_log(folder_ / "good.rawlog");
  for (const BadObservation& bad : bad_observations())
    if (!bad.spoil || bad.label == "POSE") all = spoilt(all, bad);
  write_entries(folder_ / "in.rawlog", all);
  play();
  const auto real = without_label(all_, "LIDAR_VIRTUAL");
  ASSERT_EQ(real.size(), all.size());
  for (std::size_t i = 0; i < real.size(); ++i) EXPECT_EQ(real[i].bytes, all[i].bytes) << i;
  EXPECT_EQ(all_.size() - real.size(), 6U);
}

}  // namespace
}  // namespace lidar_upsampling
