// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors

// Turns a drive in KITTI's raw layout into a log: scans LIDAR, images CAM0 to CAM3, poses OXTS.
#include <mrpt/obs/CObservationRobotPose.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <limits>

#include "common/tool_main.h"
#include "kitti2rawlog/kitti_calibration.h"
#include "kitti2rawlog/kitti_drive.h"
#include "kitti2rawlog/kitti_frames.h"
#include "lidar_upsampling/io/carriers.h"
#include "lidar_upsampling/io/images.h"
#include "lidar_upsampling/io/rawlog_stream.h"

namespace fs = std::filesystem;

namespace lidar_upsampling::kitti {
namespace {

struct Options {
  std::string drive;
  std::string output;
  std::vector<int> cameras = {2};
  int first = 0;
  int last = std::numeric_limits<int>::max() - 1;
  bool overwrite = false;
};

// Makes the observation of one frame; frames of all sensors are put in the order of their stamps.
using MakeObservation = std::function<mrpt::obs::CObservation::Ptr(const Frame&)>;
struct TimedFrame {
  Frame frame;
  const MakeObservation* make;
};

struct Sensor {
  std::string folder;  // below the drive's
  std::vector<std::string> extensions;
  MakeObservation make;
};

mrpt::obs::CObservation::Ptr pose_observation(const Frame& frame, OxtsReader& oxts) {
  const auto observation = mrpt::obs::CObservationRobotPose::Create();
  observation->timestamp = frame.stamp;
  observation->sensorLabel = "OXTS";
  observation->pose.mean = to_mrpt(oxts.T_world_vehicle(frame.path));
  return observation;
}

std::vector<Sensor> sensors_of(const Options& options, const Calibration& calibration,
                               OxtsReader& oxts) {
  std::vector<Sensor> sensors;
  sensors.push_back({"velodyne_points", {".bin"}, [&calibration](const Frame& frame) {
                       return observation_from_scan(read_scan(frame, calibration.T_vehicle_lidar),
                                                    Carrier::automatic);
                     }});
  for (const int number : options.cameras) {
    const auto camera = calibration.cameras.find(number);
    if (camera == calibration.cameras.end()) {
      throw std::runtime_error("no calibration of camera " + std::to_string(number));
    }
    sensors.push_back({"image_0" + std::to_string(number),
                       {".png", ".jpg"},
                       [&camera = camera->second](const Frame& frame) {
                         return observation_from_image(read_image(frame, camera));
                       }});
  }
  if (fs::is_directory(options.drive + "/oxts")) {
    sensors.push_back(
        {"oxts", {".txt"}, [&oxts](const Frame& frame) { return pose_observation(frame, oxts); }});
  }
  return sensors;
}

void report_missing(const std::string& folder, const SensorFolder& list) {
  if (list.missing.empty()) return;
  std::cerr << "kitti2rawlog: warning: " << folder << ": " << list.missing.size() << " of "
            << list.missing.size() + list.frames.size() << " frames missing, from "
            << list.missing.front() << " to " << list.missing.back() << ": skipped\n";
}

std::vector<TimedFrame> frames_in_time_order(const Options& options,
                                             const std::vector<Sensor>& sensors) {
  std::vector<TimedFrame> frames;
  for (const Sensor& sensor : sensors) {
    const SensorFolder list = list_frames(options.drive + "/" + sensor.folder, sensor.extensions,
                                          options.first, options.last);
    report_missing(sensor.folder, list);
    if (list.frames.empty()) {
      throw std::runtime_error("no frame of " + options.drive + "/" + sensor.folder +
                               " is there, or none within --first and --last");
    }
    for (const Frame& frame : list.frames) frames.push_back({frame, &sensor.make});
    std::cout << sensor.folder << ": " << list.frames.size() << " frames\n";
  }
  std::stable_sort(frames.begin(), frames.end(), [](const TimedFrame& a, const TimedFrame& b) {
    return a.frame.stamp < b.frame.stamp;
  });
  return frames;
}

void convert(const Options& options) {
  if (!fs::is_directory(options.drive)) {
    throw std::runtime_error("there is no folder " + options.drive);
  }
  // The day's calibration lies one folder up.
  const fs::path day = fs::canonical(options.drive).parent_path();
  const Calibration calibration = read_calibration(day.string());
  OxtsReader oxts;
  const std::vector<Sensor> sensors = sensors_of(options, calibration, oxts);
  RawlogWriter writer(options.output, options.overwrite);
  const std::vector<TimedFrame> frames = frames_in_time_order(options, sensors);
  {
    Progress progress("converting");
    for (const TimedFrame& timed : frames) {
      writer.write(*(*timed.make)(timed.frame));
      progress(static_cast<double>(writer.num_written()) / static_cast<double>(frames.size()));
    }
  }
  writer.commit();
  std::cout << writer.num_written() << " observations in " << options.output << "\n";
}

}  // namespace
}  // namespace lidar_upsampling::kitti

int main(int argc, char** argv) {
  lidar_upsampling::kitti::Options options;
  CLI::App app(
      "Turns a drive in KITTI's raw layout into a log. The vehicle frame is that of the OXTS unit.",
      "kitti2rawlog");
  app.add_option("--drive", options.drive, "Folder of the drive, the calibration files one up")
      ->required();
  app.add_option("--output", options.output, "The log to write")->required();
  app.add_option("--cameras", options.cameras, "KITTI's camera numbers, as 2 or 0,1,2,3")
      ->delimiter(',')
      ->check(CLI::Range(0, 3))
      ->capture_default_str();
  app.add_option("--first", options.first, "First frame")->check(CLI::Range(0, 1000000000));
  app.add_option("--last", options.last, "Last frame, included")->check(CLI::Range(0, 1000000000));
  app.add_flag("--overwrite", options.overwrite, "Replace an existing output");
  return lidar_upsampling::run_tool(app, argc, argv,
                                    [&] { lidar_upsampling::kitti::convert(options); });
}
