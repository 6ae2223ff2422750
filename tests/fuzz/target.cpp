// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "fuzz/target.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "lidar_upsampling/text.h"

#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/common_interface_defs.h>
#endif

namespace lidar_upsampling::fuzz {
namespace {

std::array<char, 200> now_at_work{};
const int terminal = dup(STDERR_FILENO);  // where the process's own stderr goes

void tell(const char* text) { static_cast<void>(!write(terminal, text, std::strlen(text))); }

void tell_input() {
  if (now_at_work[0] == 0) return;
  tell("\nthe process ends at: fuzz ");
  tell(now_at_work.data());
  tell("\n");
}

/// While it lives, what any library prints on stderr is kept.
class KeptStderr {
 public:
  KeptStderr() {
    std::fflush(stderr);
    dup2(file_, STDERR_FILENO);
  }
  ~KeptStderr() {
    std::fflush(stderr);
    dup2(terminal, STDERR_FILENO);
    close(file_);
  }
  KeptStderr(const KeptStderr&) = delete;
  KeptStderr& operator=(const KeptStderr&) = delete;

  [[nodiscard]] std::string text() const {
    std::array<char, 300> begin{};
    std::fflush(stderr);
    const ssize_t size = pread(file_, begin.data(), begin.size(), 0);
    return {begin.data(), static_cast<std::size_t>(std::max<ssize_t>(0, size))};
  }

 private:
  int file_ = memfd_create("stderr", 0);
};

extern "C" void tell_and_end(int signal) {
  tell_input();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

/// Notes what is at work, as long as it is.
class AtWork {
 public:
  AtWork(const std::string& target, std::uint64_t seed) {
    std::snprintf(now_at_work.data(), now_at_work.size(), "--target %s --seed %llu", target.c_str(),
                  static_cast<unsigned long long>(seed));
  }
  ~AtWork() { now_at_work[0] = 0; }
  AtWork(const AtWork&) = delete;
  AtWork& operator=(const AtWork&) = delete;
};

// Of the standard library, OpenCV or a parser: true, but nothing that a user could use.
bool is_foreign(const std::string& line) {
  constexpr std::array<const char*, 15> kForeign{
      "std::",   "stoi",         "stol",    "stod",           "stof",
      "vector",  "basic_string", "map::at", "_M_range_check", "bad optional",
      "array::", "OpenCV(",      "[json.",  "bad_",           "deque"};
  return std::any_of(kForeign.begin(), kForeign.end(),
                     [&](const char* begin) { return line.rfind(begin, 0) == 0; });
}

std::optional<std::string> fault_of(const std::exception& error) {
  const std::string line = one_line(error);
  if (line.empty()) return "an exception that says nothing";
  if (line.size() > 20000) return "a line of " + std::to_string(line.size()) + " characters";
  if (is_foreign(line)) return "not our words: " + line;
  return {};
}

}  // namespace

const std::vector<Target>& all_targets() {
  static const std::vector<Target> all = [] {
    std::vector<Target> targets = log_targets();
    for (const auto& more : {text_targets(), data_set_targets()})
      targets.insert(targets.end(), more.begin(), more.end());
    return targets;
  }();
  return all;
}

namespace {

std::optional<std::string> failure_of(const Target& target, Random& random) {
  try {
    target.run(random);
    return {};
  } catch (const Finding& finding) {
    return finding.what();
  } catch (const std::exception& error) {
    return fault_of(error);
  } catch (...) {
    return "something is thrown that is no std::exception";
  }
}

}  // namespace

std::optional<std::string> failure_of(const Target& target, std::uint64_t seed) {
  const AtWork noted(target.name, seed);
  Random random(seed);
  const KeptStderr printed;
  if (const auto failure = failure_of(target, random)) return failure;
  const std::string text = printed.text();
  if (!text.empty()) return "printed by a library: " + text;
  return {};
}

const char* at_work() { return now_at_work.data(); }

void tell_of_ends() {
#if defined(__SANITIZE_ADDRESS__)
  __sanitizer_set_death_callback(tell_input);  // it handles the signals, too
  __sanitizer_set_report_fd(reinterpret_cast<void*>(static_cast<std::intptr_t>(terminal)));
#else
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT})
    std::signal(signal, tell_and_end);
#endif
  for (const int signal : {SIGALRM, SIGPROF}) std::signal(signal, tell_and_end);
  std::atexit(tell_input);
}

}  // namespace lidar_upsampling::fuzz
