// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/ini_text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include "lidar_upsampling/text.h"

namespace lidar_upsampling {
namespace {

std::string bytes_of(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw std::runtime_error(path + ": is a folder, not a settings file");
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw std::runtime_error(
        path + ": cannot read this settings file: " + std::generic_category().message(errno));
  constexpr std::size_t kMostBytes = 16U << 20U;
  std::string bytes;
  for (std::array<char, 1U << 16U> block{}; file;) {
    file.read(block.data(), block.size());
    bytes.append(block.data(), static_cast<std::size_t>(file.gcount()));
    if (bytes.size() > kMostBytes)
      throw std::runtime_error(path + ": this is no settings file: it has more than 16 MB");
  }
  return bytes;
}

std::string in_lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// Goes through the lines of a file.
class LineReader {
 public:
  LineReader(IniText& ini, IniRepeats repeats) : ini_(ini), repeats_(repeats) {}

  void read(const std::string& raw) {
    ++number_;
    const bool goes_on = continued_;
    continued_ = !raw.empty() && raw.back() == '\\';
    refuse_what_is_no_text(raw);
    const std::string line = trimmed(raw);
    if (goes_on || line.empty() || is_comment(line) || line[0] == '@') return;
    if (line[0] == '[')
      begin_section(line);
    else
      note_key(line);
  }

 private:
  static bool is_comment(const std::string& text) { return text[0] == ';' || text[0] == '#'; }

  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error(ini_.path + ":" + std::to_string(number_) + ": " + what);
  }

  void refuse_what_is_no_text(const std::string& raw) const {
    const auto is_control = [](unsigned char c) { return c < ' ' && c != '\t' && c != '\r'; };
    const auto found = std::find_if(raw.begin(), raw.end(), is_control);
    if (found != raw.end())
      fail("this is no text: it has a byte " + std::to_string(static_cast<int>(*found)) +
           " in it; settings are an INI file in UTF-8");
  }

  void begin_section(const std::string& line) {
    const auto end = line.find(']');
    if (end == std::string::npos)
      fail("'" + line + "': a bracket ] is missing behind the section's name");
    const std::string behind = trimmed(line.substr(end + 1));
    if (!behind.empty() && !is_comment(behind))
      fail("'" + behind + "' stands behind a section's name: it takes a line of its own");
    section_ = "[" + trimmed(line.substr(1, end - 1)) + "]";
    if (section_ == "[]") fail("'" + line + "': there is no name between the brackets");
    note(section_, "section " + section_);
  }

  void note_key(const std::string& line) {
    const auto equals = line.find('=');
    if (equals == std::string::npos)
      fail("'" + line + "': there is no '=', it is neither a setting nor a [section]");
    const std::string key = trimmed(line.substr(0, equals));
    if (key.empty()) fail("'" + line + "': there is no name before the '='");
    if (section_.empty()) fail(key + " stands before any [section], where nothing reads it");
    note(section_ + " " + key, section_ + " " + key);
  }

  void note(const std::string& name, const std::string& what) {
    const auto [first, is_new] = first_line_.emplace(in_lower_case(name), number_);
    if (!is_new && repeats_ == IniRepeats::refuse)
      fail(what + " is there already, in line " + std::to_string(first->second));
    ini_.line_of[name] = number_;
  }

  IniText& ini_;
  IniRepeats repeats_;
  int number_ = 0;
  bool continued_ = false;
  std::string section_;
  std::map<std::string, int> first_line_;  // MRPT takes no notice of case
};

}  // namespace

std::string IniText::located(const std::string& message) const {
  const auto end_of_section = message.find(']');
  if (message.empty() || message[0] != '[' || end_of_section == std::string::npos) return message;
  const std::string section = message.substr(0, end_of_section + 1);
  const std::string rest = message.substr(section.size());
  const auto end_of_key = rest.find_first_of(" :", 1);
  for (const std::string& name : {section + rest.substr(0, end_of_key), section}) {
    const auto line = line_of.find(name);
    if (line != line_of.end()) return path + ":" + std::to_string(line->second) + ": " + message;
  }
  return message;
}

IniText read_ini(const std::string& path, IniRepeats repeats) {
  IniText ini{path, bytes_of(path), {}};
  const std::string mark = ini.text.substr(0, 2);
  if (mark == "\xff\xfe" || mark == "\xfe\xff")
    throw std::runtime_error(path + ":1: this is UTF-16; settings are an INI file in UTF-8");
  if (ini.text.rfind("\xef\xbb\xbf", 0) == 0) ini.text.erase(0, 3);  // some editors' mark of UTF-8
  LineReader reader(ini, repeats);
  std::istringstream lines(ini.text);
  for (std::string line; std::getline(lines, line);) reader.read(line);
  return ini;
}

}  // namespace lidar_upsampling
