// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lidar_upsampling {

/// What a table's cell shows: a text, or a figure.
struct Cell {
  std::string text;
  std::optional<double> ranked;  ///< the least of them is marked; none: it does not compete
};

[[nodiscard]] Cell text_cell(std::string text);
[[nodiscard]] Cell count_cell(double count);
/// A figure of which less is better; a dash if not known.
[[nodiscard]] Cell error_cell(bool known, double value, int digits = 3);
/// A figure that is neither good nor bad.
[[nodiscard]] Cell plain_cell(bool known, double value, int digits);

struct HtmlRow {
  std::string name;
  std::vector<Cell> cells;
  std::string color;      ///< of the mark before the name, "#rrggbb"; empty: none
  std::string css_class;  ///< of the line; empty: none
  bool competes = true;   ///< for the marks of the least figures
};

struct HtmlTable {
  std::string caption;
  std::vector<std::string> columns;  ///< all but the names'
  std::vector<HtmlRow> rows;
  std::string note;           ///< below the table; empty: none
  bool rank_in_rows = false;  ///< the least figure of each line is marked, not of each column
};

/// A part of the page, with an entry in its table of contents.
struct Section {
  std::string id, title;
  std::string body;  ///< HTML
};

/// Text as HTML shows it.
[[nodiscard]] std::string escaped(const std::string& text);

/// With so many digits after the point.
[[nodiscard]] std::string fixed(double value, int digits);

/// A file's bytes as an address that needs no file.
[[nodiscard]] std::string data_uri(const std::string& mime_type,
                                   const std::vector<std::uint8_t>& bytes);

[[nodiscard]] std::string to_html(const HtmlTable& table);
[[nodiscard]] std::string paragraph(const std::string& text, const std::string& css_class = "");
/// Blocks beside each other where the window is wide enough.
[[nodiscard]] std::string side_by_side(const std::vector<std::string>& blocks);
/// @param picture HTML.
[[nodiscard]] std::string figure(const std::string& picture, const std::string& caption);

/// @brief The whole document.
/// @param header HTML below the title.
[[nodiscard]] std::string html_document(const std::string& title, const std::string& header,
                                        const std::vector<Section>& sections);

}  // namespace lidar_upsampling
