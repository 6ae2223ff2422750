// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/io/packed_reader.h"

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <filesystem>
#include <limits>
#include <mutex>
#include <thread>
#include <utility>

#include "lidar_upsampling/io/reading_guard.h"

namespace lidar_upsampling {

/// The thread that unpacks, and what it has ready.
class PackedReader::Ahead {
 public:
  explicit Ahead(const std::string& path) : unpacker_(path), file_size_(unpacker_.file_size()) {
    unpacker_.keep_members();
    thread_ = std::thread([this] { unpack(); });
  }
  ~Ahead() {
    {
      const std::lock_guard lock(mutex_);
      is_over_ = true;
    }
    changed_.notify_all();
    thread_.join();
  }
  Ahead(const Ahead&) = delete;
  Ahead& operator=(const Ahead&) = delete;

  [[nodiscard]] std::uint64_t file_size() const { return file_size_; }
  [[nodiscard]] bool is_gzip() const { return unpacker_.is_gzip(); }
  /// Where members have ended in what was fetched; those passed are the reader's to take out.
  [[nodiscard]] std::deque<MemberEnd>& ends() { return ends_; }
  [[nodiscard]] std::uint64_t file_position() const { return current_.file_position; }
  [[nodiscard]] bool at_end() {
    if (used_ < current_.size) return false;
    fetch();
    return current_.size == 0;
  }
  /// Why there is no more, once there is none.
  [[nodiscard]] const std::optional<std::string>& defect() const { return current_.defect; }

  // At the end, when the thread has ended.
  std::optional<std::uint64_t> resume() {
    if (!at_end() || !current_.defect) return {};
    thread_.join();
    const auto left_out = unpacker_.resume();
    if (left_out) {
      current_ = {};
      used_ = 0;
      is_ended_ = false;
    }
    thread_ = left_out ? std::thread([this] { unpack(); }) : std::thread([] {});
    return left_out;
  }

  std::size_t read(std::uint8_t* out, std::size_t count) {
    if (at_end()) return 0;
    const std::size_t step = std::min(count, current_.size - used_);
    std::copy_n(current_.bytes.data() + used_, step, out);
    used_ += step;
    return step;
  }

 private:
  struct Block {
    std::vector<std::uint8_t> bytes;
    std::size_t size = 0;  // of them in use; none: the end
    std::uint64_t file_position = 0;
    std::optional<std::string> defect;
    std::vector<MemberEnd> ends;
  };

  void fetch() {
    std::unique_lock lock(mutex_);
    if (is_ended_) return;
    changed_.wait(lock, [this] { return !ready_.empty(); });
    spare_.push_back(std::move(current_.bytes));  // to be filled anew without being cleared
    current_ = std::move(ready_.front());
    ready_.pop_front();
    ends_.insert(ends_.end(), current_.ends.begin(), current_.ends.end());
    used_ = 0;
    is_ended_ = current_.size == 0;
    lock.unlock();
    changed_.notify_all();
  }

  void unpack() {
    constexpr std::size_t kMostReady = 4;
    for (bool has_more = true; has_more;) {
      Block block;
      block.bytes = empty_block();
      block.size = unpacker_.unpack(block.bytes);
      block.file_position = unpacker_.file_position();
      block.ends = unpacker_.take_ends();
      has_more = block.size > 0;
      if (!has_more) block.defect = unpacker_.defect();
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return is_over_ || ready_.size() < kMostReady; });
      if (is_over_) return;
      ready_.push_back(std::move(block));
      lock.unlock();
      changed_.notify_all();
    }
  }

  std::vector<std::uint8_t> empty_block() {
    constexpr std::size_t kBlock = 1U << 20U;
    std::vector<std::uint8_t> bytes;
    const std::lock_guard lock(mutex_);
    if (!spare_.empty()) {
      bytes = std::move(spare_.back());
      spare_.pop_back();
    }
    bytes.resize(kBlock);
    return bytes;
  }

  Unpacker unpacker_;
  const std::uint64_t file_size_;
  Block current_;  // the reader's
  std::size_t used_ = 0;
  bool is_ended_ = false;
  std::deque<MemberEnd> ends_;

  std::mutex mutex_;  // of what both use
  std::condition_variable changed_;
  std::deque<Block> ready_;
  std::vector<std::vector<std::uint8_t>> spare_;
  bool is_over_ = false;
  std::thread thread_;
};

PackedReader::PackedReader(const std::string& path)
    : path_(path), ahead_(std::make_unique<Ahead>(path)) {
  file_size_ = ahead_->file_size();
}

PackedReader::~PackedReader() = default;

