// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "output_file.h"

#include <unistd.h>

#include <filesystem>
#include <stdexcept>

namespace lidar_upsampling::sim {

OutputFile::OutputFile(std::string path, bool overwrite)
    : path_(std::move(path)), temporary_(path_ + "." + std::to_string(getpid()) + ".part") {
  if (!overwrite && std::filesystem::exists(path_)) {
    throw std::runtime_error(path_ + ": exists; --overwrite replaces it");
  }
  file_.open(temporary_, std::ios::trunc);
  if (!file_) throw std::runtime_error(path_ + ": cannot be written; does its folder exist?");
}

OutputFile::~OutputFile() {
  if (temporary_.empty()) return;
  std::error_code ignored;
  std::filesystem::remove(temporary_, ignored);
}

void OutputFile::commit() {
  file_.close();
  if (!file_) throw std::runtime_error(path_ + ": could not be written in full; is the disk full?");
  std::filesystem::rename(temporary_, path_);
  temporary_.clear();
}

}  // namespace lidar_upsampling::sim
