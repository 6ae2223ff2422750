// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/serialization/CArchive.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

class GzipWriter;
class RecordingGzipReader;

/// One object of a log, with the very bytes it was read from.
struct RawlogEntry {
  mrpt::serialization::CSerializable::Ptr object;
  std::vector<std::uint8_t> bytes;
};

/// An object with the bytes it is written as (pictures without loss).
[[nodiscard]] RawlogEntry entry_of(const mrpt::serialization::CSerializable::Ptr& object);

/// The log ends in the middle of an object, or holds something that is no MRPT object.
struct CorruptRawlog : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// @brief The folder of a log's externally stored images and scans: `<stem>_Images`,
/// `<stem>_images` or `<stem>_IMAGES` beside it, the first that is there; the first of them if none
/// is.
[[nodiscard]] std::string external_storage_of(const std::string& rawlog_path);

/// @brief Lets a log written from another one find the same external files, through a symbolic link
/// beside it, as MRPT derives the folder's name from the log's.
/// Does nothing if the source has no such folder, or both logs share it already.
/// @return false if something else lies under the name that the link needs.
[[nodiscard]] bool share_external_storage(const std::string& source_rawlog,
                                          const std::string& target_rawlog);

/// @brief Streams a rawlog (plain or gzip) object by object, and tells a clean end from a broken
/// one. Also tells MRPT where the externally stored images and scans of the log lie (see
/// external_storage_of). MRPT has one such path per process: load the external files of an object
/// before another reader is asked for its next one.
class RawlogReader {
 public:
  /// @throw std::runtime_error the file cannot be opened.
  explicit RawlogReader(const std::string& path);
  ~RawlogReader();
  RawlogReader(RawlogReader&&) noexcept;
  RawlogReader& operator=(RawlogReader&&) = delete;

  /// @return the next object, none at the clean end of the log.
  /// @throw CorruptRawlog with the number of good objects and the byte offset; the first object
  /// being unreadable means that the file is no rawlog, and the message says so. From then on there
  /// is none.
  [[nodiscard]] std::optional<RawlogEntry> next();

  /// Share of the file read so far, 0 to 1.
  [[nodiscard]] double progress() const;

 private:
  void announce_external_storage() const;
  [[noreturn]] void fail(const std::string& reason);

  std::string path_, external_storage_;
  std::unique_ptr<RecordingGzipReader> stream_;
  std::unique_ptr<mrpt::serialization::CArchive> archive_;
  std::size_t num_good_ = 0;
  bool has_failed_ = false;
};

/// @brief Writes a gzip rawlog under a temporary name beside `path`; it gets its own name on
/// `commit()`, and is removed if that never comes.
class RawlogWriter {
 public:
  /// @throw std::runtime_error `path` exists and `overwrite` is off, is no regular file, or cannot
  /// be written.
  RawlogWriter(const std::string& path, bool overwrite,
               Compression compression = Compression::fast);
  ~RawlogWriter();
  RawlogWriter(const RawlogWriter&) = delete;
  RawlogWriter& operator=(const RawlogWriter&) = delete;

  /// @throw std::runtime_error the disk is full, or another write error.
  void write(const mrpt::serialization::CSerializable& object);
  /// Copies an object untouched.
  void write(const RawlogEntry& entry);
  /// Flushes, checks that all of it reached the disk, and renames. The last call to make.
  /// @throw std::runtime_error a write error, or `path` has come up in the meantime.
  void commit();

  [[nodiscard]] std::size_t num_written() const { return num_written_; }

 private:
  std::string path_, temporary_path_;
  bool overwrite_;
  std::unique_ptr<GzipWriter> file_;
  std::size_t num_written_ = 0;
  bool is_committed_ = false;
};

}  // namespace lidar_upsampling
