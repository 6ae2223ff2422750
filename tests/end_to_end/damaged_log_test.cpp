// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <filesystem>

#include "hand_made_log.h"
#include "io/damage.h"
#include "pipeline.h"

namespace fs = std::filesystem;

namespace lidar_upsampling {
namespace {

/// A log, the same one densified, and either with something broken after two thirds of it.
class DamagedLog : public ::testing::Test {
 protected:
  void SetUp() override {
    write_hand_made(folder_ / "whole.rawlog");
    expect_done(densify_command(folder_ / "whole.rawlog", folder_ / "dense.rawlog"));
  }

  void damage(const std::string& log, const Bytes& broken) {
    const std::vector<RawlogEntry> entries = read_log(folder_ / log);
    num_good_ = entries.size() * 2 / 3;
    std::vector<Bytes> parts;
    for (const RawlogEntry& entry : entries) parts.push_back(entry.bytes);
    parts.insert(parts.begin() + static_cast<std::ptrdiff_t>(num_good_), broken);
    write_bytes(folder_ / "in.rawlog", joined(parts));
  }

  // One line on stderr that names byte, last stamp and flag, and nothing new in the folder; with
  // the flag it is a warning.
  void expect_refused_or_salvaged(const std::string& command) {
    const std::size_t num_before = num_files(folder_.path());
    const ToolResult refused = run_for_errors(command);
    EXPECT_EQ(refused.status, 1) << command << ": " << refused.text;
    EXPECT_EQ(std::count(refused.text.begin(), refused.text.end(), '\n'), 1) << refused.text;
    EXPECT_EQ(num_files(folder_.path()), num_before) << command;
    const ToolResult accepted = run(command + " --accept-truncated");
    EXPECT_EQ(accepted.status, 0) << command << ": " << accepted.text;
    const std::string after = "broken after " + std::to_string(num_good_) + " good objects";
    for (const std::string& text : {refused.text, accepted.text})
      for (const std::string& word :
           {after, std::string("the last one of 20"), std::string("at byte ")})
        EXPECT_TRUE(contains(text, word)) << word << " is not in: " << text;
    EXPECT_TRUE(contains(refused.text, "--accept-truncated")) << refused.text;
    EXPECT_FALSE(contains(accepted.text, "--accept-truncated")) << accepted.text;
    EXPECT_TRUE(contains(accepted.text, "left out: ")) << accepted.text;
  }

  [[nodiscard]] std::string in_to(const std::string& tool, const std::string& output) const {
    return tool + " --input " + folder_ / "in.rawlog" + " --output " + folder_ / output + " ";
  }

  TestFolder folder_;
  std::size_t num_good_ = 0;
};

constexpr std::uint32_t kWild = 0x3fff0000;

TEST_F(DamagedLog, of_whatever_kind_is_refused_or_densified_without_the_damage_if_told) {
  const Bytes picture = range_picture_of(37, 41);
  const std::vector<Bytes> all{range_picture_of(kWild, 1),
                               range_picture_of(1, kWild),
                               range_picture_of(50000, 50000),
                               broken_jpeg(),
                               Bytes(512, 0),
                               {picture.begin(), picture.begin() + 100}};
  for (std::size_t i = 0; i < all.size(); ++i) {
    SCOPED_TRACE(i);
    damage("whole.rawlog", all[i]);
    expect_refused_or_salvaged(in_to(RAWLOG_DENSIFY, "out.rawlog"));
    const auto scans = with_label(observations_of(folder_ / "out.rawlog"), "LIDAR_VIRTUAL");
    EXPECT_EQ(scans.size(), 6U);
    fs::remove(folder_ / "out.rawlog");
  }
}

TEST_F(DamagedLog, in_parts_is_refused_or_densified_without_the_damage_if_told) {
  damage("whole.rawlog", range_picture_of(kWild, 1));
  expect_refused_or_salvaged(in_to(RAWLOG_DENSIFY, "out.rawlog") + "--jobs 2");
}

TEST_F(DamagedLog, is_refused_by_every_other_tool_too_or_used_without_the_damage_if_told) {
  damage("whole.rawlog", range_picture_of(kWild, 1));
  expect_refused_or_salvaged(in_to(RAWLOG_DECIMATE, "out.rawlog") + "--label LIDAR --keep-every 2");
  EXPECT_EQ(read_log(folder_ / "out.rawlog").size(), read_log(folder_ / "whole.rawlog").size() - 2);
  damage("dense.rawlog", broken_jpeg());
  expect_refused_or_salvaged(in_to(RAWLOG_EXPORT, "clouds"));
  expect_refused_or_salvaged(std::string(RAWLOG_MAP_COMPARE) + " --reference " +
                             folder_ / "whole.rawlog" + " --input " + folder_ / "in.rawlog");
}

TEST_F(DamagedLog, is_not_judged_or_without_the_damage_if_told) {
  simulate(folder_);
  expect_done(densify_command(folder_ / "in.rawlog", folder_ / "street.rawlog"));
  damage("street.rawlog", range_picture_of(kWild, 1));
  expect_refused_or_salvaged(std::string(RAWLOG_EVALUATE) + " --no-paper --reference " +
                             folder_ / "truth.rawlog" + " --input " + folder_ / "in.rawlog");
}

TEST_F(DamagedLog, is_told_by_a_check) {
  damage("whole.rawlog", range_picture_of(kWild, 1));
  const ToolResult result =
      run(std::string(RAWLOG_DENSIFY) + " --check --input " + folder_ / "in.rawlog");
  EXPECT_EQ(result.status, 0) << result.text;
  EXPECT_TRUE(contains(result.text, "broken after")) << result.text;
}

TEST_F(DamagedLog, whose_second_part_has_no_gzip_header_is_not_taken_for_a_whole_one) {
  const Bytes whole = file_bytes(folder_ / "whole.rawlog");
  Bytes second = whole;
  second[0] ^= 1U;
  num_good_ = read_log(folder_ / "whole.rawlog").size();
  write_bytes(folder_ / "in.rawlog", joined({whole, second}));
  expect_refused_or_salvaged(in_to(RAWLOG_DENSIFY, "out.rawlog"));
  EXPECT_EQ(without_label(observations_of(folder_ / "out.rawlog"), "LIDAR_VIRTUAL").size(),
            2 * num_good_);
}

TEST_F(DamagedLog, names_that_are_no_utf_8_do_not_end_a_report) {
  HandMadeLog log;
  log.lidar_label = "LID\xe4R";
  write_hand_made(folder_ / "in.rawlog", log);
  expect_done(in_to(RAWLOG_DENSIFY, "out.rawlog") + "--report " + folder_ / "report.json");
  std::ifstream file(folder_ / "report.json");
  EXPECT_EQ(nlohmann::json::parse(file)["virtual_scans"], 6);
}

}  // namespace
}  // namespace lidar_upsampling
