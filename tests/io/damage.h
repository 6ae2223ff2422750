// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <mrpt/img/CImage.h>
#include <mrpt/obs/CObservation3DRangeScan.h>

#include <algorithm>
#include <stdexcept>

#include "small_logs.h"

namespace lidar_upsampling {

/// Puts other bytes in the place of the first `from`.
[[nodiscard]] inline Bytes with_replaced(Bytes bytes, const Bytes& from, const Bytes& to) {
  const auto at = std::search(bytes.begin(), bytes.end(), from.begin(), from.end());
  if (at == bytes.end()) throw std::logic_error("with_replaced: not there");
  std::copy(to.begin(), to.end(), at);
  return bytes;
}

/// @brief A range picture whose stated size, as a zeroed or wild sector makes it, is another one
/// than that of its data.
[[nodiscard]] inline Bytes range_picture_of(std::uint32_t stated_rows, std::uint32_t stated_columns,
                                            Stamp stamp = odometry(0)->timestamp) {
  constexpr std::uint32_t kRows = 37, kColumns = 41;
  const auto little_endian = [](std::uint32_t a, std::uint32_t b) {
    Bytes bytes;
    for (const std::uint32_t value : {a, b})
      for (unsigned shift = 0; shift < 32; shift += 8)
        bytes.push_back(static_cast<std::uint8_t>(value >> shift));
    return bytes;
  };
  mrpt::obs::CObservation3DRangeScan scan;
  scan.sensorLabel = "DEPTH";
  scan.timestamp = stamp;
  scan.hasRangeImage = true;
  scan.rangeImage_setSize(kRows, kColumns);
  scan.rangeImage.fill(1000);
  Bytes bytes;
  mrpt::serialization::ObjectToOctetVector(&scan, bytes);
  return with_replaced(bytes, little_endian(kRows, kColumns),
                       little_endian(stated_rows, stated_columns));
}

/// @brief A colour picture as MRPT stores it unless told otherwise, one of whose JPEG markers is
/// none.
[[nodiscard]] inline Bytes broken_jpeg() {
  const bool before = mrpt::img::CImage::DISABLE_JPEG_COMPRESSION();
  mrpt::img::CImage::DISABLE_JPEG_COMPRESSION(false);
  Bytes bytes;
  mrpt::serialization::ObjectToOctetVector(colour_picture().get(), bytes);
  mrpt::img::CImage::DISABLE_JPEG_COMPRESSION(before);
  constexpr std::uint8_t kMarker = 0xff, kFrame = 0xc0, kNone = 0xaf;
  return with_replaced(bytes, {kMarker, kFrame, 0}, {kMarker, kNone});
}

}  // namespace lidar_upsampling
