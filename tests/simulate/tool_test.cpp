// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace {

struct Outcome {
  int status = -1;
  std::string output;  ///< stdout and stderr
};

Outcome run(const std::string& command) {
  Outcome outcome;
  FILE* const pipe = popen((command + " 2>&1").c_str(), "r");
  std::array<char, 4096> buffer{};
  for (std::size_t n = 0; (n = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) {
    outcome.output.append(buffer.data(), n);
  }
  outcome.status = WEXITSTATUS(pclose(pipe));
  return outcome;
}

std::string contents(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

class SimulateTool : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] std::string path(const std::string& name) const {
    return (folder_ / name).string();
  }
  [[nodiscard]] Outcome simulate(const std::string& scenario, const std::string& rest) const {
    return run(std::string(RAWLOG_SIMULATE) + " --scenario " + scenario + " " + rest);
  }

  std::string small_ = SCENARIO_FOLDER "/small.ini";

 private:
  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("simulate_test_" + std::to_string(getpid()));
};

TEST_F(SimulateTool, its_log_is_one_that_stock_tools_read) {
  const auto made = simulate(
      small_, "--duration 0.3 --output " + path("s.rawlog") + " --truth " + path("t.rawlog"));
  ASSERT_EQ(made.status, 0) << made.output;
  const auto info = run("rawlog-edit --info -i " + path("s.rawlog"));
  EXPECT_NE(info.output.find("CAM0, LIDAR, POSE"), std::string::npos) << info.output;
  EXPECT_NE(info.output.find("number of objects         : 45"), std::string::npos) << info.output;
  const auto truth = run("rawlog-edit --info -i " + path("t.rawlog"));
  EXPECT_NE(truth.output.find("GT, LIDAR"), std::string::npos) << truth.output;
  EXPECT_NE(truth.output.find("number of objects         : 20"), std::string::npos) << truth.output;
  for (const char* const table : {"s_objects.csv", "s_ego.csv", "s_boxes.csv"}) {
    EXPECT_GT(contents(path(table)).size(), 200U) << table;
  }
}

TEST_F(SimulateTool, the_same_seed_gives_the_same_bytes) {
  for (const char* const name : {"a.rawlog", "b.rawlog"}) {
    ASSERT_EQ(simulate(small_, "--duration 0.07 --seed 4 --output " + path(name)).status, 0);
  }
  ASSERT_EQ(simulate(small_, "--duration 0.07 --seed 5 --output " + path("c.rawlog")).status, 0);
  EXPECT_EQ(contents(path("a.rawlog")), contents(path("b.rawlog")));
  EXPECT_EQ(contents(path("a_objects.csv")), contents(path("b_objects.csv")));
  EXPECT_NE(contents(path("a.rawlog")), contents(path("c.rawlog")));
}

TEST_F(SimulateTool, without_a_seed_the_situation_is_as_written_and_a_seed_draws_another) {
  ASSERT_EQ(simulate(small_, "--duration 0 --output " + path("w.rawlog")).status, 0);
  // The scenario's own seed, given on the command line, draws like any other.
  ASSERT_EQ(simulate(small_, "--duration 0 --seed 3 --output " + path("d.rawlog")).status, 0);
  const std::string written = contents(path("w_objects.csv"));
  // The lead is where the INI has it.
  EXPECT_NE(written.find(",car,14.000000,-5.100000,"), std::string::npos) << written;
  EXPECT_NE(written.find(",10.000000,0.000000,0.000000,0.000000,1"), std::string::npos) << written;
  EXPECT_EQ(contents(path("d_objects.csv")).find(",14.000000,-5.100000,"), std::string::npos);
  EXPECT_NE(run(std::string(RAWLOG_SIMULATE) + " --help").output.find("exactly as written"),
            std::string::npos);
}

