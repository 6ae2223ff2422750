// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "lidar_upsampling/io/packed_member.h"
#include "lidar_upsampling/io/packer.h"

namespace lidar_upsampling {

class OutputFile;

/// @brief Fills a file with gzip members one after the other, with a zstd frame or plainly, packed
/// by a thread of its own. The same writes give the same file.
class PackedWriter {
 public:
  /// @param file nobody else writes to it before finish(). Must outlive this.
  PackedWriter(OutputFile& file, Compression compression);
  ~PackedWriter();
  PackedWriter(const PackedWriter&) = delete;
  PackedWriter& operator=(const PackedWriter&) = delete;

  /// What is written at once stays in one gzip member.
  /// @param origin where it was read: of members that are written whole the packed bytes are taken.
  /// If it `is_all`, there need be no other bytes.
  /// @throw std::runtime_error the system's reason, as "No space left on device", of this write or
  /// of one before.
  void write(const std::vector<std::uint8_t>& bytes, const PlaceInMembers& origin = {});
  /// The last call to make: all is written. @throw std::runtime_error likewise.
  void finish();

 private:
  using Bytes = std::vector<std::uint8_t>;
  struct Block {
    Bytes bytes;                                 // to be packed, unless
    std::shared_ptr<const PackedMember> packed;  // it is already
  };

  void hand_over(Block block);
  [[nodiscard]] const Bytes& packed(const Block& block);
  void join();
  void work();

  OutputFile& file_;                // the worker's
  std::unique_ptr<Packer> packer_;  // the worker's
  const bool takes_members_;
  Bytes member_;        // the worker's: the last that was copied
  Bytes block_;         // that gathers
  bool waits_ = false;  // for the rest of a member that may be copied

  std::mutex mutex_;  // of what both threads use
  std::condition_variable changed_;
  std::deque<Block> waiting_;
  bool is_over_ = false;
  std::exception_ptr error_;
  std::thread worker_;
};

}  // namespace lidar_upsampling
