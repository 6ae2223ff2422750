// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "dgp2rawlog/npz_file.h"

#include <zlib.h>

#include <cstdint>
#include <cstring>
#include <iterator>
#include <regex>
#include <stdexcept>
#include <vector>

#include "import/input_file.h"

namespace lidar_upsampling::dgp {
namespace {

using Bytes = std::vector<char>;

constexpr std::uint32_t kEndOfDirectory = 0x06054b50, kDirectoryEntry = 0x02014b50;
constexpr std::size_t kSizeOfEnd = 22, kSizeOfLocalHeader = 30;
constexpr int kStored = 0, kDeflated = 8;
constexpr std::size_t kHighestRatio = 1100;  // deflate packs no better

template <typename Number>
Number little_endian(const Bytes& bytes, std::size_t at) {
  Number number = 0;
  if (at + sizeof number > bytes.size()) throw std::runtime_error("cut off");
  std::memcpy(&number, bytes.data() + at, sizeof number);
  return number;
}

// Where the list of the archive's files begins. The headers before the files need not know sizes.
std::size_t directory_of_zip(const Bytes& zip) {
  for (std::size_t back = kSizeOfEnd; back <= zip.size() && back < (1U << 16U); ++back) {
    const std::size_t at = zip.size() - back;
    if (little_endian<std::uint32_t>(zip, at) == kEndOfDirectory) {
      return little_endian<std::uint32_t>(zip, at + 16);
    }
  }
  throw std::runtime_error("no .npz archive, or cut off");
}

Bytes inflated(const char* packed, std::size_t packed_size, std::size_t size) {
  if (size > kHighestRatio * (packed_size + 1)) throw std::runtime_error("damaged: too large");
  Bytes out(size);
  z_stream stream{};
  // zlib's interface takes what it only reads as not constant.
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed));
  stream.avail_in = static_cast<uInt>(packed_size);
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(size);
  if (inflateInit2(&stream, -MAX_WBITS) != Z_OK) throw std::runtime_error("cannot be unpacked");
  const int status = inflate(&stream, Z_FINISH);
  inflateEnd(&stream);
  if (status != Z_STREAM_END || stream.avail_out != 0) {
    throw std::runtime_error("damaged: cannot be unpacked");
  }
  return out;
}

Bytes first_of_zip(const Bytes& zip) {
  const std::size_t entry = directory_of_zip(zip);
  if (little_endian<std::uint32_t>(zip, entry) != kDirectoryEntry) {
    throw std::runtime_error("an archive of nothing, or damaged");
  }
  const auto method = little_endian<std::uint16_t>(zip, entry + 10);
  const std::size_t packed_size = little_endian<std::uint32_t>(zip, entry + 20);
  const std::size_t size = little_endian<std::uint32_t>(zip, entry + 24);
  const std::size_t header = little_endian<std::uint32_t>(zip, entry + 42);
  const std::size_t begin = header + kSizeOfLocalHeader +
                            little_endian<std::uint16_t>(zip, header + 26) +
                            little_endian<std::uint16_t>(zip, header + 28);
  if (begin + packed_size > zip.size()) throw std::runtime_error("cut off");
  const char* const packed = zip.data() + begin;
  if (method == kStored && size == packed_size) return {packed, packed + size};
  if (method != kDeflated) throw std::runtime_error("packed in a way that is not known here");
  return inflated(packed, packed_size, size);
}

// A .npy file: https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html
struct Npy {
  std::size_t begin = 0;  // of the numbers
  bool is_double = false;
  std::size_t rows = 0, columns = 0;
};

Npy header_of(const Bytes& npy) {
  if (npy.size() < 10 || std::memcmp(npy.data(), "\x93NUMPY", 6) != 0) {
    throw std::runtime_error("its first file is no array");
  }
  const bool is_first_version = npy[6] == 1;
  const std::size_t text = is_first_version ? 10 : 12;
  Npy result;
  result.begin = text + (is_first_version ? little_endian<std::uint16_t>(npy, 8)
                                          : little_endian<std::uint32_t>(npy, 8));
  if (result.begin > npy.size()) throw std::runtime_error("cut off");
  const std::string header(npy.data() + text, npy.data() + result.begin);
  static const std::regex kTable(
      R"('descr': '<f([48])', 'fortran_order': False, 'shape': \((\d{1,9}), (\d{1,4})\))");
  std::smatch found;
  if (!std::regex_search(header, found, kTable)) {
    throw std::runtime_error("expected N x columns of <f4 or <f8, found " +
                             header.substr(0, header.find_last_not_of(" \n") + 1));
  }
  result.is_double = found[1] == "8";
  result.rows = std::stoul(found[2]);
  result.columns = std::stoul(found[3]);
  return result;
}

template <typename Number>
Rows rows_of(const Bytes& npy, const Npy& header) {
  const std::size_t count = header.rows * header.columns;
  if (header.begin + count * sizeof(Number) > npy.size()) throw std::runtime_error("cut off");
  std::vector<Number> numbers(count);
  if (count > 0) std::memcpy(numbers.data(), npy.data() + header.begin, count * sizeof(Number));
  using Stored = Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const Stored>(numbers.data(), static_cast<Eigen::Index>(header.rows),
                                  static_cast<Eigen::Index>(header.columns))
      .template cast<double>();
}

}  // namespace

Rows read_npz(const std::string& path) {
  std::ifstream file = importing::open_file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read " + path);
  const Bytes zip{std::istreambuf_iterator<char>(file), {}};
  try {
    const Bytes npy = first_of_zip(zip);
    const Npy header = header_of(npy);
    return header.is_double ? rows_of<double>(npy, header) : rows_of<float>(npy, header);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(path + ": " + error.what());
  }
}

}  // namespace lidar_upsampling::dgp