TEST_F(SimulateTool, a_real_rigs_log_has_told_stamps_and_mounting_and_the_truth_at_those_stamps) {
  const auto exact = contents(small_);
  std::ofstream(path("off.ini")) << exact << "\n[ego_poses]\nnoise_m = 0.05\nlag_ms = 10\n";
  std::string jitter = exact;
  jitter.replace(jitter.find("[camera.CAM0]"), 13,
                 "[camera.CAM0]\ntime_jitter_ms = 2\ncalibration_error_deg = 0.5");
  std::ofstream(path("jitter.ini")) << jitter;
  for (const char* const name : {"off", "jitter"}) {
    const auto made = simulate(path(name + std::string(".ini")),
                               "--duration 0.1 --output " + path(name + std::string(".rawlog")));
    ASSERT_EQ(made.status, 0) << made.output;
  }
  ASSERT_EQ(simulate(small_, "--duration 0.1 --output " + path("exact.rawlog")).status, 0);
  // The ego's truth has nothing to do with what the log tells of it.
  EXPECT_EQ(contents(path("off_ego.csv")), contents(path("exact_ego.csv")));
  EXPECT_NE(contents(path("off.rawlog")), contents(path("exact.rawlog")));
  // Two scans and four pictures, three of them at stamps of their own.
  const std::string at_told_stamps = contents(path("jitter_ego.csv"));
  EXPECT_GE(std::count(at_told_stamps.begin(), at_told_stamps.end(), '\n'), 5);
  EXPECT_NE(at_told_stamps, contents(path("exact_ego.csv")));
  std::istringstream boxes(contents(path("jitter_boxes.csv")));
  std::string row;
  std::getline(boxes, row);
  while (std::getline(boxes, row)) {
    const auto from = row.find(',') + 1;
    EXPECT_NE(at_told_stamps.find(row.substr(from, row.find(',', from) - from)), std::string::npos);
  }
}

TEST_F(SimulateTool, frames_hold_the_images_and_scans_where_frames_are_asked_for) {
  std::ofstream(path("frames.ini"))
      << contents(small_) << "\n[log]\nformat = sensory_frames\n[ego_poses]\nkind = odometry\n";
  const auto made = simulate(path("frames.ini"), "--duration 0.2 --output " + path("f.rawlog"));
  ASSERT_EQ(made.status, 0) << made.output;
  const auto info = run("rawlog-edit --info -i " + path("f.rawlog"));
  EXPECT_NE(info.output.find("Actions/SensoryFrame format       : Yes"), std::string::npos)
      << info.output;
  EXPECT_NE(info.output.find("number of objects         : 14"), std::string::npos) << info.output;
}

TEST_F(SimulateTool, a_depth_camera_gives_range_pictures_in_log_and_truth) {
  const auto made =
      simulate(SCENARIO_FOLDER "/depth_camera.ini",
               "--duration 0 --output " + path("d.rawlog") + " --truth " + path("t.rawlog"));
  ASSERT_EQ(made.status, 0) << made.output;
  for (const char* const log : {"d.rawlog", "t.rawlog"}) {
    const auto text = run("rawlog-edit --describe -i " + path(log));
    EXPECT_NE(text.output.find("Has raw range data? YES (embedded)"), std::string::npos) << log;
    EXPECT_NE(text.output.find("Has 3D point cloud? NO"), std::string::npos) << log;
    EXPECT_NE(text.output.find("Sensor label: 'DEPTH'"), std::string::npos) << log;
  }
}

TEST_F(SimulateTool, a_failure_is_one_line_and_leaves_nothing_behind) {
  std::ofstream(path("bad.ini")) << "[lidar]\nrngs = 3\n";
  const auto bad = simulate(path("bad.ini"), "--output " + path("o.rawlog"));
  EXPECT_EQ(bad.status, 1);
  EXPECT_NE(bad.output.find("rngs"), std::string::npos) << bad.output;
  EXPECT_EQ(std::count(bad.output.begin(), bad.output.end(), '\n'), 1) << bad.output;
  EXPECT_EQ(simulate(small_, "--duration 0 --output " + path("no/such/o.rawlog")).status, 1);
  EXPECT_EQ(simulate(small_, "").status, 2);

  std::ofstream(path("o_boxes.csv")) << "mine";
  const auto refused = simulate(small_, "--duration 0 --output " + path("o.rawlog"));
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.output.find("--overwrite"), std::string::npos) << refused.output;
  EXPECT_EQ(contents(path("o_boxes.csv")), "mine");
  EXPECT_FALSE(std::filesystem::exists(path("o.rawlog")));
  EXPECT_EQ(simulate(small_, "--duration 0 --overwrite --output " + path("o.rawlog")).status, 0);
}

TEST_F(SimulateTool, a_scenario_is_found_by_its_name_and_a_misspelt_one_is_told_what_there_is) {
  const auto found = simulate("demo", "--duration 0 --output " + path("o.rawlog"));
  EXPECT_EQ(found.status, 0) << found.output;
  const auto misspelt = simulate("deom", "--duration 0 --output " + path("p.rawlog"));
  EXPECT_EQ(misspelt.status, 1);
  EXPECT_NE(misspelt.output.find("did you mean demo?"), std::string::npos) << misspelt.output;
  EXPECT_NE(misspelt.output.find("braking, "), std::string::npos) << misspelt.output;
}

TEST_F(SimulateTool, it_tells_its_version) {
  EXPECT_NE(run(std::string(RAWLOG_SIMULATE) + " --version").output.find("rawlog-simulate 0.1.0"),
            std::string::npos);
}

}  // namespace
