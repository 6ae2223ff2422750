// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/io/gzip_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

namespace lidar_upsampling {
namespace {

constexpr unsigned kBufferSize = 1U << 18U;
constexpr std::size_t kLargestStep = 1U << 30U;  // zlib counts in unsigned int

[[noreturn]] void throw_open_error(const std::string& path, const char* purpose, int error_number) {
  throw std::runtime_error("cannot open " + path + " for " + purpose + ": " +
                           std::generic_category().message(error_number));
}

}  // namespace

RecordingGzipReader::RecordingGzipReader(const std::string& path) : path_(path) {
  struct stat info {};
  if (stat(path.c_str(), &info) != 0) throw_open_error(path, "reading", errno);
  if (S_ISDIR(info.st_mode)) throw_open_error(path, "reading", EISDIR);
  file_size_ = static_cast<std::uint64_t>(info.st_size);
  file_ = gzopen(path.c_str(), "rb");
  if (file_ == nullptr) throw_open_error(path, "reading", errno);
  gzbuffer(file_, kBufferSize);
}

RecordingGzipReader::~RecordingGzipReader() { gzclose_r(file_); }

size_t RecordingGzipReader::Read(void* buffer, size_t count) {
  auto* const out = static_cast<std::uint8_t*>(buffer);
  std::size_t done = 0;
  while (done < count) {
    const auto step = static_cast<unsigned>(std::min(count - done, kLargestStep));
    const int got = gzread(file_, out + done, step);
    if (got <= 0) break;
    done += static_cast<std::size_t>(got);
  }
  record_.insert(record_.end(), out, out + done);
  position_ += done;
  return done;
}

bool RecordingGzipReader::at_end() {
  const int next = gzgetc(file_);
  if (next < 0) return true;
  gzungetc(next, file_);
  return false;
}

std::optional<std::string> RecordingGzipReader::defect() const {
  int code = Z_OK;
  const char* const text = gzerror(file_, &code);
  if (code == Z_OK || code == Z_STREAM_END) return std::nullopt;
  if (code == Z_BUF_ERROR) return "the gzip stream is cut off";
  if (code == Z_ERRNO) return std::string("read error: ") + text;
  return std::string("the gzip stream is damaged: ") + text;
}

std::vector<std::uint8_t> RecordingGzipReader::take_record() {
  // Not moved out: the next object is likely as large, and so is read without growing step by step.
  std::vector<std::uint8_t> bytes(record_);
  record_.clear();
  return bytes;
}

double RecordingGzipReader::progress() const {
  const auto offset = gzoffset(file_);
  if (file_size_ == 0 || offset < 0) return 1.;
  return std::min(1., static_cast<double>(offset) / static_cast<double>(file_size_));
}

GzipWriter::GzipWriter(const std::string& path, int level) : path_(path) {
  const std::string mode = "wbxe" + std::to_string(level);
  file_ = gzopen(path.c_str(), mode.c_str());
  if (file_ == nullptr) throw_open_error(path, "writing", errno);
  gzbuffer(file_, kBufferSize);
}

GzipWriter::~GzipWriter() {
  if (file_ != nullptr) gzclose_w(file_);
}

void GzipWriter::fail(int error_number) const {
  throw std::runtime_error("cannot write " + path_ + ": " +
                           std::generic_category().message(error_number));
}

void GzipWriter::write(const std::vector<std::uint8_t>& bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const auto step = static_cast<unsigned>(std::min(bytes.size() - done, kLargestStep));
    if (gzwrite(file_, bytes.data() + done, step) != static_cast<int>(step)) fail(errno);
    done += step;
  }
}

void GzipWriter::close() {
  const int code = gzclose_w(std::exchange(file_, nullptr));
  if (code != Z_OK) fail(code == Z_ERRNO ? errno : EIO);
  const int descriptor = open(path_.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) fail(errno);
  const bool is_safe = fsync(descriptor) == 0 || errno == EINVAL || errno == ENOTSUP;
  const int error_number = errno;
  ::close(descriptor);
  if (!is_safe) fail(error_number);
}

}  // namespace lidar_upsampling
