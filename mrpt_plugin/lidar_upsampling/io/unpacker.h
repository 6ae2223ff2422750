// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lidar_upsampling/io/packed_member.h"

struct inflate_state;
struct ZSTD_DCtx_s;

namespace lidar_upsampling {

/// Where a gzip member ended.
struct MemberEnd {
  std::uint64_t unpacked_position = 0;
  std::shared_ptr<const PackedMember> member;  ///< null: it is not kept
};

/// @brief Unpacks a file block by block: gzip (RFC 1952) or zstd (RFC 8878), as its first bytes
/// tell, its members or frames one after the other; or a plain file, as it is. What follows a
/// member must be another one: gunzip leaves out anything else, and with it all members that come
/// after one whose header is damaged.
class Unpacker {
 public:
  /// @throw std::runtime_error the file cannot be opened, or is a folder.
  explicit Unpacker(const std::string& path);
  ~Unpacker();
  Unpacker(const Unpacker&) = delete;
  Unpacker& operator=(const Unpacker&) = delete;

  /// Fills `block` with the next bytes, as many as it has room for. @return how many; fewer at the
  /// end, clean or not.
  std::size_t unpack(std::vector<std::uint8_t>& block);

  /// @brief Behind a defect, goes on with the next gzip member that can be unpacked.
  /// @return how many bytes of the file were not; none: there is none, or the file is not to be
  /// read but once.
  std::optional<std::uint64_t> resume();

  /// Bytes that have been unpacked, and those of them before the member that has not ended yet.
  [[nodiscard]] std::uint64_t unpacked_size() const { return unpacked_size_; }
  [[nodiscard]] std::uint64_t sound_size() const { return sound_size_; }

  /// From here on tells where gzip members end, by take_ends(), and which may be read again; to be
  /// asked for before all else.
  void keep_members() { keeps_members_ = is_kept_ = true; }
  /// Of those that have ended since the last call.
  [[nodiscard]] std::vector<MemberEnd> take_ends() { return std::exchange(ends_, {}); }

  /// Why the end is no clean one.
  [[nodiscard]] const std::optional<std::string>& defect() const { return defect_; }
  [[nodiscard]] bool is_packed() const { return kind_ != Kind::plain; }
  [[nodiscard]] bool is_gzip() const { return kind_ == Kind::gzip; }
  [[nodiscard]] bool is_zstd() const { return kind_ == Kind::zstd; }
  [[nodiscard]] std::uint64_t file_size() const { return file_->size(); }
  /// Bytes of the file that have been used.
  [[nodiscard]] std::uint64_t file_position() const;

 private:
  enum class Kind { plain, gzip, zstd };
  struct Free {
    void operator()(ZSTD_DCtx_s* state) const;
  };

  /// @return whether there is input.
  bool refill();
  bool starts_with(const std::vector<std::uint8_t>& magic);
  std::size_t copy(std::vector<std::uint8_t>& block);
  std::size_t inflate(std::vector<std::uint8_t>& block);
  void end_member(std::uint64_t unpacked_position);
  std::size_t unpack_zstd(std::vector<std::uint8_t>& block);
  std::size_t end(std::size_t done, std::optional<std::string> defect);

  std::shared_ptr<const InputFile> file_;
  std::uint64_t num_read_ = 0;
  std::uint64_t unpacked_size_ = 0, sound_size_ = 0;
  std::uint64_t member_begin_ = 0;  // of the file, where one begins or is to begin
  Kind kind_ = Kind::plain;
  bool is_at_end_ = false;
  std::vector<std::uint8_t> input_;
  std::size_t begin_ = 0, size_ = 0;  // of what is left of `input_`
  std::unique_ptr<inflate_state> state_;
  bool keeps_members_ = false;
  bool is_kept_ = false;  // whether the member has its header, and may be copied
  std::vector<MemberEnd> ends_;
  std::unique_ptr<ZSTD_DCtx_s, Free> zstd_;
  bool in_frame_ = false;
  std::optional<std::string> defect_;
};

/// @brief How much a file has unpacked, up to a defect, and behind it where that can be.
/// @throw std::runtime_error as Unpacker
[[nodiscard]] std::uint64_t unpacked_size_of(const std::string& path);

/// A part of what a file has unpacked.
struct UnpackedPart {
  std::uint64_t begin = 0, end = 0;
};

/// @brief What of a file belongs to damaged gzip members: it may be wrong from somewhere on, as
/// checksums come at the end. @throw std::runtime_error as Unpacker
[[nodiscard]] std::vector<UnpackedPart> doubtful_parts_of(const std::string& path);

}  // namespace lidar_upsampling
