// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors

// Takes scans out of a log, as files that other programs read.
#include <Eigen/Geometry>
#include <filesystem>
#include <iostream>
#include <sstream>
#include <utility>

#include "chosen_scans.h"
#include "common/tool_main.h"
#include "lidar_upsampling/io/file_places.h"
#include "lidar_upsampling/io/output_file.h"
#include "lidar_upsampling/types.h"
#include "scan_files.h"
#include "scene_files.h"

namespace lidar_upsampling::exporting {
namespace {

struct Options {
  std::string input, output, format = "ply", label, stamp, report;
  int index = -1, track = -1;
  bool overwrite = false, accept_truncated = false;
};

/// The folder's index.csv, a row per file; written when all files are there.
class IndexTable {
 public:
  IndexTable(std::string folder, bool overwrite)
      : folder_(std::move(folder)), path_(folder_ + "/index.csv") {
    if (!overwrite && std::filesystem::exists(path_))
      throw std::runtime_error(folder_ + " holds an export already; --overwrite replaces it");
    if (std::filesystem::exists(folder_))  // whether it can be written is told before the work
      static_cast<void>(output_place(path_, true));
    rows_ << "file,label,stamp,unix_time,points,x,y,z,qx,qy,qz,qw\n";
  }
  void make_folder() const {
    std::error_code error;
    std::filesystem::create_directories(folder_, error);
    if (error) throw std::runtime_error(folder_ + ": cannot make this folder: " + error.message());
  }
  void add(const std::string& file, const LidarScan& scan) {
    const Eigen::Vector3d t = scan.T_vehicle_lidar.translation();
    const Eigen::Quaterniond q(scan.T_vehicle_lidar.linear());
    rows_ << file << ',' << scan.label << ',' << scan.stamp.time_since_epoch().count() << ','
          << to_text(scan.stamp) << ',' << scan.size() << ',' << t.x() << ',' << t.y() << ','
          << t.z() << ',' << q.x() << ',' << q.y() << ',' << q.z() << ',' << q.w() << '\n';
  }
  void write() const { write_file(path_, rows_.str()); }

 private:
  std::string folder_, path_;
  std::ostringstream rows_;
};

Choice choice_of(const Options& options, const std::map<Stamp, ObjectsAt>& objects) {
  Choice choice;
  choice.label = options.label;
  if (options.index >= 0) choice.index = static_cast<std::size_t>(options.index);
  if (!options.stamp.empty()) choice.stamp = parse_stamp(options.stamp);
  if (options.track >= 0) {
    const auto stamps = instants_of(options.track, objects);
    if (stamps.empty())
      throw std::runtime_error(options.report + ": has no track " + std::to_string(options.track));
    choice.stamp = stamps[stamps.size() / 2];
  }
  return choice;
}

// @param number of the scans of its stamp so far.
std::string write_one(const Options& options, const std::map<Stamp, ObjectsAt>& objects,
                      const LidarScan& scan, int number) {
  std::string name =
      options.track >= 0 ? "track_" + std::to_string(options.track) : to_text(scan.stamp);
  if (number > 1) name += "-" + std::to_string(number);
  const std::string file = name + "." + options.format;
  const std::string path = (std::filesystem::path(options.output) / file).string();
  if (options.track >= 0) {
    write_trail(path, options.track, objects, scan);
  } else if (options.format == "3Dscene") {
    const auto found = objects.find(scan.stamp);
    write_scene(path, scan, found == objects.end() ? ObjectsAt{} : found->second);
  } else if (options.format == "bin") {
    write_bin(path, scan);
  } else {
    write_ply(path, scan);
  }
  return file;
}

void export_scans(const Options& options) {
  std::map<Stamp, ObjectsAt> objects;
  if (!options.report.empty()) objects = read_report(options.report);
  const Choice choice = choice_of(options, objects);
  IndexTable table(options.output, options.overwrite);
  ReadScans read;
  std::map<Stamp, int> num_of_stamp;
  {
    Progress progress("exporting");
    read = for_each_chosen_scan({options.input, options.accept_truncated}, choice,
                                std::ref(progress), [&](const LidarScan& scan) {
                                  table.make_folder();
                                  const int number = ++num_of_stamp[scan.stamp];
                                  table.add(write_one(options, objects, scan, number), scan);
                                });
  }
  for (const auto& count : read.unused) warn("rawlog-export", to_text(count));
  if (read.damage) warn("rawlog-export", *read.damage);
  if (read.count == 0)
    throw std::runtime_error(options.input + ": none of the chosen scans can be used");
  table.write();
  std::cout << read.count << (read.count == 1 ? " file" : " files") << " in " << options.output
            << ", listed in its index.csv\n";
}

}  // namespace
}  // namespace lidar_upsampling::exporting

int main(int argc, char** argv) {
  using lidar_upsampling::exporting::Options;
  Options options;
  CLI::App app("Takes virtual or real scans out of a log, as files that other programs read",
               "rawlog-export");
  app.add_option("input,-i,--input", options.input, "the log")->required();
  app.add_option("-o,--output", options.output, "folder for the files and their index.csv")
      ->required();
  app.add_option("--format", options.format,
                 "PLY, KITTI's velodyne format, or a scene for SceneViewer3D")
      ->check(CLI::IsMember({"ply", "bin", "3Dscene"}))
      ->capture_default_str();
  app.add_option("--label", options.label, "sensor label; without it, that of the virtual scans");
  auto* const index = app.add_option("--index", options.index, "only this scan, from 0")
                          ->check(CLI::Range(0, 1000000000));
  auto* const stamp = app.add_option("--stamp", options.stamp,
                                     "only the nearest scan: UNIX seconds, or MRPT ticks");
  auto* const report = app.add_option("--report", options.report,
                                      "objects to draw into scenes, from rawlog-densify --report");
  auto* const track = app.add_option("--track", options.track,
                                     "one scene of this object's way, with its boxes and path")
                          ->check(CLI::Range(0, 1000000000));
  index->excludes(stamp)->excludes(track);
  stamp->excludes(track);
  track->needs(report);
  app.add_flag("--overwrite", options.overwrite, "replace an export in the folder");
  app.add_flag("--accept-truncated", options.accept_truncated,
               "of a damaged log, take all that can be read, before and behind the damage");
  app.callback([&] {
    if (options.format != "3Dscene" && (*report || *track))
      throw CLI::ValidationError("--report and --track need --format 3Dscene");
  });
  app.footer("Examples:\n  rawlog-export -i dense.rawlog -o clouds --format ply");
  return lidar_upsampling::run_tool(app, argc, argv,
                                    [&] { lidar_upsampling::exporting::export_scans(options); });
}
