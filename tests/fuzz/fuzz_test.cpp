// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "fuzz/fuzz_folder.h"
#include "fuzz/log_mutations.h"
#include "fuzz/target.h"

namespace lidar_upsampling::fuzz {
namespace {

class Fuzzing : public ::testing::TestWithParam<std::string> {
 protected:
  static void SetUpTestSuite() { tell_of_ends(); }
};

const Target& target_named(const std::string& name) {
  const auto& all = all_targets();
  return *std::find_if(all.begin(), all.end(),
                       [&](const Target& target) { return target.name == name; });
}

TEST_P(Fuzzing, damaged_input_is_used_as_far_as_it_is_good_or_refused_in_a_line) {
  const Target& target = target_named(GetParam());
  for (std::uint64_t seed = 1; seed <= target.num_in_test; ++seed) {
    const auto failure = failure_of(target, seed);
    EXPECT_FALSE(failure) << "fuzz --target " << target.name << " --seed " << seed
                          << " --count 1: " << *failure;
  }
}

TEST_P(Fuzzing, whole_input_is_read) {
  try {
    target_named(GetParam()).run_whole();
  } catch (const std::exception& error) {
    FAIL() << error.what();
  }
}

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const Target& target : all_targets()) all.push_back(target.name);
  return all;
}

INSTANTIATE_TEST_SUITE_P(Targets, Fuzzing, ::testing::ValuesIn(names()),
                         [](const auto& name) { return name.param; });

TEST(FuzzedInputs, are_the_same_for_the_same_seed_and_others_for_another) {
  std::set<Bytes> inputs;
  for (const std::uint64_t seed : {1, 2, 3, 1, 2, 3}) {
    Random random(seed);
    inputs.insert(damaged_log(log_seeds().front(), random));
  }
  EXPECT_EQ(inputs.size(), 3U);
}

}  // namespace
}  // namespace lidar_upsampling::fuzz
