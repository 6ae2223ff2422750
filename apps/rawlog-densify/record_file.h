// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstring>
#include <functional>
#include <string>
#include <type_traits>
#include <vector>

#include "lidar_upsampling/io/output_file.h"
#include "lidar_upsampling/types.h"

namespace lidar_upsampling {

/// Appends values as memory has them: the process that writes them reads them.
class RecordWriter {
 public:
  explicit RecordWriter(std::string& bytes) : bytes_(bytes) {}

  template <typename Value>
  void operator()(const Value& value) {
    static_assert(std::is_trivially_copyable_v<Value>);
    put(&value, sizeof value);
  }
  template <int kRows, int kColumns>
  void operator()(const Eigen::Matrix<double, kRows, kColumns>& matrix) {
    put(matrix.data(), sizeof(double) * kRows * kColumns);
  }
  void operator()(const Pose& pose) { (*this)(pose.matrix()); }
  void operator()(const std::string& text) {
    (*this)(text.size());
    put(text.data(), text.size());
  }
  template <typename Value>
  void operator()(const std::vector<Value>& values) {
    static_assert(std::is_trivially_copyable_v<Value>);
    (*this)(values.size());
    put(values.data(), values.size() * sizeof(Value));
  }

 private:
  void put(const void* from, std::size_t size) {
    bytes_.append(static_cast<const char*>(from), size);
  }

  std::string& bytes_;
};

/// The way back, in the same order.
class RecordReader {
 public:
  explicit RecordReader(const char* at) : at_(at) {}

  template <typename Value>
  void operator()(Value& value) {
    static_assert(std::is_trivially_copyable_v<Value>);
    take(&value, sizeof value);
  }
  template <int kRows, int kColumns>
  void operator()(Eigen::Matrix<double, kRows, kColumns>& matrix) {
    take(matrix.data(), sizeof(double) * kRows * kColumns);
  }
  void operator()(Pose& pose) { (*this)(pose.matrix()); }
  void operator()(std::string& text) {
    text.resize(size());
    take(text.data(), text.size());
  }
  template <typename Value>
  void operator()(std::vector<Value>& values) {
    static_assert(std::is_trivially_copyable_v<Value>);
    values.resize(size());
    take(values.data(), values.size() * sizeof(Value));
  }

 private:
  std::size_t size() {
    std::size_t size = 0;
    (*this)(size);
    return size;
  }
  void take(void* to, std::size_t size) {
    if (size > 0) std::memcpy(to, at_, size);
    at_ += size;
  }

  const char* at_;
};

/// @brief Records that are read again by the process that writes them: in a file without a name, as
/// memory would grow with the log.
class RecordFile {
 public:
  /// @param beside what the file lies on one disk with. @throw std::runtime_error as OutputFile
  explicit RecordFile(const std::string& beside) : file_(OutputFile::scratch(beside)) {}

  /// @param write what puts the record's values. @throw std::runtime_error the disk is full
  void add(const std::function<void(RecordWriter&)>& write);
  /// All of them in their order.
  void for_each(const std::function<void(RecordReader&)>& use) const;

 private:
  OutputFile file_;
  std::string waiting_;  ///< to be written, whole records
};

}  // namespace lidar_upsampling
