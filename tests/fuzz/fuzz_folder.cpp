// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "fuzz/fuzz_folder.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace fs = std::filesystem;

namespace lidar_upsampling::fuzz {
namespace {

// Writing to a disk, and waiting for it, would take most of the time.
class Folder {
 public:
  Folder() {
    constexpr const char* kInMemory = "/dev/shm";
    const bool has_memory = fs::is_directory(kInMemory) && access(kInMemory, W_OK) == 0;
    const fs::path above = has_memory ? fs::path(kInMemory) : fs::temp_directory_path();
    std::string name = (above / "lidar_upsampling_fuzz_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make a folder " + name);
    path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

void write_all(const std::string& path, const char* bytes, std::size_t size) {
  std::ofstream file(path, std::ios::binary);
  file.write(bytes, static_cast<std::streamsize>(size));
  if (!file) throw std::logic_error("cannot write " + path);
}

}  // namespace

const std::string& work_folder() {
  static const Folder folder;
  return folder.path();
}

void write_file_of(const std::string& path, const Bytes& bytes) {
  write_all(path, reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

void write_file_of(const std::string& path, const std::string& text) {
  write_all(path, text.data(), text.size());
}

}  // namespace lidar_upsampling::fuzz
