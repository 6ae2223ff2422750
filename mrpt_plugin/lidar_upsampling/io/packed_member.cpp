// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/io/packed_member.h"

#include <fcntl.h>
#include <libdeflate.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>

namespace lidar_upsampling {
namespace {

// RFC 1952: the trailer begins with the checksum, least significant byte first.
std::uint32_t checksum_in(const std::vector<std::uint8_t>& packed) {
  constexpr std::size_t kTrailer = 8;
  if (packed.size() < kTrailer) return 0;
  const std::uint8_t* const trailer = packed.data() + packed.size() - kTrailer;
  std::uint32_t checksum = 0;
  for (int i = 3; i >= 0; --i) checksum = checksum << 8U | trailer[i];
  return checksum;
}

}  // namespace

void throw_open_error(const std::string& path, const char* purpose, int error_number) {
  throw std::runtime_error("cannot open " + path + " for " + purpose + ": " +
                           std::generic_category().message(error_number));
}

InputFile::InputFile(const std::string& path)
    : path_(path), handle_(open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
  struct stat info {};
  if (handle_ < 0 || fstat(handle_, &info) != 0) throw_open_error(path, "reading", errno);
  if (S_ISDIR(info.st_mode)) {
    close(handle_);
    throw_open_error(path, "reading", EISDIR);
  }
  size_ = static_cast<std::uint64_t>(info.st_size);
  is_regular_ = S_ISREG(info.st_mode);
}

InputFile::~InputFile() { close(handle_); }

void InputFile::read(std::uint64_t from, std::vector<std::uint8_t>& bytes) const {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t got =
        pread(handle_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(from + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0)
      throw std::runtime_error("cannot read " + path_ + ": " +
                               std::generic_category().message(errno));
    if (got == 0)
      throw std::runtime_error(
          path_ + " ends at byte " + std::to_string(from + done) +
          ", where more of it was read before: does another program write it?");
    done += static_cast<std::size_t>(got);
  }
}

void PackedMember::read(std::vector<std::uint8_t>& bytes) const {
  bytes.resize(size);
  file->read(begin, bytes);
  if (checksum_in(bytes) != checksum)
    throw std::runtime_error("the gzip member at byte " + std::to_string(begin) +
                             " of the log is another than when it was read: does another program "
                             "write it?");
}

bool ends_with(const std::vector<std::uint8_t>& bytes, const PackedMember& member) {
  if (member.unpacked_size > bytes.size()) return false;
  const std::uint8_t* const begin = bytes.data() + bytes.size() - member.unpacked_size;
  // Not ISA-L's: it leaves the upper halves of vector registers dirty, and what this thread does
  // next by SSE takes twice the time.
  return libdeflate_crc32(0, begin, member.unpacked_size) == member.checksum;
}

}  // namespace lidar_upsampling
