// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <nlohmann/json.hpp>
#include <sstream>

#include "evaluation.h"
#include "fuzz/file_set.h"
#include "fuzz/fuzz_folder.h"
#include "fuzz/log_mutations.h"
#include "fuzz/target.h"
#include "fuzz/yard.h"
#include "lidar_upsampling/config.h"
#include "lidar_upsampling/ego/pose_file.h"
#include "lidar_upsampling/objects/detector.h"
#include "page/run_report.h"
#include "rawlog-densify/densify.h"
#include "rawlog-densify/job_settings.h"
#include "rawlog-export/report_objects.h"
#include "simulator/scenario.h"
#include "truth.h"

namespace lidar_upsampling::fuzz {
namespace {

/// A target of files that are made when it first runs.
Target target_of(const std::string& name,
                 const std::function<std::map<std::string, std::string>()>& files,
                 const std::function<void(const FileSet&)>& read) {
  const auto made = [name, files]() -> FileSet& {
    static std::map<std::string, FileSet> sets;
    auto known = sets.find(name);
    if (known == sets.end()) known = sets.emplace(name, FileSet(name, files())).first;
    return known->second;
  };
  return {name,
          [made, read](Random& random) {
            made().spoil(random);
            read(made());
          },
          [made, read] {
            made().mend();
            read(made());
          }};
}

std::map<std::string, std::string> settings_files() {
  return {{"a.ini", default_ini() +
                        "\n[camera.CAM]\nfx_px = 60\nfy_px = 60\ncx_px = 48\ncy_px = 24\n"
                        "width_px = 96\nheight_px = 48\npose = 0.2 0 1.6 -90 0 -90\n"
                        "[lidar.LIDAR]\npose = 0 0 1.6 0 0 0\n"}};
}

void read_settings(const FileSet& files) {
  DensifyJob job;
  load_settings(job, files.path("a.ini"), {}, "");
}

std::map<std::string, std::string> scenario_files() {
  return {{"a.ini",
           "[scenario]\nduration_s = 0.4\nseed = 3\n[ego]\ny_m = -5.1\nspeed_mps = 8\n"
           "[lidar]\nrings = 32\ncolumns = 600\n[camera.CAM0]\nwidth = 414\nheight = 125\n"
           "[static]\npedestrians = 0\nbuildings = 1\n[vehicle.lead]\nx_m = 12\ny_m = -5.1\n"
           "speed_mps = 10\n[vehicle.other]\nx_m = 9\ny_m = 2\nspeed_mps = 1.4\n"}};
}

const std::string kStamps[] = {"132000000000000000", "132000000000333333", "132000000000666667"};

std::map<std::string, std::string> truth_files() {
  std::string objects =
      "stamp,id,class,x,y,z,yaw,pitch,roll,length,width,height,vx,vy,vz,yaw_rate,moving\n";
  std::string ego = "stamp,x,y,z,yaw,pitch,roll\n",
              ignored = "stamp,camera,left,top,right,bottom\n";
  for (const std::string& stamp : kStamps) {
    objects += stamp + ",1,car,7,1,0.9,0.1,0,0,4,1.8,1.5,0,1.2,0,0.02,1\n";
    objects += stamp + ",2,pedestrian,9,-3,0.9,0,0,0,0.6,0.6,1.7,,,,,0\n";
    ego += stamp + ",0,0,0,0,0,0\n";
    ignored += stamp + ",CAM,1,2,30,40\n";
  }
  return {{"a_objects.csv", objects}, {"a_ego.csv", ego}, {"a_ignored.csv", ignored}};
}

std::map<std::string, std::string> box_files() {
  std::string boxes = "label,stamp,class,score,left,top,right,bottom,track\n";
  for (const std::string& stamp : kStamps) boxes += "CAM," + stamp + ",car,0.9,20,10,60,40,5\n";
  return {{"boxes.csv", boxes}};
}

void read_boxes(const FileSet& files) {
  CsvDetectorOptions options;
  options.path = files.path("boxes.csv");
  const auto detector = make_csv_detector(options);
  for (int i = 0; i < 3; ++i) {
    CameraImage image;
    image.camera.label = "CAM";
    image.stamp = stamp_at(i);
    static_cast<void>(detector->detect(image));
  }
}

std::map<std::string, std::string> pose_files() {
  return {{"tum.txt",
           "# t x y z qx qy qz qw\n1317046450.0 0 0 0 0 0 0 1\n"
           "1317046450.1 1 2 3 0 0 0.70710678 0.70710678\n"},
          {"kitti.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n0 -1 0 1 1 0 0 2 0 0 1 3\n"},
          {"times.txt", "0.0\n0.1\n"},
          {"a.csv",
           "stamp,x,y,z,yaw,pitch,roll\n1317046450,0,0,0,0,0,0\n"
           "1317046450.1,1,0,0,0.1,0,0\n"}};
}

void read_poses(const FileSet& files) {
  std::optional<std::string> refused;
  for (const char* const name : {"tum.txt", "kitti.txt", "a.csv"}) {
    PoseFileOptions options;
    options.path = files.path(name);
    if (options.path.find("kitti") != std::string::npos) options.times = files.path("times.txt");
    try {
      for (const PoseSample& pose :
           read_pose_file(options, {stamp_at(0), stamp_at(3)}, Pose::Identity()))
        if (!pose.T_world_vehicle.matrix().allFinite()) throw Finding("a pose that is not finite");
    } catch (const std::runtime_error& error) {
      if (dynamic_cast<const Finding*>(&error) != nullptr) throw;
      refused = error.what();
    }
  }
  if (refused) throw std::runtime_error(*refused);
}

std::map<std::string, std::string> report_files() {
  const std::string log = in_work_folder("report_of.rawlog");
  write_file_of(log, whole_log(log_seeds().front()));
  DensifyJob job;
  job.input = log;
  job.output = in_work_folder("report_out.rawlog");
  job.rows_beside = in_work_folder("report.json");
  job.overwrite = true;
  std::ostringstream text;
  write_json(densify(job, nullptr), text);
  return {{"report.json", text.str()}};
}

void read_report(const FileSet& files) {
  static_cast<void>(load_run_report(files.path("report.json")));
  static_cast<void>(exporting::read_report(files.path("report.json")));
}

}  // namespace

std::vector<Target> text_targets() {
  return {target_of("settings", settings_files, read_settings),
          target_of("scenario", scenario_files,
                    [](const FileSet& files) {
                      static_cast<void>(sim::load_scenario(files.path("a.ini")));
                    }),
          target_of("truth", truth_files,
                    [](const FileSet& files) {
                      static_cast<void>(load_truth(files.path("a_objects.csv")));
                    }),
          target_of("boxes", box_files, read_boxes),
          target_of("poses", pose_files, read_poses),
          target_of("report", report_files, read_report)};
}

}  // namespace lidar_upsampling::fuzz
