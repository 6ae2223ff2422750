// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "bad_observations.h"
#include "pipeline.h"

namespace lidar_upsampling {
namespace {

class OneBadObservation : public ::testing::TestWithParam<std::size_t> {};

TEST_P(OneBadObservation, passes_through_as_it_came_is_not_used_and_is_counted) {
  const BadObservation bad = bad_observations()[GetParam()];
  SCOPED_TRACE(bad.label + ": " + bad.words);
  const TestFolder folder;
  HandMadeLog log;
  log.num_instants = log.num_images = 13;
  write_hand_made(folder / "in.rawlog", log);
  const auto entries = spoilt(read_log(folder / "in.rawlog"), bad);
  write_entries(folder / "in.rawlog", entries);
  for (const std::string options : {"", "--set mode=offline --set resample=none"}) {
    const ToolResult result =
        run(densify_command(folder / "in.rawlog", folder / "out.rawlog",
                            options + " --overwrite --pictures " + folder / "pictures"));
    ASSERT_EQ(result.status, 0) << result.text;
    EXPECT_TRUE(contains(result.text, "warning (1x): '" + bad.label + "' passed on unused: "))
        << result.text;
    EXPECT_TRUE(contains(result.text, bad.words)) << result.text;
    const auto all = observations_of(folder / "out.rawlog");
    const auto real = without_label(all, "LIDAR_VIRTUAL");
    ASSERT_EQ(real.size(), entries.size());
    for (std::size_t i = 0; i < real.size(); ++i) EXPECT_EQ(real[i].bytes, entries[i].bytes) << i;
    EXPECT_GE(all.size() - real.size(), 6U);  // of 8
  }
  const ToolResult check =
      run(std::string(RAWLOG_DENSIFY) + " --check --input " + folder / "in.rawlog");
  EXPECT_EQ(check.status, 0) << check.text;
}

INSTANTIATE_TEST_SUITE_P(Kinds, OneBadObservation,
                         ::testing::Range<std::size_t>(0, bad_observations().size()));

}  // namespace
}  // namespace lidar_upsampling
