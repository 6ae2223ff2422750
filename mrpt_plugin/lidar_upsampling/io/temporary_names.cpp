// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/io/temporary_names.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <climits>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <map>
#include <mutex>
#include <random>
#include <system_error>
#include <vector>

namespace fs = std::filesystem;

namespace lidar_upsampling {
namespace {

constexpr const char* kMark = ".tmp-";
constexpr std::size_t kDigits = 12;

/// A name that a signal's handler reads, which may neither wait nor allocate.
struct Slot {
  enum State { free, being_filled, in_use, taken_by_handler };
  std::atomic<int> state{free};
  std::array<char, PATH_MAX> path{};
};
static_assert(std::atomic<int>::is_always_lock_free, "a signal's handler may not wait");

std::array<Slot, 64> slots;
constexpr std::size_t kNoSlot = slots.size();

std::size_t claim_slot(const std::string& path) {
  if (path.size() >= PATH_MAX) return kNoSlot;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    int expected = Slot::free;
    if (!slots[i].state.compare_exchange_strong(expected, Slot::being_filled)) continue;
    std::copy(path.c_str(), path.c_str() + path.size() + 1, slots[i].path.begin());
    slots[i].state = Slot::in_use;
    return i;
  }
  return kNoSlot;  // the next run removes it
}

void free_slot(std::size_t slot) {
  if (slot == kNoSlot) return;
  int expected = Slot::in_use;
  slots[slot].state.compare_exchange_strong(expected, Slot::free);
}

extern "C" void remove_all_and_end(int signal) {
  for (Slot& slot : slots) {
    int expected = Slot::in_use;
    if (slot.state.compare_exchange_strong(expected, Slot::taken_by_handler))
      ::unlink(slot.path.data());
  }
  std::raise(signal);  // by now without a handler: ends the process when this one returns
}

bool is_hexadecimal(char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); }

// The file that a temporary name belongs to, empty: it is none of ours.
std::string owner_of(const std::string& name) {
  const auto mark = name.rfind(kMark);
  if (mark == std::string::npos || mark == 0) return {};
  const std::string all = name.substr(mark + std::strlen(kMark));
  const std::string ending = all.substr(0, all.find('.'));
  const bool is_ours =
      ending.size() == kDigits && std::all_of(ending.begin(), ending.end(), is_hexadecimal);
  return is_ours ? name.substr(0, mark) : std::string();
}

void remove_unless_locked(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) return;
  if (flock(file, LOCK_EX | LOCK_NB) == 0) ::unlink(path.c_str());
  ::close(file);
}

using NamesByOwner = std::multimap<std::string, std::string>;

NamesByOwner temporaries_in(const fs::path& folder) {
  NamesByOwner found;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    const std::string owner = owner_of(name);
    std::error_code ignored;
    if (!owner.empty() && fs::is_regular_file(entry->symlink_status(ignored)))
      found.emplace(owner, entry->path().string());
  }
  return found;
}

}  // namespace

void remove_temporaries_on_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction action {};
    if (sigaction(signal, nullptr, &action) != 0 || action.sa_handler == SIG_IGN) continue;
    action = {};
    action.sa_handler = remove_all_and_end;
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    sigaction(signal, &action, nullptr);
  }
}

void remove_stale_temporaries(const std::string& path) {
  // A folder is looked at once, as thousands of pictures may go there.
  static std::mutex mutex;
  static std::map<std::string, NamesByOwner> by_folder;
  const fs::path target(path);
  const std::string folder = target.parent_path().string();
  std::vector<std::string> stale;
  {
    const std::lock_guard lock(mutex);
    auto known = by_folder.find(folder);
    if (known == by_folder.end()) known = by_folder.emplace(folder, temporaries_in(folder)).first;
    const auto [begin, end] = known->second.equal_range(target.filename().string());
    for (auto name = begin; name != end; ++name) stale.push_back(name->second);
    known->second.erase(begin, end);
  }
  for (const std::string& name : stale) remove_unless_locked(name);
}

TemporaryName::TemporaryName(const std::string& path, const std::string& ending) {
  constexpr const char* kHexadecimal = "0123456789abcdef";
  std::random_device random;
  do {
    path_ = path + kMark;
    for (std::size_t i = 0; i < kDigits; ++i) path_ += kHexadecimal[random() % 16];
    path_ += ending;
  } while (fs::exists(fs::symlink_status(path_)));
  slot_ = claim_slot(path_);
}

TemporaryName::~TemporaryName() {
  if (!is_released_) ::unlink(path_.c_str());
  free_slot(slot_);
}

void TemporaryName::release() { is_released_ = true; }

void lock_temporary(int file) { static_cast<void>(flock(file, LOCK_EX | LOCK_NB)); }

}  // namespace lidar_upsampling
