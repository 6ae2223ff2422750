// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/io/reading_error.h"

#include <algorithm>

#include "lidar_upsampling/io/reading_guard.h"
#include "lidar_upsampling/text.h"

namespace lidar_upsampling {
namespace {

// What stands from there to the next quote.
std::string up_to_quote(const std::string& text, std::size_t from) {
  return text.substr(from, text.find('\'', from) - from);
}

// The class whose version this MRPT does not know; empty: that is not what happened.
std::string class_of_newer_version(const std::string& text) {
  const std::string kVersion = "unknown serialization version number: '", kClass = "typed object '";
  const auto version = text.find(kVersion);
  const auto name = text.rfind(kClass, version);  // objects within objects: the innermost
  if (version == std::string::npos || name == std::string::npos) return {};
  return up_to_quote(text, name + kClass.size()) + " of version " +
         up_to_quote(text, version + kVersion.size());
}

// The class that this MRPT does not know, be it that of an object within one; empty: that is not
// what happened.
std::string unknown_class(const std::string& text) {
  const auto end = text.find("not registered");
  const auto line = text.rfind('\n', end) + 1;
  const auto name = text.find('\'', line);
  return end == std::string::npos || name > end ? "" : up_to_quote(text, name + 1);
}

bool is_printable(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c <= '~'; });
}

}  // namespace

std::string why_not_read(const std::exception& error) {
  // MRPT puts a line of its own before.
  const std::string all = error.what();
  const auto picture = all.find(kBrokenJpeg);
  if (picture != std::string::npos) return all.substr(picture, all.find('\n', picture) - picture);
  const std::string newer = class_of_newer_version(all);
  if (!newer.empty())
    return "class " + newer + " is not known here: the log was made by a newer MRPT, or is damaged";
  const std::string unknown = unknown_class(all);
  if (!is_printable(unknown)) return "there is no object of any class";
  if (!unknown.empty())
    return "class " + unknown +
           " is not known here: the log was made by a newer MRPT, or needs a plugin";
  const std::string line = one_line(error), kParsing = "Exception while parsing typed object '";
  if (line.rfind(kParsing, 0) == 0)
    return "an object of class " + up_to_quote(line, kParsing.size()) + " cannot be read";
  return line;
}

}  // namespace lidar_upsampling
