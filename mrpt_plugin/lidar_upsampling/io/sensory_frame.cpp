// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/io/sensory_frame.h"

#include <mrpt/io/CMemoryStream.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>

#include "lidar_upsampling/io/silence.h"

namespace lidar_upsampling {
namespace {

using mrpt::obs::CSensoryFrame;

// A frame is stored as: header (class name, version), number of observations, these, end flag.
struct FrameLayout {
  std::vector<std::uint8_t> header;
  std::uint8_t end_flag = 0;
};

FrameLayout current_layout() {
  const std::vector<std::uint8_t> empty = entry_of(CSensoryFrame::Create()).bytes;
  FrameLayout layout;
  layout.header.assign(empty.begin(), empty.end() - sizeof(std::uint32_t) - 1);
  layout.end_flag = empty.back();
  return layout;
}

// By reading once more, this time noting where each observation starts and ends.
std::vector<RawlogEntry> read_observations(const RawlogEntry& frame, std::size_t header_size) {
  const Silence silence;
  mrpt::io::CMemoryStream stream;
  stream.assignMemoryNotOwn(frame.bytes.data(), frame.bytes.size());
  stream.Seek(static_cast<std::int64_t>(header_size));
  auto archive = mrpt::serialization::archiveFrom(stream);
  std::vector<RawlogEntry> observations(archive.ReadAs<std::uint32_t>());
  for (RawlogEntry& observation : observations) {
    const auto from = static_cast<std::ptrdiff_t>(stream.getPosition());
    observation.object = archive.ReadObject();
    const auto to = static_cast<std::ptrdiff_t>(stream.getPosition());
    observation.bytes.assign(frame.bytes.begin() + from, frame.bytes.begin() + to);
  }
  return observations;
}

}  // namespace

std::vector<RawlogEntry> split_frame(const RawlogEntry& frame) {
  const auto* const object = dynamic_cast<const CSensoryFrame*>(frame.object.get());
  if (object == nullptr) throw std::invalid_argument("split_frame: not a CSensoryFrame");
  const std::vector<std::uint8_t> header = current_layout().header;
  if (frame.bytes.size() > header.size() &&
      std::equal(header.begin(), header.end(), frame.bytes.begin())) {
    return read_observations(frame, header.size());
  }
  // Written by an older MRPT, in another layout: the same content in today's.
  std::vector<RawlogEntry> observations;
  for (const auto& observation : *object) observations.push_back(entry_of(observation));
  return observations;
}

RawlogEntry join_frame(const std::vector<RawlogEntry>& observations) {
  const FrameLayout layout = current_layout();
  const auto frame = CSensoryFrame::Create();
  RawlogEntry joined{frame, layout.header};
  const auto count = static_cast<std::uint32_t>(observations.size());
  for (int shift = 0; shift < 32; shift += 8) {  // MRPT stores little endian
    joined.bytes.push_back(static_cast<std::uint8_t>(count >> static_cast<unsigned>(shift)));
  }
  for (const RawlogEntry& part : observations) {
    const auto observation = std::dynamic_pointer_cast<mrpt::obs::CObservation>(part.object);
    if (!observation) throw std::invalid_argument("join_frame: not a CObservation");
    frame->insert(observation);
    joined.bytes.insert(joined.bytes.end(), part.bytes.begin(), part.bytes.end());
  }
  joined.bytes.push_back(layout.end_flag);
  return joined;
}

}  // namespace lidar_upsampling
