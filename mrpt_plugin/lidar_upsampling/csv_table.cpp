// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/csv_table.h"

#include <fstream>
#include <sstream>
#include <stdexcept>

#include "lidar_upsampling/text.h"

namespace lidar_upsampling {

namespace {

template <typename Value>
Value parsed(const std::string& text, const std::string& where) {
  std::istringstream stream(text);
  Value value{};
  stream >> value;
  if (!stream || stream.peek() != std::istringstream::traits_type::eof())
    throw std::runtime_error(where + ": '" + text + "' is no number");
  return value;
}

}  // namespace

CsvTable::CsvTable(const std::string& path) : path_(path) {
  std::ifstream file(path);
  std::string line;
  if (!file || !std::getline(file, line))
    throw std::runtime_error(path + ": cannot be read, or is empty");
  constexpr const char* kByteOrderMark = "\xEF\xBB\xBF";
  if (line.rfind(kByteOrderMark, 0) == 0) line.erase(0, 3);
  // An empty last cell counts, in the header as below it.
  const auto cells_of = [](const std::string& row) {
    std::vector<std::string> cells = comma_separated(row);
    if (trimmed(row).back() == ',') cells.emplace_back();
    return cells;
  };
  if (trimmed(line).empty()) throw std::runtime_error(path + ": its first line is empty");
  const auto names = cells_of(line);
  for (std::size_t i = 0; i < names.size(); ++i) columns_[names[i]] = i;
  for (std::size_t number = 2; std::getline(file, line); ++number) {
    if (trimmed(line).empty()) continue;
    rows_.push_back(cells_of(line));
    lines_.push_back(number);
    if (rows_.back().size() != names.size())
      throw std::runtime_error(path + ", line " + std::to_string(number) + ": " +
                               std::to_string(rows_.back().size()) +
                               " cells where the header has " + std::to_string(names.size()));
  }
}

std::string CsvTable::place(std::size_t row, const std::string& column) const {
  return path_ + ", line " + std::to_string(lines_[row]) + ", column " + column;
}

const std::string& CsvTable::text(std::size_t row, const std::string& column) const {
  const auto found = columns_.find(column);
  if (found == columns_.end()) throw std::runtime_error(path_ + ": has no column '" + column + "'");
  return rows_[row][found->second];
}

double CsvTable::number(std::size_t row, const std::string& column) const {
  return parsed<double>(text(row, column), place(row, column));
}

long long CsvTable::integer(std::size_t row, const std::string& column) const {
  return parsed<long long>(text(row, column), place(row, column));
}

Stamp CsvTable::stamp(std::size_t row, const std::string& column) const {
  try {
    return parse_stamp(text(row, column));
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(place(row, column) + ": " + error.what());
  }
}

}  // namespace lidar_upsampling
