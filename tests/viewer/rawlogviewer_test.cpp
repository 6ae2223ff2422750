// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservation3DScene.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "end_to_end/stock_maps.h"
#include "lidar_upsampling/io/carriers.h"
#include "screen.h"

namespace lidar_upsampling {
namespace {

/// The lower right of RawLogViewer's window, where the chosen entry is drawn.
cv::Mat view_of(const cv::Mat& screen) {
  return screen(cv::Range(screen.rows / 2, screen.rows * 3 / 4),
                cv::Range(screen.cols * 2 / 5, screen.cols));
}

struct Looks {
  std::size_t num_colors = 0;
  int num_drawn = 0;     ///< pixels that are not of the most frequent colour
  int num_colorful = 0;  ///< of them, those that are far from gray
};

Looks looks_of(const cv::Mat& picture) {
  const auto key = [](const cv::Vec3b& bgr) { return bgr[0] << 16 | bgr[1] << 8 | bgr[2]; };
  std::map<int, int> count;
  Looks looks;
  for (auto pixel = picture.begin<cv::Vec3b>(); pixel != picture.end<cv::Vec3b>(); ++pixel) {
    const auto [low, high] = std::minmax({(*pixel)[0], (*pixel)[1], (*pixel)[2]});
    if (high - low > 80) ++looks.num_colorful;
    ++count[key(*pixel)];
  }
  int most = 0;
  for (const auto& [color, n] : count) most = std::max(most, n);
  looks.num_colors = count.size();
  looks.num_drawn = static_cast<int>(picture.total()) - most;
  return looks;
}

// What stands for a view that is not blank; the grid and the axes are drawn in any case.
constexpr int kFewestDrawn = 5000;
constexpr int kFewestColorful = 400;

int num_different(const cv::Mat& a, const cv::Mat& b) {
  int count = 0;
  for (int y = 0; y < a.rows; ++y) {
    for (int x = 0; x < a.cols; ++x) count += a.at<cv::Vec3b>(y, x) != b.at<cv::Vec3b>(y, x);
  }
  return count;
}

/// The list of entries as it is shown: null for what is no observation, frames before what is in
/// them.
std::vector<const mrpt::obs::CObservation*> rows_of(const std::vector<RawlogEntry>& log) {
  std::vector<const mrpt::obs::CObservation*> rows;
  for (const RawlogEntry& entry : log) {
    rows.push_back(dynamic_cast<const mrpt::obs::CObservation*>(entry.object.get()));
    if (const auto* actions = dynamic_cast<const mrpt::obs::CActionCollection*>(entry.object.get()))
      rows.resize(rows.size() + actions->size());
    if (const auto* frame = dynamic_cast<const mrpt::obs::CSensoryFrame*>(entry.object.get()))
      for (const auto& observation : *frame) rows.push_back(observation.get());
  }
  return rows;
}

/// The row of the log's first observation that is such a one.
template <typename Wanted>
std::string entry(const TestFolder& folder, const Wanted& wanted) {
  const auto log = read_log(folder / "out.rawlog");
  const auto rows = rows_of(log);
  const auto found = std::find_if(
      rows.begin(), rows.end(), [&](const auto* seen) { return seen != nullptr && wanted(*seen); });
  if (found != rows.end()) return std::to_string(found - rows.begin());
  ADD_FAILURE() << "no such entry in the log";
  return "0";
}

bool is_virtual(const mrpt::obs::CObservation& seen) {
  return contains(seen.sensorLabel, "_VIRTUAL");
}

bool is_scene(const mrpt::obs::CObservation& seen) {
  return dynamic_cast<const mrpt::obs::CObservation3DScene*>(&seen) != nullptr;
}

class RawLogViewer : public testing::Test {
 protected:
  void SetUp() override {
    if (const std::string missing = Screen::missing("RawLogViewer"); !missing.empty()) {
      GTEST_SKIP() << missing;
    }
  }

