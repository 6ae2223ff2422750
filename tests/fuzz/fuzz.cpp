// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <sys/stat.h>
#include <sys/time.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <map>
#include <string>

#include "fuzz/target.h"

/// What the sanitizer keeps of what was freed is no memory of ours.
extern "C" const char* __asan_default_options();  // NOLINT: the sanitizer's name
const char* __asan_default_options() { return "quarantine_size_mb=16"; }  // NOLINT

namespace {

using namespace lidar_upsampling::fuzz;  // NOLINT(google-build-using-namespace)

struct Request {
  std::uint64_t seed = 1, count = 1000;
  std::string target;
  unsigned most_s = 20;
  std::size_t most_mb = 500;
};

/// The most memory that the process held since the last call, MB; 0: the system does not tell.
std::size_t peak_memory() {
  std::size_t peak_kb = 0;
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (word == "VmHWM:") status >> peak_kb;
  std::ofstream("/proc/self/clear_refs") << 5;
  return peak_kb / 1024;
}

/// Ends the process after so much work, of which others on a busy machine take no part, and after
/// thirty times as much by the clock: then it waits for what does not come. 0: no more.
void limit_time(unsigned most_s) {
  itimerval work{};
  work.it_value.tv_sec = most_s;
  setitimer(ITIMER_PROF, &work, nullptr);
  alarm(30 * most_s);
}

/// @return whether all went well.
bool run_one(const Target& target, std::uint64_t seed, const Request& request) {
  limit_time(request.most_s);
  const auto failure = failure_of(target, seed);
  limit_time(0);
  const std::size_t peak_mb = peak_memory();
  std::string text = failure.value_or("");
  if (!failure && peak_mb > request.most_mb)
    text = "it took " + std::to_string(peak_mb) + " MB of memory";
  if (text.empty()) return true;
  std::printf("fuzz --target %s --seed %llu --count 1: %s\n", target.name.c_str(),
              static_cast<unsigned long long>(seed), text.c_str());
  std::fflush(stdout);
  return false;
}

int run(const Request& request) {
  const auto& targets = all_targets();
  std::size_t failed = 0;
  for (std::uint64_t seed = request.seed; seed < request.seed + request.count; ++seed) {
    const auto named = std::find_if(targets.begin(), targets.end(), [&](const Target& target) {
      return target.name == request.target;
    });
    const Target& target = named != targets.end() ? *named : targets[seed % targets.size()];
    if (!run_one(target, seed, request)) ++failed;
  }
  std::printf("%llu inputs, %zu failed\n", static_cast<unsigned long long>(request.count), failed);
  return failed == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Feeds the library with damaged files, each drawn by its seed");
  Request request;
  std::vector<std::string> names;
  for (const Target& target : all_targets()) names.push_back(target.name);
  app.add_option("--seed", request.seed, "the first; each further input has the next one")
      ->capture_default_str();
  app.add_option("--count", request.count, "of inputs")->capture_default_str();
  app.add_option("--target", request.target, "one kind of input instead of all in turn")
      ->check(CLI::IsMember(names));
  app.add_option("--most-seconds", request.most_s,
                 "of work for one input, after which the process ends")
      ->capture_default_str();
  app.add_option("--most-memory", request.most_mb, "MB of the process")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  tell_of_ends();
  return run(request);
}
