// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <array>
#include <exception>
#include <ostream>
#include <streambuf>
#include <string>

#include "lidar_upsampling/io/output_file.h"

namespace lidar_upsampling {

/// An output as a stream.
class TextFile {
 public:
  /// @throw std::runtime_error as OutputFile
  explicit TextFile(const std::string& path, const OutputOptions& options = {});

  [[nodiscard]] std::ostream& stream() { return stream_; }
  /// @throw std::runtime_error as OutputFile; not all could be written.
  void commit();

 private:
  // A stream swallows what is thrown: it is kept for commit().
  class Buffer : public std::streambuf {
   public:
    explicit Buffer(OutputFile& file) : file_(file) { clear(); }
    int sync() override;
    [[nodiscard]] const std::exception_ptr& error() const { return error_; }

   protected:
    int_type overflow(int_type c) override;

   private:
    void clear() { setp(bytes_.data(), bytes_.data() + bytes_.size()); }

    OutputFile& file_;
    std::exception_ptr error_;
    std::array<char, 1U << 16U> bytes_{};
  };

  OutputFile file_;
  Buffer buffer_;
  std::ostream stream_;
};

}  // namespace lidar_upsampling
