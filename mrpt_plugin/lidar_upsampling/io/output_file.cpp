// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/io/output_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <mutex>
#include <set>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

#include "lidar_upsampling/io/file_places.h"
#include "lidar_upsampling/io/temporary_names.h"
#include "lidar_upsampling/io/unpacker.h"

namespace fs = std::filesystem;

namespace lidar_upsampling {
namespace {

constexpr mode_t kAllMayReadAndWrite = 0666;  // but for the umask

/// The files that this process is about to write.
class Targets {
 public:
  void add(const std::string& target, const std::string& path) {
    const std::lock_guard lock(mutex_);
    if (!targets_.insert(target).second)
      throw std::runtime_error(path + ": two outputs would go there");
  }
  void remove(const std::string& target) {
    const std::lock_guard lock(mutex_);
    targets_.erase(target);
  }
  static Targets& of_process() {
    static Targets targets;
    return targets;
  }

 private:
  std::mutex mutex_;
  std::set<std::string> targets_;
};

std::string name_by_descriptor(int file) { return "/proc/self/fd/" + std::to_string(file); }

// -1: there are none on this file system, or they could not get a name.
int open_without_name(const std::string& folder) {
  const int file = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, kAllMayReadAndWrite);
  if (file < 0 || ::access(name_by_descriptor(file).c_str(), F_OK) == 0) return file;
  ::close(file);
  return -1;
}

void sync(int file, const std::string& path) {
  if (fsync(file) == 0 || errno == EINVAL || errno == ENOTSUP || errno == EROFS) return;
  throw std::runtime_error("cannot write " + path + ": " + std::generic_category().message(errno));
}

// So that the name is on the disk, too.
void sync_folder_of(const std::string& target) {
  const int folder =
      ::open(fs::path(target).parent_path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return;  // one that may be written to, not read
  static_cast<void>(fsync(folder));
  ::close(folder);
}

}  // namespace

OutputFile::OutputFile(const std::string& path, const OutputOptions& options)
    : path_(path), options_(options) {
  if (options.may_be_device && is_device_or_pipe(path)) {
    file_ = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (file_ < 0) throw_open_error(path, "writing", errno);
    return;
  }
  const std::string target = output_place(path, options.overwrite);
  Targets::of_process().add(target, path);
  target_ = target;
  try {
    remove_stale_temporaries(target_);
    open_in(fs::path(target_).parent_path().string(), options.has_name);
  } catch (...) {
    Targets::of_process().remove(target_);
    throw;
  }
}

OutputFile OutputFile::scratch(const std::string& beside) {
  OutputFile file;
  file.path_ = beside;
  const std::string folder = is_device_or_pipe(beside)
                                 ? fs::temp_directory_path().string()
                                 : fs::path(output_place(beside, true)).parent_path().string();
  file.target_ = folder + "/scratch";
  file.open_in(folder, false);
  file.target_.clear();
  if (file.name_) file.name_.reset();  // removes it: what is open goes on without
  return file;
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : path_(std::move(other.path_)),
      target_(std::exchange(other.target_, {})),
      options_(other.options_),
      file_(std::exchange(other.file_, -1)),
      size_(other.size_),
      sent_(other.sent_),
      name_(std::move(other.name_)) {}

OutputFile::~OutputFile() {
  if (!target_.empty()) Targets::of_process().remove(target_);
  name_.reset();
  if (file_ >= 0) ::close(file_);
}

void OutputFile::open_in(const std::string& folder, bool has_name) {
  if (!has_name) file_ = open_without_name(folder);
  if (file_ < 0) {
    name_ = std::make_unique<TemporaryName>(target_);
    file_ =
        ::open(name_->path().c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, kAllMayReadAndWrite);
    if (file_ < 0) throw_open_error(path_, "writing", errno);
  }
  lock_temporary(file_);
}

void OutputFile::fail(int error_number) const {
  throw std::runtime_error("cannot write " + path_ + ": " +
                           std::generic_category().message(error_number));
}

void OutputFile::write(const void* bytes, std::size_t size) {
  const char* const begin = static_cast<const char*>(bytes);
  for (std::size_t done = 0; done < size;) {
    const ssize_t written = ::write(file_, begin + done, size - done);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(errno);
    done += static_cast<std::size_t>(written);
  }
  size_ += size;
  begin_sync();
}

// The disk begins while the work goes on, so that the end need not wait for all of it.
void OutputFile::begin_sync() {
#ifdef SYNC_FILE_RANGE_WRITE
  constexpr std::uint64_t kStep = 8U << 20U;
  if (size_ - sent_ < kStep) return;
  static_cast<void>(sync_file_range(file_, static_cast<off_t>(sent_),
                                    static_cast<off_t>(size_ - sent_), SYNC_FILE_RANGE_WRITE));
  sent_ = size_;
#endif
}

void OutputFile::append(const OutputFile& other) {
  std::vector<char> block(1U << 20U);
  for (std::uint64_t from = 0; from < other.size();) {
    const std::size_t step = other.read(from, block.data(), block.size());
    if (step == 0) fail(EIO);
    write(block.data(), step);
    from += step;
  }
}

std::size_t OutputFile::read(std::uint64_t from, void* bytes, std::size_t size) const {
  std::size_t done = 0;
  while (done < size) {
    const ssize_t step = ::pread(file_, static_cast<char*>(bytes) + done, size - done,
                                 static_cast<off_t>(from + done));
    if (step < 0 && errno == EINTR) continue;
    if (step < 0) fail(errno);
    if (step == 0) break;
    done += static_cast<std::size_t>(step);
  }
  return done;
}

void OutputFile::clear() {
  if (ftruncate(file_, 0) != 0 || lseek(file_, 0, SEEK_SET) != 0) fail(errno);
  size_ = sent_ = 0;
}

// The file's first or next name: one that is there is replaced or an error.
void OutputFile::link_as(const std::string& name, bool replace) {
  if (name_ && !replace && ::link(name_->path().c_str(), name.c_str()) == 0) return;
  // Not all file systems know more than one name of a file.
  const bool by_renaming = name_ && (replace || errno == EPERM || errno == ENOTSUP);
  if (by_renaming && std::rename(name_->path().c_str(), name.c_str()) == 0) {
    name_->release();
    return;
  }
  if (!name_ && ::linkat(AT_FDCWD, name_by_descriptor(file_).c_str(), AT_FDCWD, name.c_str(),
                         AT_SYMLINK_FOLLOW) == 0)
    return;
  fail(errno);
}

void OutputFile::give_name() {
  static_cast<void>(output_place(path_, options_.overwrite));  // what is there now
  const bool replace = options_.overwrite && fs::exists(target_);
  if (!replace) {
    link_as(target_, false);
    return;
  }
  if (!name_) {
    auto name = std::make_unique<TemporaryName>(target_);
    link_as(name->path(), false);
    name_ = std::move(name);
  }
  link_as(target_, true);
}

void OutputFile::commit() {
  if (!target_.empty()) {
    sync(file_, path_);
    give_name();
    name_.reset();
    sync_folder_of(target_);
    Targets::of_process().remove(std::exchange(target_, {}));
  }
  if (::close(std::exchange(file_, -1)) != 0) fail(errno);
}

void write_file(const std::string& path, const std::string& bytes, const OutputOptions& options) {
  OutputFile file(path, options);
  file.write(bytes);
  file.commit();
}

}  // namespace lidar_upsampling
