// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <map>
#include <string>
#include <vector>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// @brief A CSV file with a header line, without quoting.
class CsvTable {
 public:
  /// @throw std::runtime_error naming file and line: not readable, or a row of another length.
  explicit CsvTable(const std::string& path);

  [[nodiscard]] std::size_t num_rows() const { return rows_.size(); }
  [[nodiscard]] bool has(const std::string& column) const { return columns_.count(column) > 0; }
  /// @throw std::runtime_error no such column.
  [[nodiscard]] const std::string& text(std::size_t row, const std::string& column) const;
  /// @throw std::runtime_error no such column, or no number there.
  [[nodiscard]] double number(std::size_t row, const std::string& column) const;
  [[nodiscard]] long long integer(std::size_t row, const std::string& column) const;
  /// @return a stamp, as parse_stamp() reads it. @throw std::runtime_error none there.
  [[nodiscard]] Stamp stamp(std::size_t row, const std::string& column) const;

  /// "file, line 7, column x", for messages.
  [[nodiscard]] std::string place(std::size_t row, const std::string& column) const;

 private:
  std::string path_;
  std::map<std::string, std::size_t> columns_;
  std::vector<std::vector<std::string>> rows_;
  std::vector<std::size_t> lines_;  // of each row, from 1
};

}  // namespace lidar_upsampling
