// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/io/external_storage.h"

#include <filesystem>
#include <system_error>

namespace fs = std::filesystem;

namespace lidar_upsampling {

std::string external_storage_of(const std::string& rawlog_path) {
  // Not CRawlog::detectImagesDirectory(): MRPT before 2.8.0 drops the file's stem there.
  const fs::path absolute = fs::absolute(rawlog_path);
  const fs::path stem = absolute.parent_path() / absolute.stem();
  for (const char* const ending : {"_Images", "_images", "_IMAGES"}) {
    std::error_code ignored;
    if (fs::is_directory(stem.string() + ending, ignored)) return stem.string() + ending;
  }
  return stem.string() + "_Images";
}

bool share_external_storage(const std::string& source_rawlog, const std::string& target_rawlog) {
  const fs::path source = external_storage_of(source_rawlog);
  std::error_code ignored;
  if (!fs::is_directory(source, ignored)) return true;
  const fs::path target = external_storage_of(target_rawlog);
  if (fs::equivalent(source, target, ignored)) return true;
  if (fs::is_symlink(target, ignored) && !fs::exists(target, ignored)) fs::remove(target, ignored);
  if (fs::exists(target, ignored)) return false;
  std::error_code error;
  fs::create_directory_symlink(fs::relative(source, fs::canonical(target.parent_path())), target,
                               error);
  return !error;
}

}  // namespace lidar_upsampling
