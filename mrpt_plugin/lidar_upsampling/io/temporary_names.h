// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <cstddef>
#include <string>

namespace lidar_upsampling {

/// @brief SIGINT, SIGTERM and SIGHUP remove the files under temporary names before they end the
/// process, as they would have done; one that is ignored stays so. For programs, not for a module
/// in another's.
void remove_temporaries_on_signals();

/// @brief Removes what killed runs have left beside a file: temporary names that nobody has locked.
void remove_stale_temporaries(const std::string& path);

/// @brief A name beside a file that nothing has: `<path>.tmp-<twelve hexadecimal digits>`. What
/// lies there is removed with the object, or by a signal.
class TemporaryName {
 public:
  /// @param ending for writers that tell the kind of a file by it: ".mp4"
  explicit TemporaryName(const std::string& path, const std::string& ending = {});
  ~TemporaryName();
  TemporaryName(const TemporaryName&) = delete;
  TemporaryName& operator=(const TemporaryName&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }
  /// What lies there has got another name.
  void release();

 private:
  std::string path_;
  std::size_t slot_;
  bool is_released_ = false;
};

/// Tells remove_stale_temporaries() of others that this open file is in use.
void lock_temporary(int file);

}  // namespace lidar_upsampling
