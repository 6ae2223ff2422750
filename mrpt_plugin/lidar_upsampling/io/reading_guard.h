// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "lidar_upsampling/io/silence.h"

namespace lidar_upsampling {

/// How the exception of a broken JPEG picture begins.
inline constexpr const char* kBrokenJpeg = "a JPEG picture is broken: ";

/// @brief While it lives, MRPT believes nothing that it reads on this thread: a piece of memory
/// beyond what an object and the rest of the file can fill is refused by std::bad_alloc, and so are
/// many small ones. MRPT stores nothing smaller than it is in memory, but for pictures, which
/// libjpeg makes.
///
/// With the first one, this holds for the whole process and all threads: where memory is short,
/// MRPT's aligned vectors throw std::bad_alloc (MRPT 2.5.8 uses the null pointer); a broken JPEG
/// picture is a std::runtime_error (libjpeg ends the process), and neither it, nor a broken PNG
/// picture, nor a class that cannot be made prints a line of its own; an action or its motion that
/// is none is an exception (MRPT uses the null pointer).
class ReadingGuard {
 public:
  /// What the object and the rest of the file hold, unpacked; none: not known.
  using BytesLeft = std::function<std::optional<std::uint64_t>()>;

  /// On this thread, nothing is refused while it lives.
  class Pause {
   public:
    Pause();
    ~Pause();
    Pause(const Pause&) = delete;
    Pause& operator=(const Pause&) = delete;

   private:
    ReadingGuard* paused_;
  };

  /// @param bytes_left asked for where much memory is wanted only.
  explicit ReadingGuard(BytesLeft bytes_left);
  ~ReadingGuard();
  ReadingGuard(const ReadingGuard&) = delete;
  ReadingGuard& operator=(const ReadingGuard&) = delete;

  /// @return all bytes that were asked for so far, these among them.
  std::uint64_t count(std::uint64_t size) { return count_ += size; }

  /// @throw std::bad_alloc that says how many bytes. @param per_byte bytes that one of the file may
  /// unpack to.
  void check(std::uint64_t size, std::uint64_t per_byte);
  void check_all();  ///< likewise, of all that was counted

 private:
  std::uint64_t left();

  Silence silence_;
  BytesLeft bytes_left_;
  std::optional<std::uint64_t> left_;  // once asked for
  std::uint64_t count_ = 0;
  ReadingGuard* outer_;
};

}  // namespace lidar_upsampling
