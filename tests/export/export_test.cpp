// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <mrpt/opengl/CBox.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/opengl/CPointCloudColoured.h>

#include <filesystem>
#include <fstream>

#include "argoverse2rawlog/ply.h"
#include "end_to_end/pipeline.h"
#include "export/scene_objects.h"
#include "lidar_upsampling/io/carriers.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling {
namespace {

class Export : public ::testing::Test {
 protected:
  void SetUp() override {
    simulate(folder_);
    densify(folder_, "--report " + path("report.json"));
  }
  [[nodiscard]] std::string path(const std::string& name) const { return folder_ / name; }
  [[nodiscard]] std::string command(const std::string& options) const {
    return std::string(RAWLOG_EXPORT) + " --input " + path("out.rawlog") + " --output " +
           path("files") + " " + options;
  }
  [[nodiscard]] std::vector<LidarScan> scans(const std::string& label) const {
    std::vector<LidarScan> all;
    for (const Logged& logged : with_label(observations_of(path("out.rawlog")), label))
      all.push_back(*scan_from_observation(*logged.observation));
    return all;
  }
  [[nodiscard]] std::string file_of(const LidarScan& scan, const std::string& ending) const {
    return path("files/" + to_text(scan.stamp) + ending);
  }
  [[nodiscard]] nlohmann::json rows() const {
    std::ifstream file(path("report.json"));
    return nlohmann::json::parse(file)["objects"];
  }

 private:
  TestFolder folder_;
};

TEST_F(Export, ply_holds_every_point_of_every_virtual_scan) {
  expect_done(command(""));
  const auto all = scans("LIDAR_VIRTUAL");
  ASSERT_EQ(all.size(), 8);
  for (const LidarScan& scan : all) {
    const auto ply = argoverse::read_ply(file_of(scan, ".ply"));
    ASSERT_EQ(ply.property("x").size(), scan.size());
    for (std::size_t i = 0; i < scan.size(); ++i) {
      ASSERT_EQ(ply.property("x")[i], scan.points[i].x());
      ASSERT_EQ(ply.property("z")[i], scan.points[i].z());
      ASSERT_EQ(ply.property("intensity")[i], scan.intensity[i]);
      ASSERT_EQ(ply.property("ring")[i], scan.ring[i]);
    }
  }
}

TEST_F(Export, bin_is_in_kittis_layout) {
  expect_done(command("--format bin --index 2"));
  const LidarScan scan = scans("LIDAR_VIRTUAL").at(2);
  std::ifstream file(file_of(scan, ".bin"), std::ios::binary);
  std::vector<float> numbers(4 * scan.size() + 1);
  file.read(reinterpret_cast<char*>(numbers.data()),
            static_cast<std::streamsize>(numbers.size() * sizeof(float)));
  ASSERT_EQ(file.gcount(), static_cast<std::streamsize>(16 * scan.size()));
  EXPECT_EQ(numbers[4], scan.points[1].x());
  EXPECT_EQ(numbers[6], scan.points[1].z());
  EXPECT_EQ(numbers[7], scan.intensity[1]);
}

TEST_F(Export, the_index_names_each_file_once) {
  expect_done(command("--label LIDAR"));
  std::ifstream file(path("files/index.csv"));
  std::string line;
  std::getline(file, line);
  EXPECT_EQ(line, "file,label,stamp,unix_time,points,x,y,z,qx,qy,qz,qw");
  for (const LidarScan& scan : scans("LIDAR")) {
    ASSERT_TRUE(std::getline(file, line));
    EXPECT_EQ(line.rfind(to_text(scan.stamp) + ".ply,LIDAR,", 0), 0) << line;
    EXPECT_TRUE(std::filesystem::exists(file_of(scan, ".ply")));
  }
  EXPECT_FALSE(std::getline(file, line));
}

TEST_F(Export, a_stamp_chooses_the_nearest_scan) {
  const LidarScan scan = scans("LIDAR_VIRTUAL").at(5);
  expect_done(command("--stamp " + to_text(shifted(scan.stamp, 0.004))));
  EXPECT_TRUE(std::filesystem::exists(file_of(scan, ".ply")));
}

TEST_F(Export, a_file_is_each_scans_own_where_two_have_one_stamp) {
  const std::string twice = path("twice.rawlog");
  RawlogWriter writer(twice, false);
  const LidarScan scan = scans("LIDAR").front();
  for (int i = 0; i < 2; ++i) writer.write(*observation_from_scan(scan, Carrier::automatic));
  writer.commit();
  expect_done(std::string(RAWLOG_EXPORT) + " --input " + twice + " --label LIDAR --output " +
              path("files"));
  EXPECT_TRUE(std::filesystem::exists(file_of(scan, ".ply")));
  EXPECT_TRUE(std::filesystem::exists(file_of(scan, "-2.ply")));
}

TEST_F(Export, a_scene_holds_the_scan_and_the_boxes_of_its_instant) {
  expect_done(command("--format 3Dscene --index 6 --report " + path("report.json")));
  const LidarScan scan = scans("LIDAR_VIRTUAL").at(6);
  std::size_t num_boxes = 0;
  for (const auto& row : rows())
    if (row["stamp"] == scan.stamp.time_since_epoch().count() && row.contains("box")) ++num_boxes;
  ASSERT_GT(num_boxes, 0);
  mrpt::opengl::COpenGLScene scene;
  ASSERT_TRUE(scene.loadFromFile(file_of(scan, ".3Dscene")));
  EXPECT_EQ(count<mrpt::opengl::CBox>(scene), num_boxes);
  std::size_t num_points = 0;
  scene.visitAllObjects([&](const mrpt::opengl::CRenderizable::Ptr& object) {
    if (auto cloud = std::dynamic_pointer_cast<mrpt::opengl::CPointCloudColoured>(object))
      num_points += cloud->size();
  });
  EXPECT_EQ(num_points, scan.size());
}

TEST_F(Export, a_trail_has_a_box_for_each_instant_of_its_object) {
  std::map<int, std::size_t> boxes_of_track;
  for (const auto& row : rows())
    if (row["moving"] && row.contains("box")) ++boxes_of_track[row["track"].get<int>()];
  ASSERT_FALSE(boxes_of_track.empty());
  const auto [track, num_moving] = *boxes_of_track.begin();
  expect_done(command("--format 3Dscene --report " + path("report.json") + " --track " +
                      std::to_string(track)));
  mrpt::opengl::COpenGLScene scene;
  ASSERT_TRUE(scene.loadFromFile(path("files/track_" + std::to_string(track) + ".3Dscene")));
  EXPECT_GE(count<mrpt::opengl::CBox>(scene), num_moving);
}

TEST_F(Export, what_is_not_there_is_said_in_one_line) {
  for (const auto& [options, said] : std::vector<std::pair<std::string, std::string>>{
           {"--label TOP", "no 3D scans are labelled 'TOP'"},
           {"--index 99", "has scans 0 to 7"},
           {"--format 3Dscene --report " + path("report.json") + " --track 999",
            "has no track 999"}}) {
    const ToolResult result = run(command(options));
    EXPECT_EQ(result.status, 1) << options;
    EXPECT_TRUE(contains(result.text, said)) << result.text;
  }
  EXPECT_EQ(run(command("--format xyz")).status, 2);
  EXPECT_EQ(run(command("--report " + path("report.json"))).status, 2);
}

TEST_F(Export, an_export_is_not_replaced_unasked) {
  expect_done(command("--index 0"));
  EXPECT_EQ(run(command("--index 1")).status, 1);
  expect_done(command("--index 1 --overwrite"));
}

}  // namespace
}  // namespace lidar_upsampling
