// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "argoverse2rawlog/ply.h"

#include <cstdint>
#include <cstring>
#include <map>
#include <sstream>
#include <stdexcept>

#include "import/input_file.h"

namespace lidar_upsampling::argoverse {
namespace {

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "numbers are taken as the file has them");

constexpr std::size_t kMostVertices = 100'000'000;

template <typename Number>
double number_at(const char* bytes) {
  Number value;
  std::memcpy(&value, bytes, sizeof value);
  return static_cast<double>(value);
}

struct NumberType {
  std::size_t size;
  double (*read)(const char*);
};

template <typename Number>
constexpr NumberType type_of() {
  return {sizeof(Number), number_at<Number>};
}

const std::map<std::string, NumberType>& number_types() {
  static const std::map<std::string, NumberType> types{
      {"char", type_of<std::int8_t>()},     {"int8", type_of<std::int8_t>()},
      {"uchar", type_of<std::uint8_t>()},   {"uint8", type_of<std::uint8_t>()},
      {"short", type_of<std::int16_t>()},   {"int16", type_of<std::int16_t>()},
      {"ushort", type_of<std::uint16_t>()}, {"uint16", type_of<std::uint16_t>()},
      {"int", type_of<std::int32_t>()},     {"int32", type_of<std::int32_t>()},
      {"uint", type_of<std::uint32_t>()},   {"uint32", type_of<std::uint32_t>()},
      {"float", type_of<float>()},          {"float32", type_of<float>()},
      {"double", type_of<double>()},        {"float64", type_of<double>()}};
  return types;
}

struct Header {
  bool binary = false;
  std::size_t num_vertices = 0;
  std::vector<std::string> names;
  std::vector<NumberType> types;
};

[[noreturn]] void refuse(const std::string& path, const std::string& what) {
  throw std::runtime_error(path + ": " + what);
}

std::string header_line(std::istream& in, const std::string& path) {
  std::string line;
  if (!std::getline(in, line)) refuse(path, "ends within its header");
  if (!line.empty() && line.back() == '\r') line.pop_back();
  return line;
}

void read_format(std::istream& words, const std::string& path, Header& header) {
  std::string format;
  words >> format;
  header.binary = format == "binary_little_endian";
  if (!header.binary && format != "ascii") {
    refuse(path, "format '" + format + "' is neither ascii nor binary_little_endian");
  }
}

void read_property(std::istream& words, const std::string& path, Header& header) {
  std::string type, name;
  words >> type >> name;
  const auto known = number_types().find(type);
  if (known == number_types().end()) refuse(path, "a property of type '" + type + "'");
  header.names.push_back(name);
  header.types.push_back(known->second);
}

Header read_header(std::istream& in, const std::string& path) {
  if (header_line(in, path) != "ply") refuse(path, "is no PLY file");
  Header header;
  int num_elements = 0;
  for (std::string line; (line = header_line(in, path)) != "end_header";) {
    std::istringstream words(line);
    std::string keyword, name;
    words >> keyword;
    if (keyword == "format") read_format(words, path, header);
    if (keyword == "property" && num_elements == 1) read_property(words, path, header);
    if (keyword != "element" || num_elements++ > 0) continue;
    words >> name >> header.num_vertices;
    if (name != "vertex" || !words || header.num_vertices > kMostVertices) {
      refuse(path, "'" + line + "' where the number of vertices is expected");
    }
  }
  if (header.names.empty()) refuse(path, "has no vertices");
  return header;
}

void read_binary(std::istream& in, const Header& header, PlyVertices& vertices) {
  std::size_t stride = 0;
  for (const NumberType& type : header.types) stride += type.size;
  std::vector<char> bytes(stride * header.num_vertices);
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (static_cast<std::size_t>(in.gcount()) != bytes.size()) {
    refuse(vertices.path, "ends before its " + std::to_string(header.num_vertices) + " vertices");
  }
  const char* next = bytes.data();
  for (std::size_t i = 0; i < header.num_vertices; ++i) {
    for (std::size_t k = 0; k < header.types.size(); ++k) {
      vertices.values[k][i] = header.types[k].read(next);
      next += header.types[k].size;
    }
  }
}

void read_ascii(std::istream& in, const Header& header, PlyVertices& vertices) {
  for (std::size_t i = 0; i < header.num_vertices; ++i) {
    for (auto& values : vertices.values) {
      // Not with >>, which knows no "nan".
      std::string word;
      in >> word;
      std::size_t used = 0;
      try {
        values[i] = std::stod(word, &used);
      } catch (const std::exception&) {
        used = 0;
      }
      if (used == 0 || used != word.size()) {
        refuse(vertices.path, "'" + word + "' in vertex " + std::to_string(i) + " is no number");
      }
    }
  }
}

}  // namespace

const std::vector<double>& PlyVertices::property(const std::string& name) const {
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (names[k] == name) return values[k];
  }
  throw std::runtime_error(path + ": its vertices have no property '" + name + "'");
}

PlyVertices read_ply(const std::string& path) {
  std::ifstream in = importing::open_file(path, std::ios::binary);
  if (!in) refuse(path, "cannot be read");
  const Header header = read_header(in, path);
  PlyVertices vertices;
  vertices.path = path;
  vertices.names = header.names;
  vertices.values.assign(header.names.size(), std::vector<double>(header.num_vertices));
  if (header.binary) {
    read_binary(in, header, vertices);
  } else {
    read_ascii(in, header, vertices);
  }
  return vertices;
}

}  // namespace lidar_upsampling::argoverse
