// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <filesystem>

#include "pipeline.h"

namespace fs = std::filesystem;

namespace lidar_upsampling {
namespace {

/// The real drive, thinned and densified.
class KittiDrive : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(drive_)) GTEST_SKIP() << "no " << drive_;
  }

  void densify_thinned(int keep_every) const {
    expect_done(std::string(KITTI2RAWLOG) + " --drive " + drive_.string() + " --output " +
                folder_ / "full.rawlog");
    expect_done(std::string(RAWLOG_DECIMATE) + " --label LIDAR --keep-every " +
                std::to_string(keep_every) + " --input " + folder_ / "full.rawlog" + " --output " +
                folder_ / "in.rawlog");
    expect_done(std::string(RAWLOG_DENSIFY) + " --config " CONFIG_FOLDER "/kitti.ini --input " +
                folder_ / "in.rawlog" + " --output " + folder_ / "out.rawlog");
  }

  fs::path drive_ = data_folder() / "kitti_raw/2011_09_26/2011_09_26_drive_0052_sync";
  TestFolder folder_;
};

TEST_F(KittiDrive, withheld_scans_come_back_within_the_papers_accuracy) {
  densify_thinned(2);
  const auto full = observations_of(folder_ / "full.rawlog");
  EXPECT_EQ(with_label(full, "LIDAR").size(), 31U);
  EXPECT_EQ(with_label(full, "CAM2").size(), 31U);
  EXPECT_EQ(with_label(observations_of(folder_ / "out.rawlog"), "LIDAR_VIRTUAL").size(), 15U);
  if (has_rawlog_edit()) {
    const ToolResult info = run("rawlog-edit --info -i " + folder_ / "out.rawlog");
    EXPECT_EQ(info.status, 0);
    EXPECT_TRUE(contains(info.text, "LIDAR_VIRTUAL /     15 /")) << info.text;
  }

  const auto errors = evaluate(folder_, "full.rawlog");
  EXPECT_EQ(errors["num_compared"], 15);
  const auto ours = errors["summary"]["ours"];
  EXPECT_GE(ours["moving_objects_m"]["count"], 15);
  EXPECT_LT(ours["moving_objects_m"]["mean"], 0.045);
  EXPECT_LT(ours["static_objects_m"]["mean"], 0.04);
  EXPECT_LT(ours["moving_objects_m"]["mean"], errors["summary"]["ego"]["moving_objects_m"]["mean"]);
}

TEST_F(KittiDrive, two_images_in_a_row_are_chained_from_the_same_scan) {
  densify_thinned(3);
  EXPECT_EQ(with_label(observations_of(folder_ / "out.rawlog"), "LIDAR_VIRTUAL").size(), 20U);
  const auto errors = evaluate(folder_, "full.rawlog");
  EXPECT_EQ(errors["num_compared"], 20);
  const auto& summary = errors["summary"];
  EXPECT_LT(summary["ours"]["moving_objects_m"]["mean"],
            0.5 * summary["ego"]["moving_objects_m"]["mean"].get<double>());
  EXPECT_LT(summary["ours"]["static_objects_m"]["mean"], 0.05);
}

}  // namespace
}  // namespace lidar_upsampling
