// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/io/file_places.h"

#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "lidar_upsampling/io/unpacker.h"

namespace fs = std::filesystem;

namespace lidar_upsampling {
namespace {

// Links to links end somewhere, but for those in a circle.
fs::path without_links(fs::path path) {
  constexpr int kMostLinks = 40;
  for (int i = 0; i < kMostLinks && fs::is_symlink(fs::symlink_status(path)); ++i)
    path = path.parent_path() / fs::read_symlink(path);
  return path;
}

bool is_one_file(const std::string& a, const std::string& b) {
  std::error_code error;
  return fs::equivalent(a, b, error) && !error;
}

std::string amount(double bytes) {
  const bool is_little = bytes < 1e7;
  return std::to_string(static_cast<std::uint64_t>(bytes / (is_little ? 1e3 : 1e6))) +
         (is_little ? " kB" : " MB");
}

}  // namespace

bool is_device_or_pipe(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  return fs::is_character_file(status) || fs::is_fifo(status) || fs::is_socket(status);
}

std::string output_place(const std::string& path, bool overwrite) {
  if (path.empty()) throw std::runtime_error("the name of an output is empty");
  const fs::path target = without_links(fs::absolute(path));
  const fs::path folder = target.parent_path();
  std::error_code error;
  if (!fs::is_directory(folder, error))
    throw std::runtime_error("cannot write '" + path + "': there is no folder " + folder.string());
  if (fs::exists(target, error)) {
    if (!fs::is_regular_file(target)) throw std::runtime_error(path + " is no regular file");
    if (!overwrite) throw std::runtime_error(path + " exists: pass --overwrite to replace it");
  }
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    throw std::runtime_error("cannot write '" + path +
                             "' into its folder: " + std::generic_category().message(errno));
  return (fs::canonical(folder) / target.filename()).string();
}

void check_files(const std::vector<FileUse>& inputs, const std::vector<FileUse>& outputs) {
  std::map<std::string, std::string> told_by_place;
  for (const FileUse& output : outputs) {
    if (output.path.empty() || is_device_or_pipe(output.path)) continue;
    for (const FileUse& input : inputs)
      if (!input.path.empty() && is_one_file(input.path, output.path))
        throw std::runtime_error(output.told_by + " " + output.path + ": that is the file of " +
                                 input.told_by + ", which is read");
    const auto [other, is_new] =
        told_by_place.emplace(output_place(output.path, true), output.told_by);
    if (!is_new)
      throw std::runtime_error(output.told_by + " " + output.path + ": " + other->second +
                               " goes there, too");
  }
}

void check_room(const FileUse& output, double least) {
  if (output.path.empty() || is_device_or_pipe(output.path)) return;
  struct statvfs disk {};
  const std::string folder = fs::path(output_place(output.path, true)).parent_path().string();
  if (statvfs(folder.c_str(), &disk) != 0 || disk.f_blocks == 0) return;
  const auto blocks = geteuid() == 0 ? disk.f_bfree : disk.f_bavail;
  const double free = static_cast<double>(blocks) * static_cast<double>(disk.f_frsize);
  if (free >= least) return;
  throw std::runtime_error(output.told_by + " " + output.path + ": " + amount(free) +
                           " are free there, and it takes more than " + amount(least));
}

void check_room(const FileUse& output, const std::string& input, bool as_it_is, double share) {
  constexpr double kPackedAnew = 0.5;  // by another packer: never as little
  std::error_code error;
  if (!fs::is_regular_file(input, error)) return;
  const bool is_packed = Unpacker(input).is_packed();
  if (!is_packed && !as_it_is) return;  // nobody knows
  const double packed_anew = is_packed && !as_it_is ? kPackedAnew : 1;
  check_room(output, static_cast<double>(fs::file_size(input)) * packed_anew * share);
}

std::string FileNames::of(const std::string& label) {
  const auto known = by_label_.find(label);
  if (known != by_label_.end()) return known->second;
  std::string plain = label;
  const auto may_not_be = [](unsigned char c) { return c == '/' || c < ' '; };
  std::replace_if(plain.begin(), plain.end(), may_not_be, '_');
  std::string name = plain;
  const auto is_taken = [&] {
    return std::any_of(by_label_.begin(), by_label_.end(),
                       [&](const auto& other) { return other.second == name; });
  };
  for (int number = 2; is_taken(); ++number) name = plain + "-" + std::to_string(number);
  return by_label_[label] = name;
}

}  // namespace lidar_upsampling
