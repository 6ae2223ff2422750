// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "simulator/section_reader.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace lidar_upsampling::sim {

namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : ", ") + word;
  return all;
}

bool starts_with(const std::string& text, const std::string& prefix) {
  return text.compare(0, prefix.size(), prefix) == 0;
}

}  // namespace

SectionReader::SectionReader(const mrpt::config::CConfigFileBase& config, std::string section)
    : config_(config), section_(std::move(section)) {}

bool SectionReader::text(const std::string& key, std::string& value) {
  known_.insert(key);
  if (!config_.keyExists(section_, key)) return false;
  value = config_.read_string(section_, key, value);
  return true;
}

bool SectionReader::choice(const std::string& key, std::string& value,
                           const std::vector<std::string>& choices) {
  std::string chosen;
  if (!text(key, chosen)) return false;
  if (std::find(choices.begin(), choices.end(), chosen) == choices.end()) {
    refuse(key, "is \"" + chosen + "\"; it can be " + joined(choices));
  }
  value = chosen;
  return true;
}

bool SectionReader::flag(const std::string& key, bool& value) {
  std::string chosen;
  if (!choice(key, chosen, {"true", "false"})) return false;
  value = chosen == "true";
  return true;
}

bool SectionReader::number(const std::string& key, double& value, double lowest, double highest,
                           double unit) {
  std::vector<double> one;
  if (!numbers(key, one, 1)) return false;
  if (one[0] < lowest || one[0] > highest) {
    std::ostringstream why;
    why << "is " << one[0] << "; it can be " << lowest << " to " << highest;
    refuse(key, why.str());
  }
  value = one[0] * unit;
  return true;
}

bool SectionReader::count(const std::string& key, unsigned& value, unsigned lowest,
                          unsigned highest) {
  double number_read = 0;
  if (!number(key, number_read, lowest, highest)) return false;
  if (number_read != std::floor(number_read)) refuse(key, "must be a whole number");
  value = static_cast<unsigned>(number_read);
  return true;
}

bool SectionReader::numbers(const std::string& key, std::vector<double>& values, std::size_t size) {
  std::string list;
  if (!text(key, list)) return false;
  std::replace(list.begin(), list.end(), ',', ' ');
  std::istringstream words(list);
  std::vector<double> read;
  for (double value = 0; words >> value;) read.push_back(value);
  const bool all_read = words.eof();
  if (!all_read || read.empty() || (size > 0 && read.size() != size)) {
    refuse(key, "is \"" + list + "\"; it needs " +
                    (size > 0 ? std::to_string(size) : std::string("some")) + " number" +
                    (size == 1 ? "" : "s"));
  }
  values = std::move(read);
  return true;
}

void SectionReader::refuse(const std::string& key, const std::string& why) const {
  throw std::invalid_argument("scenario: [" + section_ + "] " + key + " " + why);
}

void SectionReader::finish() const {
  if (!config_.sectionExists(section_)) return;
  std::vector<std::string> keys;
  config_.getAllKeys(section_, keys);
  for (const std::string& key : keys) {
    if (known_.count(key) > 0) continue;
    refuse(key, "is no key of this section; they are " +
                    joined(std::vector<std::string>(known_.begin(), known_.end())));
  }
}

std::vector<std::string> named_sections(const mrpt::config::CConfigFileBase& config,
                                        const std::string& prefix) {
  std::vector<std::string> sections, names;
  config.getAllSections(sections);
  for (const std::string& section : sections) {
    if (starts_with(section, prefix)) names.push_back(section.substr(prefix.size()));
  }
  return names;
}

void refuse_other_sections(const mrpt::config::CConfigFileBase& config,
                           const std::vector<std::string>& known) {
  std::vector<std::string> sections;
  config.getAllSections(sections);
  for (const std::string& section : sections) {
    const bool accepted = std::any_of(known.begin(), known.end(), [&](const std::string& name) {
      return name.back() == '.' ? starts_with(section, name) : section == name;
    });
    if (!accepted && !section.empty()) {
      throw std::invalid_argument("scenario: [" + section +
                                  "] is no section of a scenario; they are " + joined(known));
    }
  }
}

}  // namespace lidar_upsampling::sim
