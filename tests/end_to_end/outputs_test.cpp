// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <filesystem>

#include "hand_made_log.h"
#include "io/small_logs.h"
#include "pipeline.h"

namespace fs = std::filesystem;

namespace lidar_upsampling {
namespace {

/// A folder with in.rawlog and what was made of it, out.rawlog.
class Outputs : public ::testing::Test {
 protected:
  void SetUp() override {
    write_hand_made(folder_ / "in.rawlog");
    densify(folder_);
  }

  // One line with these words, nothing new in the folder, and nothing changed.
  void expect_refused(const std::string& command, const std::string& words) {
    const std::size_t num_before = num_files(folder_.path());
    const Bytes in = file_bytes(folder_ / "in.rawlog"), out = file_bytes(folder_ / "out.rawlog");
    const ToolResult result = run_for_errors(command);
    EXPECT_EQ(result.status, 1) << result.text;
    EXPECT_EQ(count_of(result.text, "\n"), 1) << result.text;
    EXPECT_TRUE(contains(result.text, words)) << result.text;
    EXPECT_EQ(num_files(folder_.path()), num_before);
    EXPECT_TRUE(file_bytes(folder_ / "in.rawlog") == in);
    EXPECT_TRUE(file_bytes(folder_ / "out.rawlog") == out);
  }
  [[nodiscard]] std::string densify_to(const std::string& output, const std::string& more) const {
    return densify_command(folder_ / "in.rawlog", folder_ / output, more);
  }
  [[nodiscard]] std::string evaluate_to(const std::string& more) const {
    return std::string(RAWLOG_EVALUATE) + " --no-paper --reference " + folder_ / "in.rawlog" +
           " --input " + folder_ / "out.rawlog " + more;
  }

  TestFolder folder_;
};

TEST_F(Outputs, that_are_inputs_by_any_name_are_refused) {
  fs::create_hard_link(folder_ / "in.rawlog", folder_ / "hard.rawlog");
  fs::create_symlink("in.rawlog", folder_ / "soft.rawlog");
  for (const char* name : {"in.rawlog", "hard.rawlog", "soft.rawlog"}) {
    expect_refused(densify_to("new.rawlog", "--report " + folder_ / name), "--input");
    expect_refused(densify_to(name, "--overwrite"), "--input");
    expect_refused(evaluate_to("--json " + folder_ / name), "--reference");
  }
  expect_refused(evaluate_to("--csv " + folder_ / "out.rawlog"), "--input");
  expect_refused(std::string(RAWLOG_DECIMATE) +
                     " --label LIDAR --keep-every 2 --overwrite --input " + folder_ / "in.rawlog" +
                     " --output " + folder_ / "in.rawlog",
                 "--input");
}

TEST_F(Outputs, two_of_one_place_are_refused) {
  expect_refused(densify_to("new.rawlog", "--report " + folder_ / "new.rawlog"), "--output");
  expect_refused(evaluate_to("--json " + folder_ / "new --csv " + folder_ / "new"), "--json");
}

TEST_F(Outputs, that_cannot_be_written_are_refused_before_the_work) {
  expect_refused(densify_to("new.rawlog", "--report " + folder_ / "no/report.json"), "no folder");
  expect_refused(densify_to("new.rawlog", "--report " + folder_.path().string()), "regular");
  expect_refused(evaluate_to("--json " + folder_ / "no/errors.json"), "no folder");
}

TEST_F(Outputs, of_whatever_kind_on_a_full_disk_leave_nothing) {
  const std::string in = " --input " + folder_ / "in.rawlog";
  const std::string thin = std::string(RAWLOG_DECIMATE) + " --label LIDAR --keep-every 2" + in;
  const std::string scans = std::string(RAWLOG_EXPORT) + " --label LIDAR" + in + " --output " +
                            folder_.path().string() + " --format ";
  const std::string street = std::string(RAWLOG_SIMULATE) +
                             " --scenario " CONFIG_FOLDER
                             "/scenarios/small.ini --duration 0.1 --output ";
  // No file may grow beyond a block; the signal that tells so is ignored, writing then fails.
  for (const auto& [command, name] : std::vector<std::pair<std::string, std::string>>{
           {densify_to("new.rawlog", ""), "new.rawlog"},
           {thin + " --output " + folder_ / "new.rawlog", "new.rawlog"},
           {scans + "ply", ".ply"},
           {scans + "bin", ".bin"},
           {scans + "3Dscene", ".3Dscene"},
           {street + folder_ / "new.rawlog", "new.rawlog"}})
    expect_refused("trap '' XFSZ; ulimit -f 1; " + command, name);
}

TEST_F(Outputs, on_the_screen_that_are_cut_are_no_success) {
  expect_refused("( " + std::string(RAWLOG_DENSIFY) + " --print-config >/dev/full )",
                 "standard output");
}

/// A command that judges the log of a simulated street.
std::string evaluation(const TestFolder& folder, const std::string& more) {
  simulate(folder);
  densify(folder);
  return std::string(RAWLOG_EVALUATE) + " --no-paper --reference " + folder / "truth.rawlog" +
         " --input " + folder / "out.rawlog" + " --truth-objects " + folder / "in_objects.csv " +
         more;
}

TEST(EvaluationOutputs, on_a_full_disk_leave_what_was_there_before) {
  const TestFolder folder;
  const std::string command = evaluation(folder, "");
  for (const char* const kind : {"json", "html"}) {
    const std::string name = folder / std::string("old.") + kind;
    std::ofstream(name) << "{}";
    const ToolResult result =
        run_for_errors("trap '' XFSZ; ulimit -f 1; " + command + "--" + kind + " " + name);
    EXPECT_EQ(result.status, 1);
    EXPECT_TRUE(contains(result.text, name)) << result.text;
    EXPECT_EQ(file_bytes(name).size(), 2U);
  }
  const ToolResult table = run_for_errors(command + "--csv /dev/full");
  EXPECT_EQ(table.status, 1);
  EXPECT_TRUE(contains(table.text, "/dev/full")) << table.text;
}

TEST(EvaluationOutputs, go_to_a_device_where_told) {
  const TestFolder folder;
  const ToolResult result =
      run("( " + evaluation(folder, "--json /dev/stderr 2>&1 >/dev/null") + " )");
  EXPECT_EQ(result.status, 0);
  EXPECT_TRUE(nlohmann::json::accept(result.text)) << result.text;
}

TEST_F(Outputs, a_report_is_the_same_document_whether_it_was_there_before_or_not) {
  for (int i = 0; i < 2; ++i)
    expect_done(densify_to("new.rawlog", "--overwrite --report " + folder_ / "report.json"));
  const Bytes text = file_bytes(folder_ / "report.json");
  const auto document = nlohmann::json::parse(text);
  const std::string again = document.dump(1) + "\n";
  EXPECT_TRUE(Bytes(again.begin(), again.end()) == text);
}

}  // namespace
}  // namespace lidar_upsampling
