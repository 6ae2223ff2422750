// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "log_ahead.h"

#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <algorithm>
#include <utility>

namespace lidar_upsampling {
namespace {

// Besides its bytes: what a picture unpacks to, and the like.
std::size_t unpacked_size(const mrpt::serialization::CSerializable& object) {
  constexpr std::size_t kObject = 1000;
  std::size_t size = kObject;
  if (const auto* const frame = dynamic_cast<const mrpt::obs::CSensoryFrame*>(&object))
    for (const auto& observation : *frame) size += unpacked_size(*observation);
  const auto* const picture = dynamic_cast<const mrpt::obs::CObservationImage*>(&object);
  if (picture != nullptr && !picture->image.isExternallyStored() && !picture->image.isEmpty())
    size += picture->image.getRowStride() * picture->image.getHeight();
  return size;
}

std::size_t weight_of(const RawlogEntry& entry) {
  const std::size_t packed = entry.packed.ended ? entry.packed.ended->bytes.size() : 0;
  return 2 * entry.bytes.size() + packed + unpacked_size(*entry.object);
}

}  // namespace

const RawlogEntry* LogAhead::read_on() {
  if (is_at_end_) return nullptr;
  std::optional<RawlogEntry> entry = reader_.next();
  if (!entry) {
    is_at_end_ = true;
    return nullptr;
  }
  indexer_.add(*entry->object);
  weight_ += weight_of(*entry);
  const auto stamp = stamp_of(*entry);
  if (stamp) newest_ = newest_ ? std::max(*newest_, *stamp) : *stamp;
  waiting_.push_back(std::move(*entry));
  return &waiting_.back();
}

bool LogAhead::spans() const {
  if (span_s_ <= 0) return true;
  const auto first = std::find_if(waiting_.begin(), waiting_.end(),
                                  [](const RawlogEntry& entry) { return stamp_of(entry); });
  return first != waiting_.end() && seconds_between(*stamp_of(*first), *newest_) >= span_s_;
}

bool LogAhead::is_heavy() const {
  constexpr std::size_t kMost = 150U << 20U;
  return weight_ >= kMost;
}

std::optional<RawlogEntry> LogAhead::next() {
  if (waiting_.empty()) return {};
  RawlogEntry entry = std::move(waiting_.front());
  waiting_.pop_front();
  weight_ -= weight_of(entry);
  return entry;
}

}  // namespace lidar_upsampling
