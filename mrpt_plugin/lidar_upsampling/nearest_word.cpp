// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/nearest_word.h"

#include <algorithm>
#include <numeric>

namespace lidar_upsampling {
namespace {

// Letters to put in, to leave out, to change, or to swap with their neighbour (Damerau 1964).
std::size_t letters_between(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before_last, last(b.size() + 1), row(b.size() + 1);
  std::iota(last.begin(), last.end(), 0);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t changed = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, changed});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
    before_last = last;
    last = row;
  }
  return last.back();
}

}  // namespace

std::string did_you_mean(const std::string& word, const std::vector<std::string>& known) {
  const auto nearest =
      std::min_element(known.begin(), known.end(), [&](const auto& a, const auto& b) {
        return letters_between(word, a) < letters_between(word, b);
      });
  const std::size_t most = std::max<std::size_t>(1, word.size() / 3);
  if (nearest == known.end() || letters_between(word, *nearest) > most) return {};
  return "; did you mean " + *nearest + "?";
}

}  // namespace lidar_upsampling
