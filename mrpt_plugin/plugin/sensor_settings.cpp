// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "plugin/sensor_settings.h"

#include <mrpt/config/CConfigFileMemory.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <stdexcept>

namespace lidar_upsampling {
namespace {

using mrpt::config::CConfigFileBase;
using mrpt::config::CConfigFileMemory;

constexpr const char* kIgnore = "rawlog-grabber-ignore";
const std::set<std::string> kOwnKeys{"rawlog",      "speed",           "sources",
                                     "max_wait_ms", "merge_window_ms", "linger_s"};
// Of CGenericSensor.
const std::set<std::string> kBaseKeys{"driver", "process_rate", "sensorLabel", "max_queue_len"};

[[noreturn]] void fail(const std::string& section, const std::string& key, const std::string& why) {
  throw std::invalid_argument("[" + section + "] " + key + ": " + why);
}

void read(const CConfigFileBase& source, const std::string& section, const std::string& key,
          double& value, double min) {
  if (!source.keyExists(section, key)) return;
  std::istringstream text(source.read_string(section, key, ""));
  double number = 0;
  if (!(text >> number) || !(text >> std::ws).eof() || !std::isfinite(number) || number < min)
    fail(section, key, "'" + text.str() + "' is no number from " + std::to_string(min) + " on");
  value = number;
}

std::vector<std::string> keys_of(const CConfigFileBase& source, const std::string& section) {
  std::vector<std::string> keys;
  source.getAllKeys(section, keys);
  return keys;
}

std::string joined(const std::set<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

void copy_section(const CConfigFileBase& source, const std::string& section,
                  const std::set<std::string>& without, CConfigFileMemory& target) {
  for (const std::string& key : keys_of(source, section))
    if (without.count(key) == 0) target.write(section, key, source.read_string(section, key, ""));
}

// The file's sections that can only be ours, as the method's front ends expect them.
CConfigFileMemory sections_of_the_method(const CConfigFileBase& source, const std::string& own) {
  CConfigFileMemory defaults, view;
  Config().saveToConfigFile(defaults, own);
  std::vector<std::string> sections;
  source.getAllSections(sections);
  for (const std::string& section : sections) {
    const bool is_ours = defaults.sectionExists(section) || section.rfind("camera.", 0) == 0 ||
                         section.rfind("lidar.", 0) == 0;
    const bool is_nobodys =
        source.read_bool(section, kIgnore, false) && !source.keyExists(section, "driver");
    if (section != own && !section.empty() && (is_ours || is_nobodys))
      copy_section(source, section, {kIgnore}, view);
  }
  check_sections(view);
  copy_section(source, own, kOwnKeys, view);
  return view;
}

void check_keys(const CConfigFileBase& source, const std::string& section) {
  CConfigFileMemory defaults;
  Config().saveToConfigFile(defaults, section);
  std::set<std::string> known = kOwnKeys;
  known.insert(kBaseKeys.begin(), kBaseKeys.end());
  for (const std::string& key : keys_of(defaults, section)) known.insert(key);
  for (const std::string& key : keys_of(source, section))
    if (known.count(key) == 0)
      fail(section, key, "there is no such setting; there are " + joined(known));
}

void load_own(const CConfigFileBase& source, const std::string& section, SensorSettings& settings) {
  read(source, section, "speed", settings.speed, 0);
  read(source, section, "max_wait_ms", settings.max_wait_ms, 0);
  read(source, section, "merge_window_ms", settings.merge_window_ms, 0);
  read(source, section, "linger_s", settings.linger_s, 0);
  settings.rawlog = source.read_string(section, "rawlog", "");
  std::istringstream names(source.read_string(section, "sources", ""));
  for (std::string name; std::getline(names >> std::ws, name, ',');) {
    name.erase(name.find_last_not_of(" \t\r") + 1);
    if (!name.empty()) settings.sources.push_back(name);
  }
  if (settings.rawlog.empty() == settings.sources.empty())
    fail(section, "rawlog, sources",
         "give one of both: a log to play, or the sections of the drivers");
}

}  // namespace

SensorSettings load_sensor_settings(const CConfigFileBase& source, const std::string& section) {
  SensorSettings settings;
  check_keys(source, section);
  load_own(source, section, settings);
  settings.into_frames = source.read_bool("global", "use_sensoryframes", false);
  const CConfigFileMemory view = sections_of_the_method(source, section);
  // Unless asked for, as they take more time than a live system on two cores has.
  settings.config.resample = "none";
  settings.config.point_tracks.max_points_per_object = 80;
  settings.config.loadFromConfigFile(view, section);
  settings.rig = load_rig_overrides(view);
  if (settings.config.mode != "causal")
    fail(section, "mode", "'" + settings.config.mode + "' needs what is yet to come; live: causal");
  if (settings.rawlog.empty() && !settings.config.pose_file.path.empty())
    fail("ego_motion", "poses_file",
         "'" + settings.config.pose_file.path +
             "' can have no poses of what is yet to happen: it needs a played log, rawlog = ...");
  return settings;
}

}  // namespace lidar_upsampling
