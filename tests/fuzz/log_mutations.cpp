// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "fuzz/log_mutations.h"

#include <mrpt/img/CImage.h>

#include <map>
#include <utility>

#include "fuzz/observation_mutations.h"
#include "lidar_upsampling/io/packer.h"
#include "lidar_upsampling/io/rawlog_stream.h"
#include "lidar_upsampling/io/silence.h"

namespace lidar_upsampling::fuzz {
namespace {

Bytes bytes_of(const mrpt::serialization::CSerializable& object, bool as_jpeg = false) {
  const bool before = mrpt::img::CImage::DISABLE_JPEG_COMPRESSION();
  mrpt::img::CImage::DISABLE_JPEG_COMPRESSION(!as_jpeg);
  Bytes bytes;
  mrpt::serialization::ObjectToOctetVector(&object, bytes);
  mrpt::img::CImage::DISABLE_JPEG_COMPRESSION(before);
  return bytes;
}

const std::vector<Bytes>& parts_of(const LogSeed& seed) {
  static std::map<std::string, std::vector<Bytes>> known;
  std::vector<Bytes>& parts = known[seed.name];
  if (parts.empty())
    for (const auto& object : seed.objects) parts.push_back(bytes_of(*object));
  return parts;
}

void spoil_field(Bytes& part, Random& random) {
  mrpt::serialization::CSerializable::Ptr object;
  mrpt::serialization::OctetVectorToObject(part, object);
  if (!object) return;
  spoil(*object, random, Sizes::kept);
  part = bytes_of(*object, random.one_in(2));
}

void spoil_order(std::vector<Bytes>& parts, Random& random) {
  const std::size_t at = random.below(parts.size());
  const auto place = parts.begin() + static_cast<std::ptrdiff_t>(at);
  const Bytes part = *place;
  switch (random.below(4)) {
    case 0:
      parts.erase(place);
      return;
    case 1:
      parts.insert(place, 1 + random.below(3), part);
      return;
    case 2:
      std::swap(*place, parts[random.below(parts.size())]);
      return;
    default:
      parts.insert(place, random.pick(parts_of(random.pick(log_seeds()))));
  }
}

Bytes joined(const std::vector<Bytes>& parts) {
  Bytes all;
  for (const Bytes& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

Bytes packed(const std::vector<Bytes>& parts, Random& random) {
  static const std::unique_ptr<Packer> packer = make_packer(Compression::fast);
  switch (random.below(3)) {
    case 0:
      return joined(parts);
    case 1:
      return packer->pack(joined(parts));
    default:
      std::vector<Bytes> members;
      for (const Bytes& part : parts) members.push_back(packer->pack(part));
      return joined(members);
  }
}

}  // namespace

Bytes whole_log(const LogSeed& seed) {
  return make_packer(Compression::fast)->pack(joined(parts_of(seed)));
}

Bytes damaged_log(const LogSeed& seed, Random& random) {
  const Silence silence;  // MRPT's objects tell of what is spoilt here
  std::vector<Bytes> parts = parts_of(seed);
  for (std::size_t i = random.below(4); i > 0; --i)
    spoil_field(parts[random.below(parts.size())], random);
  while (random.one_in(3) && parts.size() > 1) spoil_order(parts, random);
  if (random.one_in(3)) damage(parts[random.below(parts.size())], random);
  Bytes file = packed(parts, random);
  if (random.one_in(5)) damage(file, random);
  return file;
}

}  // namespace lidar_upsampling::fuzz
