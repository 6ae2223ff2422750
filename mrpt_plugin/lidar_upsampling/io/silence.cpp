// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/io/silence.h"

#include <iostream>
#include <streambuf>

namespace lidar_upsampling {
namespace {

thread_local int num_silences = 0;

/// Hands on what threads print that are not to be silent.
class SpokenOnly : public std::streambuf {
 public:
  explicit SpokenOnly(std::streambuf* to) : to_(to) {}

 protected:
  int_type overflow(int_type c) override {
    if (num_silences > 0 || traits_type::eq_int_type(c, traits_type::eof()))
      return traits_type::not_eof(c);
    return to_->sputc(traits_type::to_char_type(c));
  }
  std::streamsize xsputn(const char* text, std::streamsize size) override {
    return num_silences > 0 ? size : to_->sputn(text, size);
  }
  int sync() override { return num_silences > 0 ? 0 : to_->pubsync(); }

 private:
  std::streambuf* to_;
};

}  // namespace

Silence::Silence() {
  // For ever: std::cerr is used to the very end.
  static std::streambuf* const installed = [] {
    auto* const buffer =
        new SpokenOnly(std::cerr.rdbuf());  // NOLINT(cppcoreguidelines-owning-memory)
    std::cerr.rdbuf(buffer);
    return buffer;
  }();
  static_cast<void>(installed);
  ++num_silences;
}

Silence::~Silence() { --num_silences; }

}  // namespace lidar_upsampling
