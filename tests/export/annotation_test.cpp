// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <mrpt/obs/CObservation3DScene.h>
#include <mrpt/opengl/CArrow.h>
#include <mrpt/opengl/CBox.h>

#include "end_to_end/pipeline.h"
#include "export/scene_objects.h"

namespace lidar_upsampling {
namespace {

using mrpt::obs::CObservation3DScene;

class Annotation : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    simulate(folder_, std::string("[log]\nformat = ") + GetParam() + "\n");
    densify(folder_, "--set annotate=1");
  }
  [[nodiscard]] std::string path(const std::string& name) const { return folder_ / name; }
  [[nodiscard]] const TestFolder& folder() const { return folder_; }

 private:
  TestFolder folder_;
};

CObservation3DScene* scene_of(const Logged& logged) {
  return dynamic_cast<CObservation3DScene*>(logged.observation.get());
}

TEST_P(Annotation, follows_each_virtual_scan_with_its_stamp) {
  const auto out = observations_of(path("out.rawlog"));
  std::size_t num_scenes = 0, num_boxes = 0, num_arrows = 0;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const auto* const observation = scene_of(out[i]);
    if (observation == nullptr) continue;
    ++num_scenes;
    ASSERT_GT(i, 0);
    EXPECT_EQ(out[i - 1].label(), "LIDAR_VIRTUAL");
    EXPECT_EQ(out[i - 1].stamp(), out[i].stamp());
    num_boxes += count<mrpt::opengl::CBox>(*observation->scene);
    num_arrows += count<mrpt::opengl::CArrow>(*observation->scene);
  }
  EXPECT_EQ(num_scenes, 8);
  EXPECT_GE(num_arrows, 8);  // two vehicles drive
  EXPECT_GT(num_boxes, num_arrows);
}

TEST_P(Annotation, changes_nothing_else) {
  std::vector<Logged> rest;
  for (Logged& logged : observations_of(path("out.rawlog")))
    if (scene_of(logged) == nullptr) rest.push_back(std::move(logged));
  densify(folder(), "--overwrite");
  const auto plain = observations_of(path("out.rawlog"));
  ASSERT_EQ(rest.size(), plain.size());
  for (std::size_t i = 0; i < plain.size(); ++i) EXPECT_TRUE(rest[i].bytes == plain[i].bytes) << i;
}

// MRPT 2.5.8 does not write the label of this class, so --remove-label cannot name it.
TEST_P(Annotation, is_taken_out_by_stock_rawlog_edit) {
  if (!has_rawlog_edit()) GTEST_SKIP() << "rawlog-edit is not installed";
  const ToolResult info = run("rawlog-edit --info -i " + path("out.rawlog"));
  EXPECT_EQ(info.status, 0);
  EXPECT_TRUE(contains(info.text, "LIDAR_VIRTUAL /      8 /")) << info.text;
  if (!rawlog_edit_removes_labels(path("out.rawlog"), path("pictures.rawlog")))
    GTEST_SKIP() << "this MRPT's rawlog-edit removes nothing";
  expect_done("rawlog-edit --keep-label LIDAR,LIDAR_VIRTUAL,CAM0,POSE -i " + path("out.rawlog") +
              " -o " + path("back.rawlog"));
  const auto back = observations_of(path("back.rawlog"));
  EXPECT_EQ(with_label(back, "LIDAR_VIRTUAL").size(), 8);
  for (const Logged& logged : back) EXPECT_EQ(scene_of(logged), nullptr);
}

TEST_P(Annotation, is_passed_over_by_stock_icp_slam) {
  if (run("command -v icp-slam").status != 0) GTEST_SKIP() << "icp-slam is not installed";
  const ToolResult result = run("cd " + folder().path().string() +
                                " && icp-slam " CONFIG_FOLDER "/icp-slam.ini out.rawlog");
  EXPECT_EQ(result.status, 0) << result.text;
}

INSTANTIATE_TEST_SUITE_P(Formats, Annotation, testing::Values("observations", "sensory_frames"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace lidar_upsampling
