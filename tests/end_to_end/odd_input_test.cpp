// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <filesystem>

#include "hand_made_log.h"
#include "io/small_logs.h"
#include "pipeline.h"

namespace fs = std::filesystem;

namespace lidar_upsampling {
namespace {

/// Rewrites in.rawlog with each observation as a function leaves it, as often as it says.
void write_changed(const TestFolder& folder,
                   const std::function<int(mrpt::obs::CObservation&, int)>& change) {
  write_hand_made(folder / "made.rawlog");
  RawlogWriter writer(folder / "in.rawlog", true);
  std::map<std::string, int> number;
  for (const RawlogEntry& entry : read_log(folder / "made.rawlog")) {
    auto observation = std::dynamic_pointer_cast<mrpt::obs::CObservation>(entry.object);
    const int times = change(*observation, number[observation->sensorLabel]++);
    for (int i = 0; i < times; ++i) writer.write(*observation);
  }
  writer.commit();
}

/// The line of the summary that has these words; none or several are an error.
std::string warning_with(const std::string& words, const TestFolder& folder,
                         const std::string& more = "") {
  const ToolResult result =
      run(densify_command(folder / "in.rawlog", folder / "out.rawlog", "--overwrite " + more));
  EXPECT_EQ(result.status, 0) << result.text;
  std::istringstream lines(result.text);
  std::string found;
  for (std::string line; std::getline(lines, line);)
    if (line.rfind("warning (", 0) == 0 && contains(line, words)) {
      EXPECT_TRUE(found.empty()) << result.text;
      found = line;
    }
  EXPECT_FALSE(found.empty()) << result.text;
  return found;
}

bool has_warning(const std::string& more, const TestFolder& folder) {
  return contains(
      run(densify_command(folder / "in.rawlog", folder / "out.rawlog", "--overwrite " + more)).text,
      "warning");
}

TEST(OddInput, labels_with_slashes_go_into_names_of_pictures) {
  const TestFolder folder;
  write_changed(folder, [](mrpt::obs::CObservation& observation, int) {
    if (observation.sensorLabel == "CAM") observation.sensorLabel = "/cam/left";
    return 1;
  });
  densify(folder, "--pictures " + folder / "pictures");
  EXPECT_TRUE(fs::exists(folder / "pictures/0000__cam_left.png"));
  expect_done(std::string(RAWLOG_DENSIFY) + " --check --input " + folder / "in.rawlog" +
              " --pictures " + folder / "check");
  EXPECT_TRUE(fs::exists(folder / "check/overlay__cam_left.png"));
}

TEST(OddInput, a_pipe_that_would_be_read_twice_is_refused_at_once) {
  const TestFolder folder;
  write_hand_made(folder / "in.rawlog");
  densify(folder);
  const std::string pipe = folder / "pipe.rawlog";
  ASSERT_EQ(run("mkfifo " + pipe).status, 0);
  for (const std::string& command : {std::string(RAWLOG_DENSIFY) + " --check --input " + pipe,
                                     std::string(RAWLOG_EVALUATE) + " --reference " + pipe +
                                         " --input " + folder / "out.rawlog"}) {
    const ToolResult result = run_for_errors("timeout 60 " + command);
    EXPECT_EQ(result.status, 1) << command;
    EXPECT_TRUE(contains(result.text, "pipe")) << result.text;
  }
}

TEST(OddInput, missing_images_are_one_warning_however_many) {
  const TestFolder folder;
  write_changed(folder, [](mrpt::obs::CObservation& observation, int number) {
    if (auto* const image = dynamic_cast<mrpt::obs::CObservationImage*>(&observation))
      if (number == 4 || number == 5)
        image->image.setExternalStorage("lost" + std::to_string(number) + ".png");
    return 1;
  });
  const std::string line = warning_with("image", folder);
  EXPECT_TRUE(contains(line, "warning (2x)")) << line;
  EXPECT_TRUE(contains(line, "lost4.png")) << line;
}

TEST(OddInput, a_log_that_gives_no_virtual_scan_is_told_with_the_likely_cause) {
  const TestFolder folder;
  write_changed(folder, [](mrpt::obs::CObservation& observation, int number) {
    return observation.sensorLabel == "CAM" && number % 3 != 0 ? 0 : 1;
  });
  EXPECT_TRUE(contains(warning_with("no virtual scan", folder), "faster than the LiDAR"));
}

TEST(OddInput, images_that_are_there_twice_are_used_once) {
  const TestFolder folder;
  write_changed(folder, [](mrpt::obs::CObservation& observation, int) {
    return observation.sensorLabel == "CAM" ? 2 : 1;
  });
  EXPECT_TRUE(contains(warning_with("twice", folder), "warning (10x)"));
  EXPECT_EQ(with_label(observations_of(folder / "out.rawlog"), "LIDAR_VIRTUAL").size(), 6U);
}

TEST(OddInput, a_clock_that_jumps_is_counted) {
  for (const double jump_s : {-0.15, 3600.}) {
    const TestFolder folder;
    write_changed(folder, [&](mrpt::obs::CObservation& observation, int number) {
      if (observation.sensorLabel == "LIDAR" && number == 1)
        observation.timestamp = shifted(observation.timestamp, jump_s);
      return 1;
    });
    const std::string line = warning_with("clock jumps", folder);
    EXPECT_TRUE(contains(line, "'LIDAR'")) << line;
  }
}

TEST(OddInput, settings_and_boxes_of_labels_that_are_not_there_are_told) {
  const TestFolder folder;
  write_hand_made(folder / "in.rawlog");
  EXPECT_FALSE(has_warning("--set camera.CAM.fx_px=90", folder));
  const std::string line = warning_with("[camera.CAN]", folder, "--set camera.CAN.fx_px=90");
  EXPECT_TRUE(contains(line, "CAM")) << line;
  EXPECT_TRUE(contains(
      warning_with("[lidar.LADAR]", folder, "--set 'lidar.LADAR.pose=0 0 1 0 0 0'"), "LIDAR"));
  std::ofstream(folder / "boxes.csv") << "CAN,132000000000000000,car,1,1,1,9,9\n";
  EXPECT_TRUE(contains(warning_with("boxes of CAN", folder, "--detections " + folder / "boxes.csv"),
                       "CAM"));
  std::ofstream(folder / "boxes.csv") << "label,stamp,class,score,left,top,right,bottom\n";
  EXPECT_TRUE(
      contains(warning_with("no boxes", folder, "--detections " + folder / "boxes.csv"), "csv"));
}

TEST(OddInput, boxes_with_other_stamps_than_the_images_are_told) {
  const TestFolder folder;
  write_hand_made(folder / "in.rawlog");
  std::ofstream(folder / "boxes.csv") << "CAM,132000000000000000,car,1,1,1,9,9\n";
  EXPECT_TRUE(
      contains(warning_with("no object was met", folder, "--detections " + folder / "boxes.csv"),
               "boxes.csv"));
}

TEST(OddInput, a_setting_without_a_name_is_refused) {
  const TestFolder folder;
  write_hand_made(folder / "in.rawlog");
  for (const std::string setting : {".mode=x", "mode", "=x", "klt.=3"}) {
    const ToolResult result =
        run_for_errors(std::string(RAWLOG_DENSIFY) + " --input " + folder / "in.rawlog" +
                       " --output " + folder / "out.rawlog" + " --set " + setting);
    EXPECT_EQ(result.status, 1) << setting;
    EXPECT_TRUE(contains(result.text, "expected name=value")) << result.text;
  }
}

TEST(OddInput, a_settings_file_is_refused_with_its_line) {
  const TestFolder folder;
  write_hand_made(folder / "in.rawlog");
  const auto expect_refused = [&](const std::string& text, const std::string& words) {
    std::ofstream(folder / "bad.ini") << text;
    const ToolResult result =
        run_for_errors(std::string(RAWLOG_DENSIFY) + " --input " + folder / "in.rawlog" +
                       " --output " + folder / "out.rawlog" + " --config " + folder / "bad.ini");
    EXPECT_EQ(result.status, 1);
    EXPECT_TRUE(contains(result.text, "bad.ini:" + words)) << result.text;
    EXPECT_FALSE(fs::exists(folder / "out.rawlog"));
  };
  expect_refused("mode = offline\n", "1: mode stands before any [section]");
  expect_refused("[lidar_upsampling]\nmode offline\n", "2: 'mode offline'");
  expect_refused("[timing\n", "1: '[timing'");
  expect_refused("[klt]\nwindow_px = 15\nwindow_px = 17\n", "3: [klt] window_px");
  expect_refused("[klt]\n\nwindow_px = wide\n", "3: [klt] window_px");
  expect_refused("\n[kl]\n", "2: [kl]");
}

TEST(OddInput, an_input_may_stand_by_itself_and_a_misspelt_option_is_answered_with_the_nearest) {
  const TestFolder folder;
  write_hand_made(folder / "in.rawlog");
  expect_done(std::string(RAWLOG_DENSIFY) + " " + folder / "in.rawlog" + " -o " +
              folder / "out.rawlog");
  expect_done(std::string(RAWLOG_DECIMATE) + " " + folder / "in.rawlog" + " -o " +
              folder / "thin.rawlog" + " --label LIDAR --keep-every 2");
  const ToolResult result = run(std::string(RAWLOG_DENSIFY) + " --inptu " + folder / "in.rawlog" +
                                " -o " + folder / "other.rawlog");
  EXPECT_EQ(result.status, 2);
  EXPECT_TRUE(contains(result.text, "--inptu: there is no such option; did you mean --input?"))
      << result.text;
}

}  // namespace
}  // namespace lidar_upsampling
