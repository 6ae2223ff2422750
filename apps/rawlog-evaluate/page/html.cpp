// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "html.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <limits>

#include "style.h"

namespace lidar_upsampling {

namespace {

std::string class_attribute(const std::string& name) {
  return name.empty() ? "" : " class=\"" + name + "\"";
}

/// The least figure of each column, where at least two compete.
std::vector<double> least_of_columns(const HtmlTable& table) {
  std::vector<double> least(table.columns.size(), -std::numeric_limits<double>::infinity());
  for (std::size_t column = 0; column < least.size(); ++column) {
    std::vector<double> values;
    for (const HtmlRow& row : table.rows)
      if (row.competes && column < row.cells.size() && row.cells[column].ranked)
        values.push_back(*row.cells[column].ranked);
    if (values.size() > 1) least[column] = *std::min_element(values.begin(), values.end());
  }
  return least;
}

/// The least of a line's, for each of its cells.
std::vector<double> least_of_row(const HtmlRow& row) {
  double least = std::numeric_limits<double>::infinity();
  for (const Cell& cell : row.cells)
    if (cell.ranked) least = std::min(least, *cell.ranked);
  return std::vector<double>(row.cells.size(), least);
}

std::string row_html(const HtmlRow& row, const std::vector<double>& least) {
  std::string html = "<tr" + class_attribute(row.css_class) + "><th scope=\"row\">";
  if (!row.color.empty()) html += "<i class=\"mark\" style=\"background:" + row.color + "\"></i>";
  html += escaped(row.name) + "</th>";
  for (std::size_t i = 0; i < row.cells.size(); ++i) {
    const Cell& cell = row.cells[i];
    const bool best = row.competes && i < least.size() && cell.ranked && !(*cell.ranked > least[i]);
    html += "<td" + class_attribute(best ? "best" : "") + ">" + escaped(cell.text) + "</td>";
  }
  return html + "</tr>\n";
}

}  // namespace

Cell text_cell(std::string text) { return {std::move(text), {}}; }

Cell count_cell(double count) { return {fixed(count, 0), {}}; }

Cell error_cell(bool known, double value, int digits) {
  if (!known) return {"–", {}};
  const std::string text = fixed(value, digits);
  return {text, std::stod(text)};  // what reads the same ranks the same
}

Cell plain_cell(bool known, double value, int digits) {
  return {known ? fixed(value, digits) : "–", {}};
}

std::string escaped(const std::string& text) {
  std::string html;
  for (const char c : text) {
    switch (c) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      default:
        html += c;
    }
  }
  return html;
}

std::string fixed(double value, int digits) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*f", digits, value);
  return text.data();
}

std::string data_uri(const std::string& mime_type, const std::vector<std::uint8_t>& bytes) {
  static constexpr const char* kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string uri = "data:" + mime_type + ";base64,";
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) bits = bits << 8U | (k < count ? bytes[i + k] : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      uri += k <= count ? kDigits[bits >> (18 - 6 * k) & 63U] : '=';
  }
  return uri;
}

std::string to_html(const HtmlTable& table) {
  const std::vector<double> least = least_of_columns(table);
  std::string html = "<div class=\"block\"><h3>" + escaped(table.caption) +
                     "</h3>\n<div class=\"wide\"><table" +
                     (table.rank_in_rows ? " class=\"across\"" : "") + "><thead><tr><td></td>";
  for (const std::string& column : table.columns)
    html += "<th scope=\"col\">" + escaped(column) + "</th>";
  html += "</tr></thead>\n<tbody>\n";
  for (const HtmlRow& row : table.rows)
    html += row_html(row, table.rank_in_rows ? least_of_row(row) : least);
  html += "</tbody></table></div>\n";
  if (!table.note.empty()) html += paragraph(table.note, "note");
  return html + "</div>\n";
}

std::string paragraph(const std::string& text, const std::string& css_class) {
  return "<p" + class_attribute(css_class) + ">" + escaped(text) + "</p>\n";
}

std::string side_by_side(const std::vector<std::string>& blocks) {
  std::string html = "<div class=\"grid\">\n";
  for (const std::string& block : blocks) html += block;
  return html + "</div>\n";
}

std::string figure(const std::string& picture, const std::string& caption) {
  return "<figure><figcaption>" + escaped(caption) + "</figcaption><div class=\"wide\">" + picture +
         "</div></figure>\n";
}

std::string html_document(const std::string& title, const std::string& header,
                          const std::vector<Section>& sections) {
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
      escaped(title) + "</title>\n<style>" + kStyle + "</style></head>\n<body>\n<header><h1>" +
      escaped(title) + "</h1>\n" + header + "<nav aria-label=\"Contents\"><ul>\n";
  for (const Section& section : sections)
    html += "<li><a href=\"#" + section.id + "\">" + escaped(section.title) + "</a></li>\n";
  html += "</ul></nav></header>\n<main>\n";
  for (const Section& section : sections)
    html += "<section id=\"" + section.id + "\"><h2>" + escaped(section.title) + "</h2>\n" +
            section.body + "</section>\n";
  return html + "</main>\n</body></html>\n";
}

}  // namespace lidar_upsampling
