// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/config.h"

#include <mrpt/config/CConfigFileBase.h>
#include <mrpt/config/CConfigFileMemory.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <stdexcept>

#include "lidar_upsampling/nearest_word.h"
#include "lidar_upsampling/settings.h"
#include "lidar_upsampling/text.h"
#include "lidar_upsampling/virtual_label.h"

namespace lidar_upsampling {
namespace {

using mrpt::config::CConfigFileBase;

std::string joined(const std::vector<std::string>& words, const char* separator) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : separator) + word;
  return text;
}

template <typename Number>
std::string to_text(Number value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

std::string to_text(bool value) { return value ? "true" : "false"; }

std::string to_text(const std::string& value) { return value; }

std::string to_text(const std::vector<std::string>& words) { return joined(words, ","); }

double number_from(const std::string& text, const Range& range) {
  const auto value = number_in(text);
  if (!value) throw std::invalid_argument("a number is expected");
  if (*value < range.min || *value > range.max)
    throw std::invalid_argument("it must lie between " + to_text(range.min) + " and " +
                                to_text(range.max));
  return *value;
}

int integer_from(const std::string& text, const Range& range) {
  const double value = number_from(text, range);
  if (value != std::floor(value)) throw std::invalid_argument("a whole number is expected");
  if (range.odd && std::fmod(value, 2) == 0)
    throw std::invalid_argument("an odd number is expected");
  return static_cast<int>(value);
}

bool flag_from(const std::string& text) {
  if (text == "1" || text == "true" || text == "yes" || text == "on") return true;
  if (text == "0" || text == "false" || text == "no" || text == "off") return false;
  throw std::invalid_argument("true or false is expected");
}

std::size_t choice_from(const std::string& text, const std::vector<std::string>& choices) {
  const auto found = std::find(choices.begin(), choices.end(), text);
  if (found == choices.end())
    throw std::invalid_argument("the choices are " + joined(choices, ", "));
  return static_cast<std::size_t>(found - choices.begin());
}

std::string with_choices(const std::string& comment, const std::vector<std::string>& choices) {
  return comment + " (" + joined(choices, " | ") + ")";
}

std::vector<std::string> words_from(const std::string& text) {
  std::vector<std::string> words = comma_separated(text);
  words.erase(std::remove(words.begin(), words.end(), std::string()), words.end());
  return words;
}

// A live sensor's section also holds the keys of MRPT's own sensor base class.
bool belongs_to_driver(const std::string& key) {
  static const std::set<std::string> driver_keys{"driver",          "process_rate",
                                                 "sensorLabel",     "max_queue_len",
                                                 "grab_decimation", "external_images_format"};
  return driver_keys.count(key) > 0;
}

std::string those_there_are(const std::string& meant, const std::vector<std::string>& known) {
  return meant + (meant.empty() ? "; there are " : " There are ") + joined(known, ", ");
}

// Of the same section, or of that name in another.
std::string meant_by(const std::string& key, const std::set<std::string>& known) {
  const std::string meant = did_you_mean(key, {known.begin(), known.end()});
  if (!meant.empty()) return meant;
  Config defaults;
  for (const SettingSection& other : settings_of(defaults))
    for (const Setting& setting : other.settings)
      if (setting.key == key)
        return "; did you mean that of [" +
               (other.name.empty() ? std::string(kMainSection) : other.name) + "]?";
  return {};
}

void reject_unknown_keys(const SettingSection& section, const CConfigFileBase& source,
                         const std::string& name) {
  std::set<std::string> known;
  for (const Setting& setting : section.settings) known.insert(setting.key);
  const bool is_of_driver = section.name.empty() && name != kMainSection;
  std::vector<std::string> keys;
  source.getAllKeys(name, keys);
  for (const std::string& key : keys)
    if (known.count(key) == 0 && !(is_of_driver && belongs_to_driver(key)))
      throw std::invalid_argument(
          "[" + name + "] " + key + ": there is no such setting" +
          those_there_are(meant_by(key, known), {known.begin(), known.end()}));
}

void load(const SettingSection& section, const CConfigFileBase& source, const std::string& name) {
  if (!source.sectionExists(name)) return;
  for (const Setting& setting : section.settings) {
    if (!source.keyExists(name, setting.key)) continue;
    const std::string text = trimmed(source.read_string(name, setting.key, ""));
    try {
      setting.set(text);
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument("[" + name + "] " + setting.key + " = '" + text +
                                  "': " + error.what());
    }
  }
  reject_unknown_keys(section, source, name);
}

// The published method: every object by its own pose, found in points enough for chance to be out
// of the question; the points are moved, no more.
void leave_the_picture_alone(Config& config) {
  config.resample = "none";
  config.klt.align_first = false;
  config.point_tracks.own_surface = false;
  config.point_tracks.max_points_per_object = 150;
  config.ego_motion.fuse = false;
  config.object_motion.world_tracks = false;
  config.object_motion.picture.min_points = 20;
  config.object_motion.picture.pose.min_inliers = 15;
  config.object_tracks.scan_factor = false;
  config.object_tracks.piece_share = 0;
}

}  // namespace

