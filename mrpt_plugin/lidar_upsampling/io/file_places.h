// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <map>
#include <string>
#include <vector>

namespace lidar_upsampling {

/// @brief Where an output really goes: its folder without links, and what the output is a link to,
/// be that there or not.
/// @throw std::runtime_error the folder is not there or may not be written to, something of that
/// name is no regular file, or it exists and is not to be replaced.
[[nodiscard]] std::string output_place(const std::string& path, bool overwrite);

/// Whether there is something to write to that is neither file nor folder.
[[nodiscard]] bool is_device_or_pipe(const std::string& path);

/// A file that a tool is told to use, and how it was told: "--report".
struct FileUse {
  std::string told_by, path;
};

/// @brief Looks at all outputs before any work: whether each can be written, and is none of the
/// inputs, by whatever name. Empty paths are not used.
/// @throw std::runtime_error which one, and why
void check_files(const std::vector<FileUse>& inputs, const std::vector<FileUse>& outputs);

/// @brief Looks whether an output has room, before the work.
/// @param least bytes that it takes in any case
/// @throw std::runtime_error how much is free, and how much it takes at least
void check_room(const FileUse& output, double least);

/// @brief Likewise for a log that is made of another one, of which this share at least is written
/// again.
/// @param as_it_is it is not packed, or as the other one is.
void check_room(const FileUse& output, const std::string& input, bool as_it_is, double share = 1);

/// @brief What labels are called in names of files: `/` and what may not be there is `_`; labels
/// that become the same thereby are told apart by a number.
class FileNames {
 public:
  [[nodiscard]] std::string of(const std::string& label);

 private:
  std::map<std::string, std::string> by_label_;
};

}  // namespace lidar_upsampling
