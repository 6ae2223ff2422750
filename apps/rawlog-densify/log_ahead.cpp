// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "log_ahead.h"

#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <algorithm>
#include <utility>

namespace lidar_upsampling {
namespace {

// @param read the bytes that it was read from, which most objects are as large as.
std::size_t size_of(const mrpt::serialization::CSerializable& object, std::size_t read) {
  constexpr std::size_t kObject = 1000;
  const auto* const picture = dynamic_cast<const mrpt::obs::CObservationImage*>(&object);
  const bool is_unpacked =
      picture != nullptr && !picture->image.isExternallyStored() && !picture->image.isEmpty();
  if (is_unpacked) return kObject + picture->image.getRowStride() * picture->image.getHeight();
  std::size_t size = kObject + read;
  if (const auto* const frame = dynamic_cast<const mrpt::obs::CSensoryFrame*>(&object))
    for (const auto& observation : *frame) size += size_of(*observation, 0);
  return size;
}

std::size_t weight_of(const RawlogEntry& entry) {
  const std::size_t size = entry.bytes.size();
  const std::size_t read = entry.packed.is_all ? entry.packed.ended->unpacked_size : size;
  return size + size_of(*entry.object, read);
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
  if (stamp) {
    newest_ = newest_ ? std::max(*newest_, *stamp) : *stamp;
    const auto* const observation =
        dynamic_cast<const mrpt::obs::CObservation*>(entry->object.get());
    if (observation != nullptr) newest_of_[observation->sensorLabel] = *stamp;
  }
  waiting_.push_back(std::move(*entry));
  return &waiting_.back();
}

std::optional<Stamp> LogAhead::first_stamp() const {
  const auto first = std::find_if(waiting_.begin(), waiting_.end(),
                                  [](const RawlogEntry& entry) { return stamp_of(entry); });
  if (first == waiting_.end()) return {};
  return stamp_of(*first);
}

bool LogAhead::spans() const {
  if (span_s_ <= 0) return true;
  const auto first = first_stamp();
  return first && seconds_between(*first, *newest_) >= span_s_;
}

void LogAhead::wait_for(const std::set<std::string>& labels, double late_s) {
  awaited_ = labels;
  late_s_ = late_s;
}

bool LogAhead::has_awaited() const {
  const auto first = late_s_ ? first_stamp() : std::nullopt;
  if (!first) return false;
  const auto is_far = [&](Stamp newest) { return seconds_between(*first, newest) >= *late_s_; };
  return is_far(*newest_) && std::all_of(awaited_.begin(), awaited_.end(), [&](const auto& label) {
           const auto newest = newest_of_.find(label);
           return newest != newest_of_.end() && is_far(newest->second);
         });
}

bool LogAhead::is_heavy() const {
  constexpr std::size_t kMost = 100U << 20U;
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
