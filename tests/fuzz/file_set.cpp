// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "fuzz/file_set.h"

#include <algorithm>
#include <filesystem>
#include <iterator>

#include "fuzz/fuzz_folder.h"

namespace fs = std::filesystem;

namespace lidar_upsampling::fuzz {
namespace {

bool is_text(const std::string& content) {
  return std::all_of(content.begin(), content.end(),
                     [](char c) { return c == '\n' || (c >= ' ' && c <= '~'); });
}

}  // namespace

FileSet::FileSet(const std::string& name, std::map<std::string, std::string> files)
    : folder_(in_work_folder(name)), files_(std::move(files)) {
  for (const auto& [file, content] : files_) {
    fs::create_directories(fs::path(path(file)).parent_path());
    write_file_of(path(file), content);
  }
}

void FileSet::mend() {
  for (const auto& [file, content] : spoilt_) write_file_of(path(file), content);
  spoilt_.clear();
}

void FileSet::spoil(Random& random) {
  mend();
  const std::size_t times = random.one_in(4) ? 2 : 1;
  for (std::size_t i = 0; i < times; ++i) spoil_one(random);
}

void FileSet::spoil_one(Random& random) {
  const auto chosen =
      std::next(files_.begin(), static_cast<std::ptrdiff_t>(random.below(files_.size())));
  const auto& [file, content] = *chosen;
  spoilt_[file] = content;
  if (random.one_in(30)) {
    fs::remove(path(file));
    return;
  }
  if (is_text(content)) {
    write_file_of(path(file), damaged_text(content, random));
    return;
  }
  Bytes bytes(content.begin(), content.end());
  damage(bytes, random);
  write_file_of(path(file), bytes);
}

}  // namespace lidar_upsampling::fuzz
