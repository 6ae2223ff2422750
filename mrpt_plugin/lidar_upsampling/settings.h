// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <initializer_list>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace lidar_upsampling {

struct Config;

/// Limits of a number, both allowed.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool odd = false;  ///< of a whole number: an even one is not allowed
};

/// The words that a setting may take.
using Choices = std::vector<std::string>;

/// @brief Visits every setting of a Config: loading, saving and the commented default file all go
/// through the one list of settings in settings.cpp.
class SettingVisitor {
 public:
  virtual ~SettingVisitor() = default;
  /// `name` is empty for the main section, whose name the front end chooses.
  virtual void section(const std::string& name, const std::string& comment) = 0;
  virtual void number(const char* key, double& value, Range range, const char* comment) = 0;
  virtual void integer(const char* key, int& value, Range range, const char* comment) = 0;
  virtual void flag(const char* key, bool& value, const char* comment) = 0;
  virtual void text(const char* key, std::string& value, const char* comment) = 0;
  virtual void list(const char* key, std::vector<std::string>& value, const char* comment) = 0;
  /// `value` is a position in `choices`.
  virtual void choice(const char* key, int& value, const Choices& choices, const char* comment) = 0;

  template <typename Enum>
  void choice_of(const char* key, Enum& value,
                 std::initializer_list<std::pair<const char*, Enum>> choices, const char* comment) {
    Choices words;
    int position = 0;
    for (const auto& [word, meaning] : choices) {
      if (meaning == value) position = static_cast<int>(words.size());
      words.emplace_back(word);
    }
    choice(key, position, words, comment);
    value = (choices.begin() + position)->second;
  }

  void word(const char* key, std::string& value, const Choices& choices, const char* comment);
};

void visit_settings(Config& config, SettingVisitor& visitor);

}  // namespace lidar_upsampling
