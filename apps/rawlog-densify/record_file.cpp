// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "record_file.h"

#include <cstdint>
#include <stdexcept>

namespace lidar_upsampling {
namespace {

using Length = std::uint32_t;
constexpr std::size_t kRecordBlock = 1U << 18U;

/// Uses the records that are whole. @return how many bytes these are.
std::size_t use_whole_records(const std::string& block,
                              const std::function<void(RecordReader&)>& use) {
  std::size_t used = 0;
  while (block.size() - used >= sizeof(Length)) {
    Length length = 0;
    std::memcpy(&length, block.data() + used, sizeof length);
    if (block.size() - used - sizeof length < length) break;
    RecordReader reader(block.data() + used + sizeof length);
    used += sizeof length + length;
    use(reader);
  }
  return used;
}

}  // namespace

void RecordFile::add(const std::function<void(RecordWriter&)>& write) {
  const std::size_t begin = waiting_.size();
  RecordWriter writer(waiting_);
  writer(Length(0));
  write(writer);
  const auto length = static_cast<Length>(waiting_.size() - begin - sizeof(Length));
  std::memcpy(waiting_.data() + begin, &length, sizeof length);
  if (waiting_.size() < kRecordBlock) return;
  file_.write(waiting_);
  waiting_.clear();
}

void RecordFile::for_each(const std::function<void(RecordReader&)>& use) const {
  std::string block;
  std::size_t room = kRecordBlock;
  for (std::uint64_t at = 0; at < file_.size();) {
    block.resize(room);
    block.resize(file_.read(at, block.data(), block.size()));
    const std::size_t used = use_whole_records(block, use);
    if (used == 0 && block.size() < room)
      throw std::runtime_error(file_.path() + ": what was put aside is lost");
    if (used == 0) room *= 2;  // a record longer than that
    at += used;
  }
  use_whole_records(waiting_, use);
}

}  // namespace lidar_upsampling
