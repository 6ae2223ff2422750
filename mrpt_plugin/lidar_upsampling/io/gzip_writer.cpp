// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/io/gzip_writer.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "lidar_upsampling/io/unpacker.h"

namespace lidar_upsampling {
namespace {

constexpr std::size_t kMember = 1U << 20U;  // at least: smaller ones pack worse
constexpr std::size_t kMostWaiting = 4;     // members: the log's speed is what is written

}  // namespace

GzipWriter::GzipWriter(const std::string& path, Compression compression)
    : path_(path), packer_(make_packer(compression)) {
  constexpr mode_t kAllMayReadAndWrite = 0666;  // but for the umask
  file_ = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kAllMayReadAndWrite);
  if (file_ < 0) throw_open_error(path, "writing", errno);
  worker_ = std::thread([this] { work(); });
}

GzipWriter::~GzipWriter() {
  if (worker_.joinable()) join();
  if (file_ >= 0) ::close(file_);
}

void GzipWriter::fail(int error_number) const {
  throw std::runtime_error("cannot write " + path_ + ": " +
                           std::generic_category().message(error_number));
}

void GzipWriter::write(const Bytes& bytes) {
  block_.insert(block_.end(), bytes.begin(), bytes.end());
  if (block_.size() >= kMember) hand_over(std::exchange(block_, {}));
}

void GzipWriter::hand_over(Bytes block) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return error_ || waiting_.size() < kMostWaiting; });
  if (error_) std::rethrow_exception(error_);
  waiting_.push_back(std::move(block));
  lock.unlock();
  changed_.notify_all();
}

void GzipWriter::join() {
  {
    const std::lock_guard lock(mutex_);
    is_over_ = true;
  }
  changed_.notify_all();
  worker_.join();
}

void GzipWriter::close() {
  if (!block_.empty()) hand_over(std::exchange(block_, {}));
  join();
  if (error_) std::rethrow_exception(error_);
  const int file = std::exchange(file_, -1);
  const bool is_safe = fsync(file) == 0 || errno == EINVAL || errno == ENOTSUP;
  const int error_number = errno;
  if (::close(file) != 0 && is_safe) fail(errno);
  if (!is_safe) fail(error_number);
}

void GzipWriter::work() {
  while (true) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return is_over_ || !waiting_.empty(); });
    if (waiting_.empty()) return;
    const Bytes block = std::move(waiting_.front());
    waiting_.pop_front();
    lock.unlock();
    changed_.notify_all();
    try {
      write_out(packer_->pack(block));
    } catch (...) {
      lock.lock();
      error_ = std::current_exception();
      lock.unlock();
      changed_.notify_all();
      return;
    }
  }
}

void GzipWriter::write_out(const Bytes& bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t written = ::write(file_, bytes.data() + done, bytes.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(errno);
    done += static_cast<std::size_t>(written);
  }
}

}  // namespace lidar_upsampling
