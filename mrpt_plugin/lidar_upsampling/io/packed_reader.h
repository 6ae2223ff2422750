// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/io/CStream.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "lidar_upsampling/io/unpacker.h"

namespace lidar_upsampling {

/// @brief Reads a file that is plain, gzip or zstd, see Unpacker, unpacked a little ahead by a
/// thread of its own, and keeps a record of what was read.
/// mrpt::io::CFileGZInputStream cannot serve: it does not tell the end of the data from a stream
/// that is cut or damaged, and in most releases knows no zstd.
class PackedReader : public mrpt::io::CStream {
 public:
  /// @throw std::runtime_error the file cannot be opened.
  explicit PackedReader(const std::string& path);
  ~PackedReader() override;
  PackedReader(const PackedReader&) = delete;
  PackedReader& operator=(const PackedReader&) = delete;

  /// All good bytes before a defect are given.
  size_t Read(void* buffer, size_t count) override;
  uint64_t getTotalBytesCount() const override { return file_size_; }
  uint64_t getPosition() const override { return position_; }
  std::string getStreamDescription() const override { return path_; }

  size_t Write(const void*, size_t) override { throw std::logic_error("only reads"); }
  uint64_t Seek(int64_t, TSeekOrigin) override { throw std::logic_error("cannot seek"); }

  /// Whether nothing is left to read, be it the clean end or a defect.
  [[nodiscard]] bool at_end();
  /// Why no more can be read, where that is not the clean end; none as long as more can be.
  [[nodiscard]] std::optional<std::string> defect() const;
  /// @brief Behind a defect, goes on with the next gzip member. @return how many bytes of the file
  /// were not unpacked; none: there is no next one.
  std::optional<std::uint64_t> resume();
  /// How many bytes from the record's begin on belong to a gzip member that is damaged, and cannot
  /// be trusted; unpacks all of the file when first asked.
  [[nodiscard]] std::uint64_t doubtful_from_record_on();
  /// @brief Leaves out what was read since the last record was taken, and what follows, up to where
  /// `begins` tells that something does; at the end, all of it.
  /// @param begins gets at least `kLook` bytes, but for the end's last ones.
  /// @param least that are left out. @return how many were.
  std::uint64_t skip_to(const std::function<bool(const std::uint8_t*, std::size_t)>& begins,
                        std::uint64_t least);
  static constexpr std::size_t kLook = 256;
  /// How much unpacked data there is from the record's begin on, up to the end or a defect; unpacks
  /// all of the file when first asked. None: it is no regular file.
  [[nodiscard]] std::optional<std::uint64_t> bytes_from_record_on();
  /// All that was read since the last call; nothing where its bytes are not to be kept.
  [[nodiscard]] std::vector<std::uint8_t> take_record(RecordBytes bytes = RecordBytes::kept);
  /// Of the record that was taken last.
  [[nodiscard]] const PlaceInMembers& place_in_members() const { return place_; }
  /// Share of the file on the disk that is read, 0 to 1.
  [[nodiscard]] double progress() const;

 private:
  class Ahead;

  std::size_t take_again(std::uint8_t* out, std::size_t count);
  bool look_ahead();
  PlaceInMembers pass_members();

  std::string path_;
  std::uint64_t file_size_ = 0;
  std::uint64_t position_ = 0;      // in the uncompressed data
  std::uint64_t member_begin_ = 0;  // likewise, of the gzip member that it is in
  PlaceInMembers place_;
  std::optional<std::uint64_t> unpacked_size_;
  std::optional<std::vector<UnpackedPart>> doubtful_;
  std::vector<std::uint8_t> record_;
  std::vector<std::uint8_t> again_;  // what is to be read once more, from
  std::size_t again_begin_ = 0;      // here on
  std::unique_ptr<Ahead> ahead_;
};

}  // namespace lidar_upsampling
