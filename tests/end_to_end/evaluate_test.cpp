// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <mrpt/obs/CObservation.h>

#include "lidar_upsampling/io/rawlog_stream.h"
#include "pipeline.h"

namespace lidar_upsampling {
namespace {

/// out.rawlog: in.rawlog with a "virtual" scan for each scan that stands in truth.rawlog between
/// two real ones.
/// @param made what is put there, given the last real scan and the true one.
template <typename Made>
void write_pretended(const TestFolder& folder, const Made& made) {
  const auto truth = observations_of(folder / "truth.rawlog");
  RawlogWriter writer(folder / "out.rawlog", true);
  mrpt::obs::CObservation::Ptr last;
  std::size_t next = 0;
  const auto write_until = [&](Stamp stamp) {
    for (; next < truth.size() && truth[next].stamp() < stamp; ++next) {
      if (!last || truth[next].stamp() <= last->timestamp) continue;
      const auto copy = std::dynamic_pointer_cast<mrpt::obs::CObservation>(
          made(last, truth[next].observation)->duplicateGetSmartPtr());
      copy->sensorLabel = "LIDAR_VIRTUAL";
      copy->timestamp = truth[next].stamp();
      writer.write(*copy);
    }
  };
  for (const Logged& logged : observations_of(folder / "in.rawlog")) {
    write_until(logged.stamp());
    writer.write(*logged.observation);
    if (logged.label() == "LIDAR") last = logged.observation;
  }
  writer.commit();
}

class Evaluation : public testing::Test {
 protected:
  Evaluation() { simulate(folder_); }

  TestFolder folder_;
};

TEST_F(Evaluation, withheld_scans_as_virtual_ones_score_zero) {
  write_pretended(folder_, [](const auto&, const auto& truth) { return truth; });
  const auto errors = evaluate(folder_, "truth.rawlog", "--no-paper");
  const auto& ours = errors["summary"]["ours"];
  ASSERT_GE(errors["num_compared"], 4);
  EXPECT_EQ(ours["chamfer_m"]["mean"], 0);
  EXPECT_EQ(ours["chamfer_in_view_m2"]["mean"], 0);
  ASSERT_GE(ours["moving_objects_m"]["count"], 4);
  EXPECT_LT(ours["moving_objects_m"]["p95"], 1e-3);
  EXPECT_LT(ours["static_objects_m"]["p95"], 1e-3);
}

TEST_F(Evaluation, without_clouds_objects_are_judged_as_with_them) {
  densify(folder_, "");
  const auto all = evaluate(folder_, "truth.rawlog", "--no-paper")["summary"]["ours"];
  const auto objects =
      evaluate(folder_, "truth.rawlog", "--no-paper --no-chamfer")["summary"]["ours"];
  EXPECT_GT(all["chamfer_m"]["count"], 0);
  EXPECT_EQ(objects["chamfer_m"]["count"], 0);
  EXPECT_EQ(objects["moving_objects_m"], all["moving_objects_m"]);
  EXPECT_EQ(objects["static_objects_m"], all["static_objects_m"]);
}

TEST_F(Evaluation, copies_of_the_last_scan_score_as_the_hold_row) {
  write_pretended(folder_, [](const auto& last, const auto&) { return last; });
  const auto errors = evaluate(folder_, "truth.rawlog",
                               "--no-paper --protocol argoverse-vehicles --seeds 2 "
                               "--truth-objects " +
                                   folder_ / "in_objects.csv");
  const auto& ours = errors["summary"]["ours"];
  const auto& hold = errors["summary"]["hold"];
  ASSERT_GE(ours["moving_objects_m"]["count"], 4);
  EXPECT_GT(hold["moving_objects_m"]["mean"], 0.1);
  for (const char* figure : {"moving_objects_m", "static_objects_m", "moving_points_m",
                             "static_scene_m", "chamfer_m", "chamfer_in_view_m"})
    EXPECT_NEAR(ours[figure]["mean"], hold[figure]["mean"], 1e-4) << figure;
  EXPECT_NEAR(ours["sampled"]["emd_m2"]["mean"], hold["sampled"]["emd_m2"]["mean"], 1e-3);
}

TEST_F(Evaluation, preset_paper_scores_as_the_paper_row) {
  densify(folder_, "--set preset=paper");
  const auto errors =
      evaluate(folder_, "truth.rawlog", "--truth-objects " + folder_ / "in_objects.csv");
  const auto& summary = errors["summary"];
  for (const char* figure : {"moving_objects_m", "static_objects_m", "chamfer_m"}) {
    ASSERT_GT(summary["paper"][figure]["count"], 0) << figure;
    EXPECT_NEAR(summary["ours"][figure]["mean"], summary["paper"][figure]["mean"], 1e-4) << figure;
  }
}

TEST_F(Evaluation, every_row_is_there_and_only_the_true_motion_is_free_of_error) {
  densify(folder_, "--set resample=none");  // scene flow is told from each point's own way
  const auto errors =
      evaluate(folder_, "truth.rawlog",
               "--protocol kitti-odometry --seeds 2 --truth-objects " + folder_ / "in_objects.csv");
  const auto& summary = errors["summary"];
  for (const char* row : {"hold", "ego", "constant-velocity", "paper", "ours"}) {
    EXPECT_GT(summary[row]["moving_objects_m"]["count"], 0) << row;
    EXPECT_GT(summary[row]["chamfer_m"]["mean"], 0) << row;
    EXPECT_GT(summary[row]["sampled"]["emd_m2"]["mean"], 0) << row;
    EXPECT_GT(summary[row]["epe_three_way_m"]["mean"], 0) << row;
  }
  EXPECT_GT(summary["oracle"]["chamfer_m"]["mean"], 0);
  EXPECT_GT(summary["floor"]["sampled"]["chamfer_m2"]["mean"], 0);
  EXPECT_LT(summary["floor"]["sampled"]["chamfer_m2"]["mean"],
            summary["hold"]["sampled"]["chamfer_m2"]["mean"]);
}

TEST_F(Evaluation, virtual_scans_are_found_by_the_label_that_they_were_given) {
  densify(folder_, "--set output_label=DENSE");
  const auto errors = evaluate(folder_, "truth.rawlog", "--no-chamfer --set output_label=DENSE");
  EXPECT_EQ(errors["virtual_label"], "DENSE");
  EXPECT_GE(errors["num_compared"], 4);
  EXPECT_GT(errors["summary"]["paper"]["moving_objects_m"]["count"], 0);
}

TEST(EvaluationOfSweeps, what_was_straightened_is_judged_by_scans_that_are) {
  const TestFolder folder;
  simulate(folder, "[lidar]\nsweep = true\n[log]\ncarrier = velodyne\n");
  densify(folder, "--set resample=none");
  const auto judged = [&](const std::string& how) {
    return evaluate(folder, "truth.rawlog", "--no-paper --no-chamfer " + how);
  };
  const auto static_error_m = [&](const std::string& scan_time) {
    const auto errors =
        judged("--set scan_time=" + scan_time + " --truth-objects " + folder / "in_objects.csv");
    const auto& objects = errors["summary"]["ours"]["static_objects_m"];
    EXPECT_GT(objects["count"], 0);
    return objects["mean"].template get<double>();
  };
  EXPECT_LT(static_error_m("auto"), 0.3 * static_error_m("none"));
  for (const auto& scan : judged("")["scans"])
    EXPECT_EQ(scan["points_told"], true) << "points of ours are those of the key scan";
}

}  // namespace
}  // namespace lidar_upsampling
