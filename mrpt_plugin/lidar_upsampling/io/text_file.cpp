// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/io/text_file.h"

namespace lidar_upsampling {

int TextFile::Buffer::sync() {
  try {
    if (!error_) file_.write(pbase(), static_cast<std::size_t>(pptr() - pbase()));
  } catch (...) {
    error_ = std::current_exception();
  }
  clear();
  return error_ ? -1 : 0;
}

TextFile::Buffer::int_type TextFile::Buffer::overflow(int_type c) {
  if (sync() != 0) return traits_type::eof();
  if (traits_type::eq_int_type(c, traits_type::eof())) return traits_type::not_eof(c);
  *pptr() = traits_type::to_char_type(c);
  pbump(1);
  return c;
}

TextFile::TextFile(const std::string& path, const OutputOptions& options)
    : file_(path, options), buffer_(file_), stream_(&buffer_) {}

void TextFile::commit() {
  stream_.flush();
  if (buffer_.error()) std::rethrow_exception(buffer_.error());
  file_.commit();
}

}  // namespace lidar_upsampling
