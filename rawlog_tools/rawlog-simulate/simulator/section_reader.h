// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/config/CConfigFileBase.h>

#include <limits>
#include <set>
#include <string>
#include <vector>

namespace lidar_upsampling::sim {

/// @brief Reads one section of an INI, and knows in the end which keys nobody asked for.
/// Every function leaves its target alone and returns false where the key is absent, and throws
/// std::invalid_argument naming section and key where the value cannot be.
class SectionReader {
 public:
  SectionReader(const mrpt::config::CConfigFileBase& config, std::string section);

  bool text(const std::string& key, std::string& value);
  bool choice(const std::string& key, std::string& value, const std::vector<std::string>& choices);
  bool flag(const std::string& key, bool& value);
  /// Lowest and highest are in the INI's unit; the value is multiplied by `unit`.
  bool number(const std::string& key, double& value,
              double lowest = -std::numeric_limits<double>::infinity(),
              double highest = std::numeric_limits<double>::infinity(), double unit = 1);
  bool count(const std::string& key, unsigned& value, unsigned lowest = 0,
             unsigned highest = std::numeric_limits<unsigned>::max());
  /// Separated by blanks or commas; `size` 0: any number of them.
  bool numbers(const std::string& key, std::vector<double>& values, std::size_t size);

  /// @throw std::invalid_argument always.
  [[noreturn]] void refuse(const std::string& key, const std::string& why) const;
  /// @throw std::invalid_argument naming a key that no function above asked for.
  void finish() const;

 private:
  const mrpt::config::CConfigFileBase& config_;
  std::string section_;
  std::set<std::string> known_;
};

/// What follows the prefix in the sections' names, in the file's order of names.
[[nodiscard]] std::vector<std::string> named_sections(const mrpt::config::CConfigFileBase& config,
                                                      const std::string& prefix);

/// @param known names, or prefixes that end in a dot. @throw std::invalid_argument naming the
/// section.
void refuse_other_sections(const mrpt::config::CConfigFileBase& config,
                           const std::vector<std::string>& known);

}  // namespace lidar_upsampling::sim
