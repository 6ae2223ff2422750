// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "io/small_logs.h"
#include "pipeline.h"

namespace lidar_upsampling {
namespace {

TEST(DensifiedLog, every_image_between_two_scans_is_followed_by_its_virtual_scan) {
  const TestFolder folder;
  simulate(folder);
  densify(folder);
  const auto out = observations_of(folder / "out.rawlog");
  EXPECT_EQ(with_label(out, "LIDAR").size(), 5U);
  EXPECT_EQ(with_label(out, "LIDAR_VIRTUAL").size(), kVirtualScans);
  for (std::size_t i = 1; i < out.size(); ++i) {
    EXPECT_GE(out[i].stamp(), out[i - 1].stamp()) << i;
    if (out[i].label() != "LIDAR_VIRTUAL") continue;
    EXPECT_EQ(out[i - 1].label(), "CAM0") << i;
    EXPECT_EQ(out[i].stamp(), out[i - 1].stamp()) << i;
  }
}

TEST(DensifiedLog, the_real_observations_stay_byte_for_byte) {
  const TestFolder folder;
  simulate(folder);
  densify(folder);
  const auto in = observations_of(folder / "in.rawlog");
  const auto real = without_label(observations_of(folder / "out.rawlog"), "LIDAR_VIRTUAL");
  ASSERT_EQ(real.size(), in.size());
  for (std::size_t i = 0; i < in.size(); ++i) EXPECT_TRUE(real[i].bytes == in[i].bytes) << i;
}

TEST(DensifiedLog,
     a_log_is_densified_once_says_so_the_second_time_and_is_undone_by_rawlog_decimate) {
  const TestFolder folder;
  simulate(folder, "[scenario]\nduration_s = 0.12\n");
  densify(folder);
  const ToolResult again = run_for_errors(
      densify_command(folder / "out.rawlog", folder / "twice.rawlog", "--set lidar_label=LIDAR"));
  EXPECT_EQ(again.status, 1);
  EXPECT_TRUE(contains(again.text, "already holds virtual scans")) << again.text;
  expect_done(std::string(RAWLOG_DECIMATE) + " --label LIDAR_VIRTUAL --keep-every 0 --input " +
              folder / "out.rawlog" + " --output " + folder / "back.rawlog");
  EXPECT_TRUE(uncompressed(folder / "back.rawlog") == uncompressed(folder / "in.rawlog"));
}

TEST(DensifiedLog, in_sensory_frames_the_virtual_scans_are_beside_their_images) {
  const TestFolder folder;
  simulate(folder, "[log]\nformat = sensory_frames\n");
  densify(folder);
  int num_virtual = 0;
  for (const RawlogEntry& entry : read_log(folder / "out.rawlog")) {
    EXPECT_EQ(dynamic_cast<mrpt::obs::CObservation*>(entry.object.get()), nullptr);
    const auto* const frame = dynamic_cast<mrpt::obs::CSensoryFrame*>(entry.object.get());
    if (frame == nullptr) continue;
    const auto scan = frame->getObservationBySensorLabel("LIDAR_VIRTUAL");
    if (!scan) continue;
    ++num_virtual;
    const auto image = frame->getObservationBySensorLabel("CAM0");
    ASSERT_TRUE(image);
    EXPECT_EQ(scan->timestamp, image->timestamp);
  }
  EXPECT_EQ(num_virtual, kVirtualScans);
  EXPECT_LT(errors_to_truth(folder)["static_scene_m"]["mean"], 0.02);
}

TEST(DensifiedLog, the_report_counts_what_the_log_holds) {
  const TestFolder folder;
  simulate(folder);
  densify(folder, "--report " + folder / "report.json");
  std::ifstream file(folder / "report.json");
  const auto report = nlohmann::json::parse(file, nullptr, false);
  ASSERT_TRUE(report.is_object());
  EXPECT_EQ(report["scans_in"], 5);
  EXPECT_EQ(report["images_in"], 13);
  EXPECT_EQ(report["virtual_scans"], kVirtualScans);
  ASSERT_FALSE(report["clusters_left_static"].empty());
  EXPECT_NE(report["clusters_left_static"][0]["why"], "");
  EXPECT_EQ(report["entries_in"], observations_of(folder / "in.rawlog").size());
  EXPECT_TRUE(report["warnings"].empty());
  EXPECT_FALSE(report["stages"].empty());
  EXPECT_GE(report["objects"].size(), 2U * kVirtualScans);  // the two moving cars, at least
}

TEST(DensifiedLog, offline_scans_to_come_tell_of_the_objects_motions) {
  const TestFolder folder;
  simulate(folder, "[log]\nformat = sensory_frames\n");
  const auto moving_error = [&](const std::string& settings) {
    densify(folder, settings + " --overwrite --report " + folder / "report.json");
    EXPECT_EQ(with_label(observations_of(folder / "out.rawlog"), "LIDAR_VIRTUAL").size(),
              kVirtualScans);
    return errors_to_truth(folder)["moving_objects_m"]["mean"].get<double>();
  };
  EXPECT_LT(moving_error("--set mode=offline"), 0.02);
  // Where pictures tell nothing, only scans to come know how what is new will go on.
  const std::string blind = "--set klt.max_residual=0.001";
  const double causal = moving_error(blind), offline = moving_error(blind + " --set mode=offline");
  EXPECT_LT(offline, 0.5 * causal);
}

}  // namespace
}  // namespace lidar_upsampling
