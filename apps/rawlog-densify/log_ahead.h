// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "lidar_upsampling/io/log_index.h"
#include "lidar_upsampling/io/rawlog_stream.h"

namespace lidar_upsampling {

/// @brief The entries of a log, each read once, and what lies a little ahead of their turn: what a
/// run must know of the log while it goes by.
class LogAhead {
 public:
  /// @param span_s how far to look ahead, by stamps, as long as that takes no more memory than
  /// some 100 MB. @param copies_members what is written of it is packed as it was, where that can
  /// be.
  /// @throw std::runtime_error the file cannot be opened.
  LogAhead(const LogFile& log, double span_s, bool copies_members = true)
      : reader_(log, copies_members ? RecordBytes::left_to_member : RecordBytes::kept),
        indexer_(log.path),
        span_s_(span_s) {}

  /// @brief Reads one entry more. @return it, until next() gives it away; null at the log's end.
  /// @throw CorruptRawlog as RawlogReader::next().
  const RawlogEntry* read_on();

  /// Whether the span is read, or what is waited for; without a span, whether there is an entry.
  [[nodiscard]] bool is_full() const {
    return !waiting_.empty() && (spans() || (late_s_ ? has_awaited() : is_heavy()));
  }
  /// Whether all that waits spans what it was to.
  [[nodiscard]] bool spans() const;
  /// Whether all entries have been read, if they have not been given away.
  [[nodiscard]] bool is_at_end() const { return is_at_end_; }
  /// What of the log was left out, once it is at its end.
  [[nodiscard]] const std::optional<std::string>& corruption() const { return reader_.damage(); }

  /// For a log of which all is known otherwise. What has been read stays.
  void look_no_further() { span_s_ = 0; }
  /// @brief From here on it is enough, short of the span, that the log and each of these streams
  /// have been read until `late_s` behind the first entry that waits; but so much there must be,
  /// whatever memory it takes.
  void wait_for(const std::set<std::string>& labels, double late_s);
  /// Whether it is there.
  [[nodiscard]] bool has_awaited() const;

  [[nodiscard]] std::optional<RawlogEntry> next();

  /// All that has been read, but not given away.
  [[nodiscard]] const std::deque<RawlogEntry>& waiting() const { return waiting_; }
  [[nodiscard]] LogIndexer& indexer() { return indexer_; }
  [[nodiscard]] double progress() const { return reader_.progress(); }

 private:
  [[nodiscard]] bool is_heavy() const;
  [[nodiscard]] std::optional<Stamp> first_stamp() const;

  RawlogReader reader_;
  LogIndexer indexer_;
  double span_s_;
  std::deque<RawlogEntry> waiting_;
  std::size_t weight_ = 0;  ///< of them, bytes in memory
  std::optional<Stamp> newest_;
  std::optional<double> late_s_;
  std::set<std::string> awaited_;           ///< labels
  std::map<std::string, Stamp> newest_of_;  ///< label: last stamp
  bool is_at_end_ = false;
};

}  // namespace lidar_upsampling
