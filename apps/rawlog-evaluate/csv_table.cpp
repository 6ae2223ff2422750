// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "csv_table.h"

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace lidar_upsampling {

namespace {

std::vector<std::string> cells_of(std::string line) {
  if (!line.empty() && line.back() == '\r') line.pop_back();
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

template <typename Value>
Value parsed(const std::string& text, const std::string& where) {
  std::istringstream stream(text);
  Value value{};
  stream >> value;
  if (!stream || stream.peek() != std::istringstream::traits_type::eof())
    throw std::runtime_error(where + ": '" + text + "' is no number");
  return value;
}

std::string place(const std::string& path, std::size_t row, const std::string& column) {
  return path + ", line " + std::to_string(row + 2) + ", column " + column;
}

}  // namespace

CsvTable::CsvTable(const std::string& path) : path_(path) {
  std::ifstream file(path);
  std::string line;
  if (!file || !std::getline(file, line))
    throw std::runtime_error(path + ": cannot be read, or is empty");
  const auto names = cells_of(line);
  for (std::size_t i = 0; i < names.size(); ++i) columns_[names[i]] = i;
  while (std::getline(file, line)) {
    if (line.empty()) continue;
    rows_.push_back(cells_of(line));
    if (rows_.back().size() != names.size())
      throw std::runtime_error(path + ", line " + std::to_string(rows_.size() + 1) + ": " +
                               std::to_string(rows_.back().size()) +
                               " cells where the header has " + std::to_string(names.size()));
  }
}

const std::string& CsvTable::text(std::size_t row, const std::string& column) const {
  const auto found = columns_.find(column);
  if (found == columns_.end()) throw std::runtime_error(path_ + ": has no column '" + column + "'");
  return rows_[row][found->second];
}

double CsvTable::number(std::size_t row, const std::string& column) const {
  return parsed<double>(text(row, column), place(path_, row, column));
}

long long CsvTable::integer(std::size_t row, const std::string& column) const {
  return parsed<long long>(text(row, column), place(path_, row, column));
}

}  // namespace lidar_upsampling
