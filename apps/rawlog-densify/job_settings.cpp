// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "job_settings.h"

#include <mrpt/config/CConfigFileMemory.h>

#include <stdexcept>

#include "lidar_upsampling/ini_text.h"

namespace lidar_upsampling {
namespace {

// Sections of the INI that belong to us; a file may hold other programs' sections too, but of its
// keys one that is given by --set must be known.
void set_key(mrpt::config::CConfigFileMemory& config, IniText& file,
             const std::string& assignment) {
  const auto equals = assignment.find('=');
  const std::string name = assignment.substr(0, equals);
  const auto dot = name.rfind('.');
  const std::string section = dot == std::string::npos ? kMainSection : name.substr(0, dot);
  const std::string key = dot == std::string::npos ? name : name.substr(dot + 1);
  if (equals == std::string::npos || section.empty() || key.empty())
    throw std::runtime_error("--set " + assignment +
                             ": expected name=value, or section.name=value");
  config.write(section, key, assignment.substr(equals + 1));
  file.line_of.erase("[" + section + "] " + key);  // what is wrong with it now is not the file's
}

void load(DensifyJob& job, const mrpt::config::CConfigFileMemory& config) {
  check_sections(config);
  job.config.loadFromConfigFile(config, kMainSection);
  job.rig = load_rig_overrides(config);
}

}  // namespace

void load_settings(DensifyJob& job, const std::string& path, const std::vector<std::string>& sets,
                   const std::string& detections) {
  mrpt::config::CConfigFileMemory config;
  IniText file;
  if (!path.empty()) {
    file = read_ini(path);
    config.setContent(file.text);
  }
  for (const std::string& assignment : sets) set_key(config, file, assignment);
  if (!detections.empty()) {
    config.write("detector", "type", std::string("csv"));
    config.write("detector", "boxes", detections);
  }
  try {
    load(job, config);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(file.located(error.what()));
  }
}

}  // namespace lidar_upsampling
