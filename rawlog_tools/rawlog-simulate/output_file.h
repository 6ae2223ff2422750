// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <fstream>
#include <string>

namespace lidar_upsampling::sim {

/// A text file that is written under a temporary name and gets its own on `commit()`, else
/// disappears.
class OutputFile {
 public:
  /// @throw std::runtime_error it exists and `overwrite` is off, or cannot be written.
  OutputFile(std::string path, bool overwrite);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  std::ostream& stream() { return file_; }
  /// @throw std::runtime_error not all of it could be written.
  void commit();

 private:
  std::string path_;
  std::string temporary_;
  std::ofstream file_;
};

}  // namespace lidar_upsampling::sim