size_t PackedReader::Read(void* buffer, size_t count) {
  auto* const out = static_cast<std::uint8_t*>(buffer);
  std::size_t done = take_again(out, count);
  while (done < count) {
    const std::size_t got = ahead_->read(out + done, count - done);
    if (got == 0) break;
    done += got;
  }
  const ReadingGuard::Pause pause;  // the record may grow ahead of what it holds
  record_.insert(record_.end(), out, out + done);
  position_ += done;
  return done;
}

bool PackedReader::at_end() { return again_begin_ == again_.size() && ahead_->at_end(); }

std::optional<std::string> PackedReader::defect() const {
  if (again_begin_ < again_.size()) return {};
  return ahead_->defect();
}

std::optional<std::uint64_t> PackedReader::resume() { return ahead_->resume(); }

std::size_t PackedReader::take_again(std::uint8_t* out, std::size_t count) {
  const std::size_t step = std::min(count, again_.size() - again_begin_);
  std::copy_n(again_.data() + again_begin_, step, out);
  again_begin_ += step;
  return step;
}

// @return whether there is more to see.
bool PackedReader::look_ahead() {
  constexpr std::size_t kBlock = 1U << 18U;
  again_.erase(again_.begin(), again_.begin() + static_cast<std::ptrdiff_t>(again_begin_));
  again_begin_ = 0;
  const std::size_t before = again_.size();
  again_.resize(before + kBlock);
  again_.resize(before + ahead_->read(again_.data() + before, kBlock));
  return again_.size() > before;
}

std::uint64_t PackedReader::skip_to(
    const std::function<bool(const std::uint8_t*, std::size_t)>& begins, std::uint64_t least) {
  position_ -= record_.size();
  again_.erase(again_.begin(), again_.begin() + static_cast<std::ptrdiff_t>(again_begin_));
  again_.insert(again_.begin(), record_.begin(), record_.end());
  again_begin_ = 0;
  record_.clear();
  std::uint64_t left_out = 0;
  for (bool has_more = true;; ++again_begin_, ++left_out) {
    while (has_more && again_.size() - again_begin_ < kLook) has_more = look_ahead();
    if (again_begin_ == again_.size()) break;
    const bool may_begin = left_out >= least;
    if (may_begin && begins(again_.data() + again_begin_, again_.size() - again_begin_)) break;
  }
  position_ += left_out;
  return left_out;
}

std::optional<std::uint64_t> PackedReader::bytes_from_record_on() {
  if (!std::filesystem::is_regular_file(path_)) return {};
  if (!unpacked_size_) unpacked_size_ = unpacked_size_of(path_);
  return *unpacked_size_ - (position_ - record_.size());
}

std::uint64_t PackedReader::doubtful_from_record_on() {
  if (!std::filesystem::is_regular_file(path_)) return std::numeric_limits<std::uint64_t>::max();
  if (!doubtful_) doubtful_ = doubtful_parts_of(path_);
  const std::uint64_t begin = position_ - record_.size();
  for (const UnpackedPart& part : *doubtful_)
    if (part.begin <= begin && begin < part.end) return part.end - begin;
  return 0;
}

// Members that have passed are forgotten, whoever asks for them.
PlaceInMembers PackedReader::pass_members() {
  PlaceInMembers place;
  for (std::deque<MemberEnd>& ends = ahead_->ends();
       !ends.empty() && ends.front().unpacked_position <= position_; ends.pop_front()) {
    member_begin_ = ends.front().unpacked_position;
    if (member_begin_ == position_) place.ended = ends.front().member;
  }
  const std::uint64_t so_far = position_ - member_begin_;
  place.goes_on = ahead_->is_gzip() && so_far > 0 && so_far < PackedMember::kLargest;
  return place;
}

std::vector<std::uint8_t> PackedReader::take_record(RecordBytes bytes) {
  place_ = pass_members();
  const PackedMember* const member = place_.ended.get();
  place_.is_all = bytes == RecordBytes::left_to_member && member != nullptr &&
                  member->unpacked_size == record_.size() && ends_with(record_, *member);
  const bool is_kept = bytes != RecordBytes::dropped && !place_.is_all;
  // Not moved out: the next object is likely as large, and so is read without growing step by step.
  auto record = is_kept ? record_ : std::vector<std::uint8_t>();
  record_.clear();
  return record;
}

double PackedReader::progress() const {
  if (file_size_ == 0) return 1.;
  return std::min(1.,
                  static_cast<double>(ahead_->file_position()) / static_cast<double>(file_size_));
}

}  // namespace lidar_upsampling