  void make_log(const std::string& lidar, const std::string& settings, const std::string& log) {
    simulate(folder_, "[scenario]\nduration_s = 0.2\n" + log, lidar);
    // Arrows from the first image on, whether or not it suffices to tell what moves.
    densify(folder_, "--set annotate=1 --set object_motion.static_test=false " + settings);
  }

  [[nodiscard]] cv::Mat without_log() const {
    return Screen(folder_ / "without", "RawLogViewer").picture();
  }

  TestFolder folder_;
};

TEST_F(RawLogViewer, a_scan_without_points_is_a_blank_view) {
  LidarScan nothing;
  nothing.label = "LIDAR_VIRTUAL";
  nothing.stamp = Stamp(mrpt::Clock::duration(132000000000000000LL));
  LidarScan next = nothing;  // the viewer of MRPT 2.15 asserts on logs of less than a kilobyte
  next.stamp = shifted(nothing.stamp, 0.1);
  for (int i = 0; i < 20000; ++i)
    next.points.emplace_back(20 * std::sin(1.7F * i), 20 * std::cos(1.3F * i), std::sin(0.1F * i));
  for (const std::string name : {"3drangescan", "pointcloud"}) {
    RawlogWriter writer(folder_ / name + ".rawlog", false);
    writer.write(*observation_from_scan(nothing, carrier_from_string(name)));
    writer.write(*observation_from_scan(next, carrier_from_string(name)));
    writer.commit();
    const Screen screen(folder_ / name, "RawLogViewer " + folder_ / name + ".rawlog");
    screen.act("row", "0");
    const Looks looks = looks_of(view_of(screen.picture()));
    EXPECT_LT(looks.num_drawn, kFewestDrawn);
    EXPECT_LT(looks.num_colorful, kFewestColorful);
  }
}

struct Shown {
  std::string name, lidar, settings;
  bool colors = true;    ///< MRPT colours the points
  std::string log = {};  ///< of the scenario
};

void PrintTo(const Shown& shown, std::ostream* out) { *out << shown.name; }

class ShownScans : public RawLogViewer, public testing::WithParamInterface<Shown> {};

TEST_P(ShownScans, and_their_objects_are_seen_in_3d) {
  make_log(GetParam().lidar, GetParam().settings, GetParam().log);
  ASSERT_FALSE(HasFailure());
  const cv::Mat empty = without_log();
  const Screen screen(folder_ / "with", "RawLogViewer " + folder_ / "out.rawlog");

  screen.act("row", entry(folder_, is_virtual));
  const cv::Mat scan = screen.picture();
  EXPECT_GT(num_different(scan, empty), 100000);
  const Looks points = looks_of(view_of(scan));
  EXPECT_GT(points.num_drawn, kFewestDrawn);
  EXPECT_GT(points.num_colors, 50U);
  if (GetParam().colors) {
    EXPECT_GT(points.num_colorful, kFewestDrawn);
  }

  screen.act("row", entry(folder_, is_scene));
  const cv::Mat scene = screen.picture();
  EXPECT_GT(num_different(view_of(scene), view_of(scan)), 1000);
  const Looks boxes = looks_of(view_of(scene));
  EXPECT_GT(boxes.num_drawn, kFewestDrawn);
  EXPECT_GT(boxes.num_colorful, kFewestColorful);
}

INSTANTIATE_TEST_SUITE_P(
    RawLogViewer, ShownScans,
    testing::Values(Shown{"range_scans", kSmallLidar, "--set carrier=3drangescan"},
                    Shown{"point_clouds", kSmallLidar, "--set carrier=pointcloud", false},
                    Shown{"sensory_frames", kSmallLidar, "--set carrier=3drangescan", true,
                          "[log]\nformat = sensory_frames\n"},
                    Shown{"depth_images", kDepthCamera, "--set carrier=same"}),
    [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace lidar_upsampling
