// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/io/left_out.h"

#include <mrpt/system/datetime.h>

namespace lidar_upsampling {

void LeftOut::begin(const std::string& text) {
  if (!first_) first_ = text;
  if (!is_open_) bytes_before_ = bytes_ + packed_bytes_;
  is_open_ = true;
}

void LeftOut::goes_on(Stamp stamp) {
  if (!is_open_) return;
  is_open_ = false;
  ++num_gaps_;
  last_from_ = stamp;
}

std::optional<std::string> LeftOut::text() const {
  if (!first_) return {};
  std::string text = *first_ + "; left out: " + std::to_string(bytes_) + " bytes of that data";
  if (packed_bytes_ > 0) text += " and " + std::to_string(packed_bytes_) + " of the file";
  const bool to_end = is_open_ && bytes_ + packed_bytes_ > bytes_before_;
  if (num_gaps_ == 0) return text + (to_end ? ", to its end" : "");
  if (num_gaps_ > 1) text += ", in " + std::to_string(num_gaps_) + " places, the last one";
  text += " until " + mrpt::system::dateTimeToString(*last_from_);
  if (to_end) text += ", and what is at its end";
  return text;
}

}  // namespace lidar_upsampling