template <typename T, typename Read>
void SettingList::add(const char* key, T& value, const std::string& comment, Read read) {
  sections.back().settings.push_back(
      {key, comment, [&value] { return to_text(value); },
       [&value, read](const std::string& text) { value = read(text); }});
}

void SettingList::number(const char* key, double& value, Range range, const char* comment) {
  add(key, value, comment, [range](const std::string& text) { return number_from(text, range); });
}

void SettingList::integer(const char* key, int& value, Range range, const char* comment) {
  add(key, value, comment, [range](const std::string& text) { return integer_from(text, range); });
}

void SettingList::packing(const char* key, Compression& value, const char* comment) {
  add(key, value, comment, parse_compression);
}

void SettingList::flag(const char* key, bool& value, const char* comment) {
  add(key, value, comment, flag_from);
}

void SettingList::text(const char* key, std::string& value, const char* comment) {
  add(key, value, comment, [](const std::string& text) { return text; });
}

void SettingList::list(const char* key, std::vector<std::string>& value, const char* comment) {
  add(key, value, comment, words_from);
}

void SettingList::word(const char* key, std::string& value, const std::vector<std::string>& choices,
                       const char* comment) {
  add(key, value, with_choices(comment, choices),
      [choices](const std::string& text) { return choices[choice_from(text, choices)]; });
}

void SettingList::choice(const char* key, const std::vector<std::string>& choices,
                         const char* comment, const std::function<std::size_t()>& position,
                         const std::function<void(std::size_t)>& set) {
  sections.back().settings.push_back(
      {key, with_choices(comment, choices), [choices, position] { return choices.at(position()); },
       [choices, set](const std::string& text) { set(choice_from(text, choices)); }});
}

void SettingList::former(const std::string& text, const std::string& now) {
  Setting& setting = sections.back().settings.back();
  setting.set = [set = setting.set, text, now](const std::string& given) {
    set(given == text ? now : given);
  };
}

void Config::loadFromConfigFile(const CConfigFileBase& source, const std::string& main_section) {
  for (const SettingSection& section : settings_of(*this))
    load(section, source, section.name.empty() ? main_section : section.name);
  if (preset == "paper") leave_the_picture_alone(*this);
}

void Config::saveToConfigFile(CConfigFileBase& target, const std::string& main_section) const {
  Config copy = *this;
  for (const SettingSection& section : settings_of(copy))
    for (const Setting& setting : section.settings)
      target.write(section.name.empty() ? main_section : section.name, setting.key, setting.text());
}

std::string Config::virtual_label(const std::string& real_label) const {
  return output_label.empty() ? real_label + kVirtualEnding : output_label;
}

void check_sections(const CConfigFileBase& source) {
  mrpt::config::CConfigFileMemory defaults;
  Config().saveToConfigFile(defaults, kMainSection);
  std::vector<std::string> sections, known;
  source.getAllSections(sections);
  defaults.getAllSections(known);
  for (const std::string& section : sections) {
    if (section.empty() || section.rfind("camera.", 0) == 0 || section.rfind("lidar.", 0) == 0)
      continue;
    if (std::find(known.begin(), known.end(), section) == known.end())
      throw std::invalid_argument("[" + section + "]: there is no such section" +
                                  those_there_are(did_you_mean(section, known), known) +
                                  ", camera.<LABEL>, lidar.<LABEL>");
  }
}

std::string default_ini() {
  Config defaults;
  std::string ini;
  for (const SettingSection& section : settings_of(defaults)) {
    ini += (ini.empty() ? "# " : "\n# ") + section.comment + "\n[" +
           (section.name.empty() ? kMainSection : section.name) + "]\n";
    for (const Setting& setting : section.settings) {
      const std::string value = setting.text();
      ini += "# " + setting.comment + '\n' + setting.key + (value.empty() ? " =" : " = ") + value +
             '\n';
    }
  }
  return ini;
}

}  // namespace lidar_upsampling
