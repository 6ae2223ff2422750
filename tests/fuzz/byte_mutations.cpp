// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "fuzz/byte_mutations.h"

#include <algorithm>
#include <cstring>
#include <functional>

namespace lidar_upsampling::fuzz {
namespace {

// A piece of something this long, short ones more often.
struct Piece {
  std::size_t from, size;
};
Piece piece_of(std::size_t total, Random& random) {
  const std::size_t from = random.below(total);
  const std::size_t most = std::max<std::size_t>(1, (total - from) >> random.below(8));
  return {from, std::min(total - from, 1 + random.below(most))};
}

template <typename Number>
void overwrite(Bytes& bytes, Number number, Random& random) {
  if (bytes.size() < sizeof number) return;
  std::memcpy(bytes.data() + random.below(bytes.size() - sizeof number + 1), &number,
              sizeof number);
}

template <typename Sequence>
void repeat_or_leave_out(Sequence& all, Random& random) {
  if (all.empty()) return;
  const Piece piece = piece_of(all.size(), random);
  const auto begin = all.begin() + static_cast<std::ptrdiff_t>(piece.from);
  const auto end = begin + static_cast<std::ptrdiff_t>(piece.size);
  if (random.one_in(2)) {
    all.erase(begin, end);
    return;
  }
  const Sequence copy(begin, end);
  const auto at = all.begin() + static_cast<std::ptrdiff_t>(random.below(all.size()));
  all.insert(at, copy.begin(), copy.end());
}

void damage_once(Bytes& bytes, Random& random) {
  if (bytes.empty()) return;
  switch (random.below(8)) {
    case 0:
      bytes.resize(random.below(bytes.size()));
      return;
    case 1: {
      constexpr std::size_t kSector = 512;
      const std::size_t from = random.below(bytes.size());
      std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(from),
                  std::min(kSector, bytes.size() - from), std::uint8_t{0});
      return;
    }
    case 2:
      repeat_or_leave_out(bytes, random);
      return;
    case 3:
      overwrite(bytes, random.odd_count(), random);
      return;
    case 4:
      overwrite(bytes, static_cast<float>(random.odd_number()), random);
      return;
    case 5:
      overwrite(bytes, random.odd_number(), random);
      return;
    case 6:
      bytes[random.below(bytes.size())] = static_cast<std::uint8_t>(random.bits());
      return;
    default:
      bytes[random.below(bytes.size())] ^= static_cast<std::uint8_t>(1U << random.below(8));
  }
}

const std::vector<std::string>& odd_words() {
  static const std::vector<std::string> all{"nan",
                                            "-nan",
                                            "inf",
                                            "-inf",
                                            "0",
                                            "-0",
                                            "-1",
                                            "1e999",
                                            "-1e999",
                                            "1e-999",
                                            "1e30",
                                            "1e308",
                                            "99999999999999999999999",
                                            "-9223372036854775809",
                                            "2147483648",
                                            "65536",
                                            "1.5",
                                            "0x10",
                                            "1,5",
                                            "",
                                            " ",
                                            "\"",
                                            "'",
                                            "[",
                                            "]",
                                            "{",
                                            "}",
                                            "[]",
                                            "{}",
                                            "null",
                                            "true",
                                            "#",
                                            ";",
                                            "=",
                                            "%s",
                                            "\xe4\xff",
                                            std::string(1, '\0'),
                                            std::string(300, '9'),
                                            std::string(5000, 'a')};
  return all;
}

bool belongs_to_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || std::strchr("+-._", c) != nullptr;
}

// A word or number, or what stands between two.
void change_word(std::string& text, Random& random) {
  if (text.empty()) return;
  std::size_t begin = random.below(text.size());
  std::size_t end = begin;
  while (begin > 0 && belongs_to_word(text[begin - 1])) --begin;
  while (end < text.size() && belongs_to_word(text[end])) ++end;
  text.replace(begin, end - begin, random.pick(odd_words()));
}

void change_line(std::string& text, Random& random) {
  const std::size_t at = random.below(text.size());
  const std::size_t newline = text.rfind('\n', at);
  const std::size_t begin = newline == std::string::npos ? 0 : newline + 1;
  const std::string line = text.substr(begin, text.find('\n', begin) - begin);
  switch (random.below(3)) {
    case 0:
      text.erase(begin, line.size() + random.below(2));
      return;
    case 1:
      text.insert(begin, line + '\n');
      return;
    default:
      text.insert(random.below(text.size()), line + '\n');
  }
}

}  // namespace

void damage(Bytes& bytes, Random& random) {
  const std::size_t times = 1 + random.below(3);
  for (std::size_t i = 0; i < times; ++i) damage_once(bytes, random);
}

std::string damaged_text(const std::string& text, Random& random) {
  std::string result = text;
  const std::size_t times = 1 + random.below(3);
  for (std::size_t i = 0; i < times && !result.empty(); ++i) {
    const std::size_t kind = random.below(8);
    if (kind < 4) change_word(result, random);
    if (kind == 4 || kind == 5) change_line(result, random);
    if (kind == 6) repeat_or_leave_out(result, random);
    if (kind < 7) continue;
    Bytes bytes(result.begin(), result.end());
    damage_once(bytes, random);
    result.assign(bytes.begin(), bytes.end());
  }
  return result;
}

}  // namespace lidar_upsampling::fuzz
