// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "plugin/driver_sources.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "lidar_upsampling/text.h"

namespace lidar_upsampling {

using mrpt::hwdrivers::CGenericSensor;
using mrpt::obs::CObservation;

namespace {

std::runtime_error error_in(const std::string& section, const std::string& what) {
  return std::runtime_error("[" + section + "]: " + what);
}

Driver make_driver(const mrpt::config::CConfigFileBase& config, const std::string& section) {
  if (!config.sectionExists(section))
    throw error_in(section, "there is no such section, but 'sources' names it");
  const std::string name = config.read_string(section, "driver", "");
  Driver driver{section, CGenericSensor::createSensorPtr(name)};
  if (!driver.sensor) throw error_in(section, "there is no driver '" + name + "'");
  try {
    driver.sensor->loadConfig(config, section);
  } catch (const std::exception& error) {
    throw error_in(section, one_line(error));
  }
  if (driver.sensor->getProcessRate() <= 0)
    throw error_in(section, "process_rate must be given, in Hz");
  return driver;
}

}  // namespace

std::vector<Driver> make_drivers(const mrpt::config::CConfigFileBase& config,
                                 const std::vector<std::string>& sections) {
  std::vector<Driver> drivers;
  drivers.reserve(sections.size());
  for (const std::string& section : sections) drivers.push_back(make_driver(config, section));
  return drivers;
}

DriverSources::DriverSources(std::vector<Driver> drivers, Pipeline& pipeline)
    : drivers_(std::move(drivers)), pipeline_(pipeline) {
  for (const Driver& driver : drivers_) {
    try {
      driver.sensor->initialize();
    } catch (const std::exception& error) {
      throw error_in(driver.section, one_line(error));
    }
  }
  for (const Driver& driver : drivers_) threads_.emplace_back([this, &driver] { poll(driver); });
}

DriverSources::~DriverSources() {
  stop_.stop();
  for (std::thread& thread : threads_) thread.join();
}

void DriverSources::poll(const Driver& driver) {
  const std::chrono::duration<double> period(1 / driver.sensor->getProcessRate());
  const auto step = std::chrono::duration_cast<std::chrono::steady_clock::duration>(period);
  auto next = std::chrono::steady_clock::now();
  try {
    do {
      driver.sensor->doProcess();
      for (const auto& [stamp, object] : driver.sensor->getObservations())
        if (const auto observation = std::dynamic_pointer_cast<CObservation>(object))
          pipeline_.push(observation);
      next = std::max(next + step, std::chrono::steady_clock::now());
    } while (!stop_.wait_until(next));
  } catch (const std::exception& error) {
    stop_.stop();
    pipeline_.finish("[" + driver.section + "]: " + one_line(error));
  }
}

}  // namespace lidar_upsampling
