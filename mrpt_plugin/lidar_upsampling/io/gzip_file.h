// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/io/CStream.h>
#include <zlib.h>

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace lidar_upsampling {

/// @brief Reads a plain or gzip file and keeps a record of what was read.
/// mrpt::io::CFileGZInputStream cannot serve: it does not tell the end of the data from a gzip
/// stream that is cut or damaged.
class RecordingGzipReader : public mrpt::io::CStream {
 public:
  /// @throw std::runtime_error the file cannot be opened.
  explicit RecordingGzipReader(const std::string& path);
  ~RecordingGzipReader() override;
  RecordingGzipReader(const RecordingGzipReader&) = delete;
  RecordingGzipReader& operator=(const RecordingGzipReader&) = delete;

  size_t Read(void* buffer, size_t count) override;
  uint64_t getTotalBytesCount() const override { return file_size_; }
  uint64_t getPosition() const override { return position_; }
  std::string getStreamDescription() const override { return path_; }

  size_t Write(const void*, size_t) override { throw std::logic_error("only reads"); }
  uint64_t Seek(int64_t, TSeekOrigin) override { throw std::logic_error("cannot seek"); }

  /// Whether nothing is left to read, be it the clean end or a defect.
  [[nodiscard]] bool at_end();
  /// Why no more can be read, where that is not the clean end.
  [[nodiscard]] std::optional<std::string> defect() const;
  /// All that was read since the last call.
  [[nodiscard]] std::vector<std::uint8_t> take_record();
  /// Share of the file on the disk that is read, 0 to 1.
  [[nodiscard]] double progress() const;

 private:
  std::string path_;
  gzFile file_ = nullptr;
  std::uint64_t file_size_ = 0;
  std::uint64_t position_ = 0;  // in the uncompressed data
  std::vector<std::uint8_t> record_;
};

/// @brief Writes a gzip file, and knows whether all of it reached the disk.
class GzipWriter {
 public:
  /// @param level 0 to 9. @throw std::runtime_error the file is there already, or cannot be made.
  GzipWriter(const std::string& path, int level);
  ~GzipWriter();
  GzipWriter(const GzipWriter&) = delete;
  GzipWriter& operator=(const GzipWriter&) = delete;

  /// @throw std::runtime_error the system's reason, as "No space left on device".
  void write(const std::vector<std::uint8_t>& bytes);
  void close();

 private:
  [[noreturn]] void fail(int error_number) const;

  std::string path_;
  gzFile file_ = nullptr;
};

}  // namespace lidar_upsampling
