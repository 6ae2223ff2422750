// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

class RecordFile;
struct ScanResult;

/// @brief What a file without a name is to lie beside: this, or of nothing, where the system has
/// its temporary files. @throw std::runtime_error there is no such folder.
[[nodiscard]] std::string scratch_place(const std::string& beside);

/// @brief What figures, pages and documents need of all scans, in their order: in a file without a
/// name, as an hour of log has many.
class ScanResults {
 public:
  /// @param beside as of scratch_place()
  explicit ScanResults(std::string beside = {});
  ~ScanResults();
  ScanResults(ScanResults&& other) noexcept;
  ScanResults& operator=(ScanResults&& other) noexcept;

  /// @throw std::runtime_error the disk is full, or may not be written to
  void add(const ScanResult& scan);
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  /// Of the first scan; zero if there is none.
  [[nodiscard]] Stamp first_key_stamp() const { return first_key_stamp_; }
  /// What the file lies beside, for another one.
  [[nodiscard]] const std::string& beside() const { return beside_; }

  /// @brief All of them, without their objects' points and last motions, and with the estimates of
  /// row `ours` alone. The scan may be changed or taken.
  void for_each(const std::function<void(ScanResult&)>& use) const;

 private:
  std::string beside_;
  std::unique_ptr<RecordFile> file_;  ///< from the first scan on
  std::size_t size_ = 0;
  Stamp first_key_stamp_{};
};

}  // namespace lidar_upsampling
