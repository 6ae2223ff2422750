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

#include "lidar_upsampling/settings.h"
#include "lidar_upsampling/text.h"

namespace lidar_upsampling {
namespace {

using mrpt::config::CConfigFileBase;

std::string joined(const std::vector<std::string>& words, const char* separator) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : separator) + word;
  return text;
}

std::string to_text(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

class Loader : public SettingVisitor {
 public:
  Loader(const CConfigFileBase& source, std::string main_section)
      : source_(source), main_section_(std::move(main_section)) {}

  void section(const std::string& name, const std::string&) override {
    reject_unknown_keys();
    section_ = name.empty() ? main_section_ : name;
    known_.clear();
  }

  void number(const char* key, double& value, Range range, const char*) override {
    const auto text = read(key);
    if (!text) return;
    const auto read_value = number_in(*text);
    if (!read_value) fail(key, *text, "a number is expected");
    check(key, *text, *read_value, range);
    value = *read_value;
  }

  void integer(const char* key, int& value, Range range, const char* comment) override {
    double number_read = value;
    number(key, number_read, range, comment);
    if (number_read != std::floor(number_read))
      fail(key, to_text(number_read), "a whole number is expected");
    value = static_cast<int>(number_read);
    if (range.odd && value % 2 == 0) fail(key, std::to_string(value), "an odd number is expected");
  }

  void flag(const char* key, bool& value, const char*) override {
    const auto text = read(key);
    if (!text) return;
    if (*text == "1" || *text == "true" || *text == "yes" || *text == "on")
      value = true;
    else if (*text == "0" || *text == "false" || *text == "no" || *text == "off")
      value = false;
    else
      fail(key, *text, "true or false is expected");
  }

  void text(const char* key, std::string& value, const char*) override {
    if (const auto read_text = read(key)) value = *read_text;
  }

  void list(const char* key, std::vector<std::string>& value, const char*) override {
    const auto text = read(key);
    if (!text) return;
    value.clear();
    for (const std::string& word : comma_separated(*text))
      if (!word.empty()) value.push_back(word);
  }

  void choice(const char* key, int& value, const Choices& choices, const char*) override {
    const auto text = read(key);
    if (!text) return;
    const auto found = std::find(choices.begin(), choices.end(), *text);
    if (found == choices.end()) fail(key, *text, "the choices are " + joined(choices, ", "));
    value = static_cast<int>(found - choices.begin());
  }

  void reject_unknown_keys() const {
    if (section_.empty()) return;
    std::vector<std::string> keys;
    if (source_.sectionExists(section_)) source_.getAllKeys(section_, keys);
    for (const std::string& key : keys)
      if (known_.count(key) == 0 && !belongs_to_driver(key))
        throw std::invalid_argument("[" + section_ + "] " + key +
                                    ": there is no such setting; there are " +
                                    joined({known_.begin(), known_.end()}, ", "));
  }

 private:
  // A live sensor's section also holds the keys of MRPT's own sensor base class.
  [[nodiscard]] bool belongs_to_driver(const std::string& key) const {
    static const std::set<std::string> driver_keys{"driver",          "process_rate",
                                                   "sensorLabel",     "max_queue_len",
                                                   "grab_decimation", "external_images_format"};
    return section_ == main_section_ && main_section_ != kMainSection && driver_keys.count(key) > 0;
  }

  std::optional<std::string> read(const char* key) {
    known_.insert(key);
    if (!source_.sectionExists(section_) || !source_.keyExists(section_, key)) return {};
    return trimmed(source_.read_string(section_, key, ""));
  }

  void check(const char* key, const std::string& text, double value, Range range) const {
    if (value < range.min || value > range.max)
      fail(key, text, "it must lie between " + to_text(range.min) + " and " + to_text(range.max));
  }

  [[noreturn]] void fail(const char* key, const std::string& value, const std::string& why) const {
    throw std::invalid_argument("[" + section_ + "] " + key + " = '" + value + "': " + why);
  }

  const CConfigFileBase& source_;
  std::string main_section_, section_;
  std::set<std::string> known_;
};

// Tells each setting as a line of text.
class Writer : public SettingVisitor {
 public:
  void number(const char* key, double& value, Range, const char* comment) override {
    line(key, to_text(value), comment);
  }
  void integer(const char* key, int& value, Range, const char* comment) override {
    line(key, std::to_string(value), comment);
  }
  void flag(const char* key, bool& value, const char* comment) override {
    line(key, value ? "true" : "false", comment);
  }
  void text(const char* key, std::string& value, const char* comment) override {
    line(key, value, comment);
  }
  void list(const char* key, std::vector<std::string>& value, const char* comment) override {
    line(key, joined(value, ","), comment);
  }
  void choice(const char* key, int& value, const Choices& choices, const char* comment) override {
    line(key, choices.at(value), std::string(comment) + " (" + joined(choices, " | ") + ")");
  }

 protected:
  virtual void line(const char* key, const std::string& value, const std::string& comment) = 0;
};

class Saver : public Writer {
 public:
  Saver(CConfigFileBase& target, std::string main_section)
      : target_(target), main_section_(std::move(main_section)) {}

  void section(const std::string& name, const std::string&) override {
    section_ = name.empty() ? main_section_ : name;
  }

 private:
  void line(const char* key, const std::string& value, const std::string&) override {
    target_.write(section_, key, value);
  }

  CConfigFileBase& target_;
  std::string main_section_, section_;
};

class Documenter : public Writer {
 public:
  void section(const std::string& name, const std::string& comment) override {
    text_ << (text_.tellp() > 0 ? "\n" : "") << "# " << comment << "\n["
          << (name.empty() ? kMainSection : name) << "]\n";
  }
  [[nodiscard]] std::string result() const { return text_.str(); }

 private:
  void line(const char* key, const std::string& value, const std::string& comment) override {
    text_ << "# " << comment << '\n' << key << " =" << (value.empty() ? "" : " ") << value << '\n';
  }

  std::ostringstream text_;
};

// The published method: every object by its own pose, found in points enough for chance to be out
// of the question; the points are moved, no more.
void leave_the_picture_alone(Config& config) {
  config.resample = "none";
  config.point_tracks.own_surface = false;
  config.ego_motion.fuse = false;
  config.object_motion.world_tracks = false;
  config.object_motion.picture.min_points = 20;
  config.object_motion.picture.pose.min_inliers = 15;
  config.object_tracks.scan_factor = false;
  config.object_tracks.piece_share = 0;
}

}  // namespace

void SettingVisitor::word(const char* key, std::string& value, const Choices& choices,
                          const char* comment) {
  const auto found = std::find(choices.begin(), choices.end(), value);
  int position = found == choices.end() ? 0 : static_cast<int>(found - choices.begin());
  choice(key, position, choices, comment);
  value = choices.at(position);
}

void Config::loadFromConfigFile(const CConfigFileBase& source, const std::string& section) {
  Loader loader(source, section);
  visit_settings(*this, loader);
  loader.reject_unknown_keys();
  if (preset == "paper") leave_the_picture_alone(*this);
}

void Config::saveToConfigFile(CConfigFileBase& target, const std::string& section) const {
  Saver saver(target, section);
  Config copy = *this;
  visit_settings(copy, saver);
}

std::string Config::virtual_label(const std::string& real_label) const {
  return output_label.empty() ? real_label + "_VIRTUAL" : output_label;
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
      throw std::invalid_argument("[" + section + "]: there is no such section; there are " +
                                  joined(known, ", ") + ", camera.<LABEL>, lidar.<LABEL>");
  }
}

std::string default_ini() {
  Documenter documenter;
  Config defaults;
  visit_settings(defaults, documenter);
  return documenter.result();
}

}  // namespace lidar_upsampling
