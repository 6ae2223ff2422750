// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace lidar_upsampling {

class TemporaryName;

struct OutputOptions {
  bool overwrite = false;      ///< replace a file of that name
  bool may_be_device = false;  ///< /dev/stdout, a pipe: what goes there is seen at once
  bool has_name = false;       ///< a temporary one, even where files may be without
};

/// @brief The one way in which anything is written: a file without a name, or under a temporary one
/// where the file system knows no others, that appears under its own when it is complete, at once,
/// and is on the disk then. Through symbolic links, so that these are kept. What killed runs have
/// left of the same file is removed.
class OutputFile {
 public:
  /// @throw std::runtime_error the folder is not there or may not be written to, something of that
  /// name is no regular file, it exists and is not to be replaced, or it is written by this process
  /// already.
  explicit OutputFile(const std::string& path, const OutputOptions& options = {});
  /// A file that never gets a name, on the same disk as another. @throw std::runtime_error likewise
  [[nodiscard]] static OutputFile scratch(const std::string& beside);
  ~OutputFile();
  OutputFile(OutputFile&& other) noexcept;
  OutputFile& operator=(OutputFile&&) = delete;

  /// As it was asked for.
  [[nodiscard]] const std::string& path() const { return path_; }
  /// Bytes written.
  [[nodiscard]] std::uint64_t size() const { return size_; }

  /// @throw std::runtime_error with the system's reason, as "No space left on device".
  void write(const void* bytes, std::size_t size);
  void write(const std::string& text) { write(text.data(), text.size()); }
  /// Writes all of another file.
  void append(const OutputFile& other);
  /// @return how many bytes there were. @throw std::runtime_error with the system's reason.
  std::size_t read(std::uint64_t from, void* bytes, std::size_t size) const;
  /// Back to no bytes.
  void clear();
  /// The last call to make. @throw std::runtime_error a write error, or something of that name has
  /// come up in the meantime.
  void commit();

 private:
  OutputFile() = default;
  void open_in(const std::string& folder, bool has_name);
  void link_as(const std::string& name, bool replace);
  void give_name();
  void begin_sync();
  [[noreturn]] void fail(int error_number) const;

  std::string path_;
  std::string target_;  ///< where it really goes; empty: it never gets a name, or has it already
  OutputOptions options_;
  int file_ = -1;
  std::uint64_t size_ = 0;
  std::uint64_t sent_ = 0;  ///< of them, on their way to the disk
  std::unique_ptr<TemporaryName> name_;
};

/// @brief Writes a whole file in one go.
/// @throw std::runtime_error as OutputFile
void write_file(const std::string& path, const std::string& bytes,
                const OutputOptions& options = {true});

}  // namespace lidar_upsampling
