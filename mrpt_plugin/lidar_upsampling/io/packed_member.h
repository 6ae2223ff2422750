// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace lidar_upsampling {

/// @brief The system's words for why a file cannot be used, "cannot open x for reading: ...".
/// @throw std::runtime_error always.
[[noreturn]] void throw_open_error(const std::string& path, const char* purpose, int error_number);

/// A file opened for reading, which is closed when the last who reads from it is gone.
class InputFile {
 public:
  /// @throw std::runtime_error the file cannot be opened, or is a folder.
  explicit InputFile(const std::string& path);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  [[nodiscard]] int handle() const { return handle_; }
  [[nodiscard]] std::uint64_t size() const { return size_; }
  /// Not a pipe or a device: what was read can be read again.
  [[nodiscard]] bool is_regular() const { return is_regular_; }
  /// Fills `bytes` from a byte of the file on. @throw std::runtime_error read error, or it ends
  /// before: another program has made it shorter.
  void read(std::uint64_t from, std::vector<std::uint8_t>& bytes) const;

 private:
  const std::string path_;
  int handle_ = -1;
  std::uint64_t size_ = 0;
  bool is_regular_ = false;
};

/// A gzip member that stays where it is, in its file; its checksum was right.
struct PackedMember {
  std::shared_ptr<const InputFile> file;
  std::uint64_t begin = 0;  ///< byte of the file
  std::size_t size = 0, unpacked_size = 0;
  std::uint32_t checksum = 0;  ///< of what it unpacks to

  /// Fills `bytes` with the member as it is packed. @throw std::runtime_error as InputFile::read,
  /// or the file has been written to since.
  void read(std::vector<std::uint8_t>& bytes) const;

  /// Larger ones, unpacked, are not kept: whoever packs a log as one stream has one member.
  static constexpr std::size_t kLargest = 4U << 20U;
};

/// @brief Whether some bytes end with what a member unpacks to, by its checksum.
[[nodiscard]] bool ends_with(const std::vector<std::uint8_t>& bytes, const PackedMember& member);

/// What becomes of a record's bytes once it is read.
enum class RecordBytes {
  kept,
  left_to_member,  ///< not kept where a gzip member has them and nothing else
  dropped
};

/// How an object that was read lies in the members of its file.
struct PlaceInMembers {
  std::shared_ptr<const PackedMember> ended;  ///< the one that ends with it; null: none does
  bool goes_on = false;                       ///< the one that it ends in may be copied as a whole
  bool is_all = false;                        ///< `ended` is, without looking at the object's bytes
};

}  // namespace lidar_upsampling
