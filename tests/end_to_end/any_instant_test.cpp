// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <cmath>

#include "pipeline.h"

namespace lidar_upsampling {
namespace {

using Json = nlohmann::json;

/// A camera whose rate and phase have nothing to do with the LiDAR's, of which every other scan is
/// withheld.
class FreeRunningCamera : public testing::Test {
 protected:
  void make_log(const std::string& lidar = kSmallLidar) {
    simulate(folder_, R"(
[scenario]
duration_s = 1
[camera.CAM0]
rate_hz = 15
phase_s = 0.017
)",
             lidar);
    expect_done(std::string(RAWLOG_DECIMATE) + " --label LIDAR --keep-every 2 --input " +
                folder_ / "in.rawlog" + " --output " + folder_ / "thin.rawlog");
    expect_done(densify_command(
        folder_ / "thin.rawlog", folder_ / "out.rawlog",
        "--set resample=none --set carrier=3drangescan --report " + folder_ / "report.json"));
  }

  TestFolder folder_;
};

const Json* same_object(const Json& object, const Json& scans) {
  for (const Json& scan : scans) {
    if (scan["stamp"] != object["stamp"]) continue;
    for (const Json& other : scan["objects"]) {
      double apart = 0;
      for (int axis = 0; axis < 3; ++axis)
        apart += std::pow(
            other["centroid_m"][axis].get<double>() - object["centroid_m"][axis].get<double>(), 2);
      if (other["excluded"] == "" && other["moving"] == object["moving"] && apart < 0.25)
        return &other;
    }
  }
  return nullptr;
}

/// Mean error of a row over the objects that both tell of, by each.
struct Means {
  double by_scans = 0, by_truth = 0;
  int count = 0;
};

Means means_of(const std::string& row, bool moving, const Json& by_scans, const Json& by_truth) {
  Means means;
  for (const Json& scan : by_scans["scans"]) {
    for (Json object : scan["objects"]) {
      if (object["excluded"] != "" || object["moving"] != moving) continue;
      object["stamp"] = scan["stamp"];
      const Json* other = same_object(object, by_truth["scans"]);
      if (other == nullptr || object["error_m"][row].is_null() ||
          (*other)["error_m"][row].is_null())
        continue;
      means.by_scans += object["error_m"][row].get<double>();
      means.by_truth += (*other)["error_m"][row].get<double>();
      ++means.count;
    }
  }
  return means;
}

TEST_F(FreeRunningCamera, withheld_scans_tell_of_every_row_what_the_exact_truth_tells) {
  make_log("[lidar]\nrings = 64\ncolumns = 900\n");
  const Json by_scans = evaluate(folder_, "in.rawlog");
  const Json by_truth =
      evaluate(folder_, "truth.rawlog", "--truth-objects " + folder_ / "in_objects.csv");
  EXPECT_EQ(by_scans["num_compared"], by_truth["num_compared"]);
  EXPECT_TRUE(by_scans["scans"][0]["reference_interpolated"]);
  for (const char* row : {"hold", "ego", "constant-velocity", "paper", "ours"}) {
    const Means moving = means_of(row, true, by_scans, by_truth);
    ASSERT_GE(moving.count, 8) << row;
    EXPECT_NEAR(moving.by_scans / moving.count, moving.by_truth / moving.count, 0.01) << row;
    const Means standing = means_of(row, false, by_scans, by_truth);
    ASSERT_GE(standing.count, 8) << row;
    EXPECT_NEAR(standing.by_scans / standing.count, standing.by_truth / standing.count, 0.005)
        << row;
  }
}

// No picture has the scan's stamp, so that an object has moved already on the first one.
TEST_F(FreeRunningCamera, what_moved_before_the_first_picture_is_told_by_the_published_method_too) {
  make_log("[lidar]\nrings = 64\ncolumns = 900\n");
  const Json by_truth =
      evaluate(folder_, "truth.rawlog", "--truth-objects " + folder_ / "in_objects.csv");
  const Means standing = means_of("ego", true, by_truth, by_truth);
  const Means by_picture = means_of("paper", true, by_truth, by_truth);
  ASSERT_EQ(by_picture.count, standing.count);
  EXPECT_LT(by_picture.by_truth, 0.5 * standing.by_truth);
}

TEST_F(FreeRunningCamera, what_lies_too_far_from_any_withheld_scan_is_left_out_and_counted) {
  make_log();
  const Json all = evaluate(folder_, "in.rawlog", "--no-paper");
  const Json near = evaluate(folder_, "in.rawlog", "--no-paper --tolerance 30");
  EXPECT_EQ(all["num_unmatched"], 0);
  EXPECT_GT(near["num_unmatched"], 0);
  EXPECT_EQ(near["num_compared"].get<int>() + near["num_unmatched"].get<int>(),
            near["num_virtual"].get<int>());
}

TEST_F(FreeRunningCamera, labels_judge_without_a_reference) {
  make_log();
  const std::string command = std::string(RAWLOG_EVALUATE) + " --input " + folder_ / "out.rawlog" +
                              " --labels " + folder_ / "in_objects.csv" + " --report " +
                              folder_ / "report.json" + " --no-paper --csv " + folder_ / "row.csv";
  const ToolResult result = run(command);
  EXPECT_EQ(result.status, 0) << result.text;
  EXPECT_TRUE(contains(result.text, "labelled movers, error")) << result.text;
  EXPECT_FALSE(contains(result.text, "Chamfer")) << result.text;
  std::ifstream csv(folder_ / "row.csv");
  const std::string figures((std::istreambuf_iterator<char>(csv)), {});
  EXPECT_TRUE(contains(figures, "ours,movers_mean_m,")) << figures;
  EXPECT_TRUE(contains(figures, "ego,movers_p95_m,")) << figures;
}

}  // namespace
}  // namespace lidar_upsampling
