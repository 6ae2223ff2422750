// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "plugin/live_run.h"

namespace lidar_upsampling {
namespace {

using mrpt::obs::CObservation;

bool in_time_order(const std::vector<CObservation::Ptr>& all) {
  return std::is_sorted(all.begin(), all.end(),
                        [](const auto& a, const auto& b) { return a->timestamp < b->timestamp; });
}

std::vector<Stamp> stamps_of(const std::vector<CObservation::Ptr>& all, const std::string& label) {
  std::vector<Stamp> stamps;
  for (const auto& observation : all)
    if (observation->sensorLabel == label) stamps.push_back(observation->timestamp);
  return stamps;
}

constexpr const char* kSecondCamera = R"(
[camera.CAM1]
width = 414
height = 125
position_m = 0.3 0.4 1.6
)";

TEST(Sensor, a_played_log_comes_out_whole_with_the_virtual_scans_that_densifying_it_makes) {
  const TestFolder folder;
  simulate(folder, kSecondCamera);
  densify(folder);
  LiveRun live(playing(folder, "0"));
  EXPECT_TRUE(contains(live.run_to_end(), "in.rawlog: played to its end"));
  const auto expected = with_label(observations_of(folder / "out.rawlog"), "LIDAR_VIRTUAL");
  EXPECT_EQ(stamps_of(live.all, "LIDAR_VIRTUAL"), stamps_of(expected));
  EXPECT_GE(expected.size(), 8U);
  const auto real = observations_of(folder / "in.rawlog");
  EXPECT_EQ(live.all.size(), real.size() + expected.size() + 1);
  EXPECT_EQ(live.all.back()->sensorLabel, kFiller);
  EXPECT_TRUE(in_time_order(live.all));
  const SensorStatistics statistics = live.sensor.statistics();
  EXPECT_EQ(statistics.num_real, real.size());
  EXPECT_EQ(statistics.num_virtual_scans, expected.size());
  EXPECT_EQ(statistics.num_late_images, 0U);
  EXPECT_EQ(statistics.ready.count(), expected.size());
}

TEST(Sensor, a_log_with_sensory_frames_comes_out_observation_by_observation) {
  const TestFolder folder;
  simulate(folder, "[log]\nformat = sensory_frames\n");
  LiveRun live(playing(folder, "0"));
  live.run_to_end();
  EXPECT_EQ(live.sensor.statistics().num_real, observations_of(folder / "in.rawlog").size());
  EXPECT_EQ(live.count("LIDAR_VIRTUAL"), 8U);
  EXPECT_TRUE(in_time_order(live.all));
}

TEST(Sensor, a_log_is_played_at_the_given_speed) {
  const TestFolder folder;
  simulate(folder);
  const auto start = std::chrono::steady_clock::now();
  LiveRun live(playing(folder, "0.5"));
  live.run_to_end();
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  EXPECT_GE(taken.count(), 0.8);  // for 0.4 s of log
}

TEST(Sensor, it_ends_only_when_all_that_it_handed_out_was_let_go_of) {
  const TestFolder folder;
  simulate(folder);
  LiveRun live("rawlog = " + folder / "in.rawlog" + "\nspeed = 0\nlinger_s = 3600");
  while (live.count(kFiller) == 0) live.process();
  for (int i = 0; i < 10; ++i) live.process();
  live.all.resize(1);
  live.process();
  live.all.clear();
  EXPECT_THROW(live.process(), std::runtime_error);
  EXPECT_EQ(live.sensor.getState(), UpsampledLidarSensor::ssError);
}

TEST(Sensor, a_log_that_breaks_off_is_played_so_far_and_its_defect_is_the_end) {
  const TestFolder folder;
  simulate(folder);
  std::filesystem::resize_file(folder / "in.rawlog",
                               std::filesystem::file_size(folder / "in.rawlog") / 2);
  LiveRun live(playing(folder, "0"));
  const std::string end = live.run_to_end();
  EXPECT_TRUE(contains(end, "in.rawlog")) << end;
  EXPECT_FALSE(contains(end, "played to its end")) << end;
  EXPECT_GT(live.count("CAM0"), 0U);
}

TEST(Sensor, a_densified_log_is_refused) {
  const TestFolder folder;
  simulate(folder);
  densify(folder);
  LiveRun live("rawlog = " + folder / "out.rawlog" + "\nspeed = 0\nlinger_s = 0");
  EXPECT_TRUE(contains(live.run_to_end(), "LIDAR_VIRTUAL"));
}

std::string driver(const TestFolder& folder, const std::string& label, int delay_ms,
                   const std::string& more = {}) {
  return "[" + label + "_DRIVER]\nrawlog-grabber-ignore = true\ndriver = ReplayDriver\n" +
         "process_rate = 500\nlog = " + folder / "in.rawlog" + "\nlabel = " + label +
         "\ndelay_ms = " + std::to_string(delay_ms) + "\n" + more;
}

// A window of this size merges all, however late a busy machine is.
constexpr const char* kThreeDrivers =
    "sources = LIDAR_DRIVER, CAM0_DRIVER, POSE_DRIVER\nmerge_window_ms = 1500\nmax_wait_ms = 1e6\n"
    "linger_s = 0";

TEST(Sensor, drivers_of_different_delay_are_merged_in_time_order) {
  const TestFolder folder;
  simulate(folder);
  const auto real = observations_of(folder / "in.rawlog");
  LiveRun live(kThreeDrivers, driver(folder, "LIDAR", 60) + driver(folder, "CAM0", 15) +
                                  driver(folder, "POSE", 0));
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(2);
  while (live.all.size() < real.size() + 8 && std::chrono::steady_clock::now() < deadline)
    live.process();
  for (const char* label : {"LIDAR", "CAM0", "POSE"})
    EXPECT_EQ(live.count(label), with_label(real, label).size()) << label;
  EXPECT_EQ(live.count("LIDAR_VIRTUAL"), 8U);
  EXPECT_TRUE(in_time_order(live.all));
  EXPECT_EQ(live.sensor.statistics().num_out_of_order, 0U);
  EXPECT_EQ(live.sensor.statistics().num_late_images, 0U);
}

TEST(Sensor, a_driver_that_fails_ends_it_with_its_name_after_what_had_come) {
  const TestFolder folder;
  simulate(folder);
  LiveRun live(kThreeDrivers, driver(folder, "LIDAR", 0) +
                                  driver(folder, "CAM0", 0, "fail_after = 3\n") +
                                  driver(folder, "POSE", 0));
  EXPECT_EQ(live.run_to_end(), "[CAM0_DRIVER]: the cable came off");
  EXPECT_EQ(live.count("CAM0"), 3U);
}

std::string start_up_error(const std::string& lines, const std::string& sections = {}) {
  try {
    const LiveRun live(lines, sections);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "started";
}

TEST(Sensor, sources_that_cannot_be_had_are_named) {
  EXPECT_TRUE(contains(start_up_error("rawlog = /nowhere/in.rawlog"), "/nowhere/in.rawlog"));
  EXPECT_TRUE(contains(start_up_error("sources = FRONT"), "(FRONT)"));
  const std::string no_such_driver =
      start_up_error("sources = FRONT", "[FRONT]\ndriver = NoSuchDriver\nprocess_rate = 1\n");
  EXPECT_TRUE(contains(no_such_driver, "(FRONT)")) << no_such_driver;
  EXPECT_TRUE(contains(no_such_driver, "NoSuchDriver")) << no_such_driver;
}

}  // namespace
}  // namespace lidar_upsampling
