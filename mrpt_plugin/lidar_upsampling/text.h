// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <algorithm>
#include <cmath>
#include <exception>
#include <istream>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace lidar_upsampling {

/// The text without the `blanks` at its ends.
[[nodiscard]] inline std::string trimmed(const std::string& text, const char* blanks = " \t\r") {
  const auto first = text.find_first_not_of(blanks);
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// What stands between the commas of a line, each trimmed; an empty one at the end is none.
[[nodiscard]] inline std::vector<std::string> comma_separated(const std::string& line,
                                                              const char* blanks = " \t\r") {
  std::vector<std::string> fields;
  std::istringstream stream(line);
  for (std::string field; std::getline(stream, field, ',');)
    fields.push_back(trimmed(field, blanks));
  return fields;
}

/// @brief A text file's next line, as by std::getline; a file of another kind is not read to its
/// end first. @throw std::invalid_argument it is no text, or longer than any line of a table.
inline bool next_line(std::istream& file, std::string& line) {
  constexpr std::size_t kMostBytes = 1U << 16U;
  line.clear();
  for (char c = 0; file.get(c);) {
    if (c == '\n') return true;
    if (c == '\0' || line.size() == kMostBytes)
      throw std::invalid_argument("this is no table in text");
    line.push_back(c);
  }
  return !line.empty();
}

/// The finite number that the text is from end to end; none: it is something else.
[[nodiscard]] inline std::optional<double> number_in(const std::string& text) {
  std::size_t used = 0;
  double value = 0;
  try {
    value = std::stod(text, &used);
  } catch (const std::exception&) {
    return std::nullopt;
  }
  return used == text.size() && std::isfinite(value) ? std::make_optional(value) : std::nullopt;
}

/// @brief A line that can be read: of a very long one, as what quotes a file without line ends, its
/// begin and its end. Letters of UTF-8 stay whole.
[[nodiscard]] inline std::string shortened(const std::string& line, std::size_t most = 2000) {
  if (line.size() <= most) return line;
  const auto is_inside_letter = [&](std::size_t at) {
    return (static_cast<unsigned char>(line[at]) & 0xC0U) == 0x80U;
  };
  std::size_t head = 3 * most / 4, tail = line.size() - most / 4;
  while (head > 0 && is_inside_letter(head)) --head;
  while (tail < line.size() && is_inside_letter(tail)) ++tail;
  return line.substr(0, head) + " ... " + line.substr(tail);
}

/// @brief What an exception says, in one line: MRPT's own carry a call stack behind the message.
[[nodiscard]] inline std::string one_line(const std::exception& error) {
  std::string_view text = error.what();
  // MRPT's layout is "==== MRPT exception ====\nMessage: ...\nMsg prefix: ...\nLocation: ...".
  constexpr std::string_view kMark = "Message:";
  const auto at = text.find(kMark);
  if (text.find("MRPT exception") < at && at != std::string_view::npos) {
    text.remove_prefix(at + kMark.size());
  }
  text.remove_prefix(std::min(text.size(), text.find_first_not_of(" \t\n")));
  return shortened(std::string(text.substr(0, text.find('\n'))));
}

}  // namespace lidar_upsampling
