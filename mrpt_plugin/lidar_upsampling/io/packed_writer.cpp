// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/io/packed_writer.h"

#include <stdexcept>
#include <utility>

#include "lidar_upsampling/io/output_file.h"

namespace lidar_upsampling {
namespace {

// At least: smaller ones pack worse. A picture or a scan fills one, so that it can be copied.
constexpr std::size_t kMember = 1U << 17U;
constexpr std::size_t kMostWaiting = 4;  // members: the log's speed is what is written

}  // namespace

PackedWriter::PackedWriter(OutputFile& file, Compression compression)
    : file_(file),
      packer_(make_packer(compression)),
      takes_members_(packer_->takes_members()),
      worker_([this] { work(); }) {}

PackedWriter::~PackedWriter() {
  if (worker_.joinable()) join();
}

void PackedWriter::write(const Bytes& bytes, const PlaceInMembers& origin) {
  if (origin.is_all && !takes_members_)
    throw std::logic_error("an object whose bytes are forgotten, to be packed otherwise");
  // So that who reads a scan or a picture knows it by its member alone.
  const bool begins_one = takes_members_ && bytes.size() >= kMember && !waits_;
  if (begins_one && !block_.empty()) hand_over({std::exchange(block_, {}), nullptr});
  block_.insert(block_.end(), bytes.begin(), bytes.end());
  waits_ = false;
  if (takes_members_ && origin.ended && (origin.is_all || ends_with(block_, *origin.ended))) {
    if (!origin.is_all) block_.resize(block_.size() - origin.ended->unpacked_size);
    if (!block_.empty()) hand_over({std::exchange(block_, {}), nullptr});
    hand_over({{}, origin.ended});
    return;
  }
  waits_ = takes_members_ && origin.goes_on && block_.size() < PackedMember::kLargest;
  if (block_.size() >= kMember && !waits_) hand_over({std::exchange(block_, {}), nullptr});
}

const PackedWriter::Bytes& PackedWriter::packed(const Block& block) {
  if (!block.packed) return packer_->pack(block.bytes);
  block.packed->read(member_);
  return member_;
}

void PackedWriter::hand_over(Block block) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return error_ || waiting_.size() < kMostWaiting; });
  if (error_) std::rethrow_exception(error_);
  waiting_.push_back(std::move(block));
  lock.unlock();
  changed_.notify_all();
}

void PackedWriter::join() {
  {
    const std::lock_guard lock(mutex_);
    is_over_ = true;
  }
  changed_.notify_all();
  if (worker_.joinable()) worker_.join();
}

void PackedWriter::finish() {
  if (!block_.empty()) hand_over({std::exchange(block_, {}), nullptr});
  join();
  if (error_) std::rethrow_exception(error_);
}

void PackedWriter::work() {
  while (true) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return is_over_ || !waiting_.empty(); });
    const bool is_last = waiting_.empty();
    Block block;
    if (!is_last) {
      block = std::move(waiting_.front());
      waiting_.pop_front();
    }
    lock.unlock();
    changed_.notify_all();
    try {
      const Bytes& bytes = is_last ? packer_->finish() : packed(block);
      file_.write(bytes.data(), bytes.size());
      if (is_last) return;
    } catch (...) {
      lock.lock();
      error_ = std::current_exception();
      lock.unlock();
      changed_.notify_all();
      return;
    }
  }
}

}  // namespace lidar_upsampling
