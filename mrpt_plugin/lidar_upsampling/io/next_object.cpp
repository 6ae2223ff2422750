// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/io/next_object.h"

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <algorithm>
#include <cctype>
#include <string>

namespace lidar_upsampling {

// mrpt::serialization::CArchive::WriteObject: the name's length and the highest bit, the name, a
// version.
bool begins_object(const std::uint8_t* bytes, std::size_t size, bool in_frames) {
  constexpr std::size_t kShortest = 5;
  const std::size_t length = bytes[0] & 0x7fU;
  if ((bytes[0] & 0x80U) == 0 || length < kShortest || size < length + 2) return false;
  if (bytes[1] != 'm' && bytes[1] != 'C') return false;
  const std::string name(bytes + 1, bytes + 1 + length);
  const bool is_name = std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == ':' || c == '_';
  });
  const auto* const found = is_name ? mrpt::rtti::findRegisteredClass(name) : nullptr;
  if (found == nullptr) return false;
  return found->derivedFrom(CLASS_ID_NAMESPACE(CSensoryFrame, mrpt::obs)) ||
         found->derivedFrom(CLASS_ID_NAMESPACE(CActionCollection, mrpt::obs)) ||
         (!in_frames && found->derivedFrom(CLASS_ID_NAMESPACE(CObservation, mrpt::obs)));
}

}  // namespace lidar_upsampling
