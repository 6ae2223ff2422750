// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/serialization/CArchive.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "lidar_upsampling/io/left_out.h"
#include "lidar_upsampling/io/packed_member.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

class PackedWriter;
class OutputFile;
class PackedReader;

/// One object of a log, with the very bytes it was read from, or the gzip member that has them.
struct RawlogEntry {
  mrpt::serialization::CSerializable::Ptr object;
  std::vector<std::uint8_t> bytes;
  PlaceInMembers packed = {};
};

/// An object with the bytes it is written as (pictures without loss).
[[nodiscard]] RawlogEntry entry_of(const mrpt::serialization::CSerializable::Ptr& object);

/// An observation's own stamp, or that of a frame's first one; none of what has no valid one.
[[nodiscard]] std::optional<Stamp> stamp_of(const RawlogEntry& entry);

/// @brief A log to be read, and what becomes of a damaged one: it is refused, or what is damaged is
/// left out.
struct LogFile {
  // NOLINTNEXTLINE(google-explicit-constructor): a path is one
  LogFile(std::string path_of_log, bool accepts = false)
      : path(std::move(path_of_log)), accepts_damage(accepts) {}

  std::string path;
  bool accepts_damage;
};

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

/// @brief Readers asked while it lives tell MRPT where their logs' external files lie; when it
/// goes, MRPT looks for them where it did before, as a log in hand needs it.
class ExternalStorageGuard {
 public:
  ExternalStorageGuard();
  ~ExternalStorageGuard();
  ExternalStorageGuard(const ExternalStorageGuard&) = delete;
  ExternalStorageGuard& operator=(const ExternalStorageGuard&) = delete;

 private:
  std::string before_;
};

/// @brief Streams a rawlog (plain, gzip or zstd) object by object, and tells a clean end from a
/// broken one. Also tells MRPT where the externally stored images and scans of the log lie (see
/// external_storage_of). MRPT has one such path per process: load the external files of an object
/// before another reader is asked for its next one, or guard that by ExternalStorageGuard.
class RawlogReader {
 public:
  /// @param bytes of what is read; a frame's are kept where a member has them, to be split.
  /// Without them an object takes half of the memory, and RawlogWriter copies the member, if it
  /// packs `fast`.
  /// @throw std::runtime_error the file cannot be opened.
  explicit RawlogReader(const LogFile& log, RecordBytes bytes = RecordBytes::kept);
  ~RawlogReader();
  RawlogReader(RawlogReader&&) noexcept;
  RawlogReader& operator=(RawlogReader&&) = delete;

  /// @return the next object, none at the end of the log. Where damage is accepted, the next one
  /// that can be found behind it.
  /// @throw CorruptRawlog, unless damage is accepted, with the number of good objects, the last
  /// stamp and the byte offset; always where the first object is unreadable, which means that the
  /// file is no rawlog. From then on there is none.
  [[nodiscard]] std::optional<RawlogEntry> next();

  /// What was damaged, and how much was left out, once the log has ended, where that is accepted.
  [[nodiscard]] const std::optional<std::string>& damage() const { return told_damage_; }

  /// Share of the file read so far, 0 to 1.
  [[nodiscard]] double progress() const;

 private:
  void announce_external_storage() const;
  [[nodiscard]] std::optional<std::string> read_object(RawlogEntry& entry);
  void meet_damage(const std::string& reason);
  [[nodiscard]] bool goes_on_behind_end();
  void find_next(std::uint64_t least);
  void note_good(const RawlogEntry& entry);
  std::nullopt_t end();

  LogFile log_;
  RecordBytes bytes_;
  std::string external_storage_;
  std::unique_ptr<PackedReader> stream_;
  std::unique_ptr<mrpt::serialization::CArchive> archive_;
  std::size_t num_good_ = 0;
  std::optional<Stamp> last_stamp_;
  bool has_frames_ = false;
  LeftOut left_out_;
  bool is_over_ = false;
  std::optional<std::string> told_damage_;
};

/// @brief Writes a rawlog, which appears on `commit()` and never if that does not come, see
/// OutputFile.
class RawlogWriter {
 public:
  /// @throw std::runtime_error `path` exists and `overwrite` is off, is no regular file, or cannot
  /// be written.
  RawlogWriter(const std::string& path, bool overwrite,
               Compression compression = Compression::fast);
  /// @brief Into a file of the caller's, who commits it after finish(). It must outlive the writer.
  RawlogWriter(OutputFile& file, Compression compression);
  ~RawlogWriter();
  RawlogWriter(const RawlogWriter&) = delete;
  RawlogWriter& operator=(const RawlogWriter&) = delete;

  /// @throw std::runtime_error the disk is full, or another write error.
  void write(const mrpt::serialization::CSerializable& object);
  /// Copies an object untouched; a gzip member of such objects as it was packed, where all that it
  /// holds comes one after the other, and `fast` leaves the choice.
  /// @throw std::logic_error only a member has its bytes, and members are not copied.
  void write(const RawlogEntry& entry);
  /// All is in the file. The last call to make, where that is the caller's.
  /// @throw std::runtime_error a write error
  void finish();
  /// Checks that all of it reached the disk, and gives the log its name. The last call to make.
  /// @throw std::runtime_error a write error, or `path` has come up in the meantime.
  void commit();

  [[nodiscard]] std::size_t num_written() const { return num_written_; }

 private:
  std::unique_ptr<OutputFile> own_;
  std::unique_ptr<PackedWriter> packed_;
  std::size_t num_written_ = 0;
};

}  // namespace lidar_upsampling
