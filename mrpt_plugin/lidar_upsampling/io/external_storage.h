// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <string>

namespace lidar_upsampling {

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

}  // namespace lidar_upsampling
