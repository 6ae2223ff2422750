// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <map>
#include <string>

#include "fuzz/byte_mutations.h"

namespace lidar_upsampling::fuzz {

/// @brief Files that belong together, in the work folder.
class FileSet {
 public:
  /// @param files contents by path within the set's folder.
  FileSet(const std::string& name, std::map<std::string, std::string> files);

  [[nodiscard]] const std::string& folder() const { return folder_; }
  [[nodiscard]] std::string path(const std::string& file) const { return folder_ + "/" + file; }

  /// All are good.
  void mend();
  /// @brief All are good but one or two, which are damaged, empty or not there.
  void spoil(Random& random);

 private:
  void spoil_one(Random& random);

  std::string folder_;
  std::map<std::string, std::string> files_;
  std::map<std::string, std::string> spoilt_;  ///< of the last input
};

}  // namespace lidar_upsampling::fuzz
