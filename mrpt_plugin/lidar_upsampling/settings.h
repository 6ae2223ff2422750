// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace lidar_upsampling {

struct Config;
struct Compression;

/// Limits of a number, both allowed.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool odd = false;  ///< of a whole number: an even one is not allowed
};

/// A value of a Config, as text.
struct Setting {
  std::string key, comment;
  std::function<std::string()> text;
  std::function<void(const std::string&)> set;  ///< @throw std::invalid_argument what is expected
};

struct SettingSection {
  std::string name;  ///< empty for the main section, whose name the front end chooses
  std::string comment;
  std::vector<Setting> settings;
};

/// The settings of a Config, written down one after the other. They refer to the values.
struct SettingList {
  std::vector<SettingSection> sections;

  void section(const char* name, const char* comment) { sections.push_back({name, comment, {}}); }
  void number(const char* key, double& value, Range range, const char* comment);
  void integer(const char* key, int& value, Range range, const char* comment);
  void flag(const char* key, bool& value, const char* comment);
  void text(const char* key, std::string& value, const char* comment);
  void list(const char* key, std::vector<std::string>& value, const char* comment);
  void word(const char* key, std::string& value, const std::vector<std::string>& choices,
            const char* comment);

  /// @param choices in the order of the enumerators.
  template <typename Enum>
  void choice_of(const char* key, Enum& value, const std::vector<std::string>& choices,
                 const char* comment) {
    choice(
        key, choices, comment, [&value] { return static_cast<std::size_t>(value); },
        [&value](std::size_t position) { value = static_cast<Enum>(position); });
  }

  void packing(const char* key, Compression& value, const char* comment);

  /// What the last setting was called before, so that files from then still work.
  void former(const std::string& text, const std::string& now);

 private:
  template <typename T, typename Read>
  void add(const char* key, T& value, const std::string& comment, Read read);
  void choice(const char* key, const std::vector<std::string>& choices, const char* comment,
              const std::function<std::size_t()>& position,
              const std::function<void(std::size_t)>& set);
};

/// @brief Every setting there is: loading, saving and the commented default file all go through
/// this one list.
/// @param config what the settings refer to; must outlive them.
[[nodiscard]] std::vector<SettingSection> settings_of(Config& config);

}  // namespace lidar_upsampling
